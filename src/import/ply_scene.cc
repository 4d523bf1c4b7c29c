// A bare PLY file -> a scene of one mesh of grey clay, framed and lit.
#include "src/import/ply_scene.h"

#include "src/import/diagnostics.h"
#include "src/import/frame_scene.h"
#include "src/import/mtl_surfaces.h"
#include "src/import/ply.h"
#include "src/import/shapes.h"

namespace swell {

Result<Scene> ReadPlyScene(const std::string& path) {
  Scene scene;
  Diagnostics diagnostics;
  const Place place = {diagnostics.AddFile(path), 0};
  const MeshStart start = BeginMesh(scene);
  const Result<PlyContents> ply =
      ReadPly(path, {&scene.positions, &scene.normals, &scene.uvs, &scene.indices});
  if (!ply) return ply.error();
  if (ply->short_faces > 0) {
    diagnostics.Warn(
        place, std::to_string(ply->short_faces) + " faces of fewer than 3 vertices are left out");
  }
  scene.materials.push_back(ClayMaterial());
  Placement placement;
  placement.place = place;
  placement.name = "the mesh";
  FinishMesh(scene, diagnostics, placement, start);
  if (scene.shapes.empty()) {
    diagnostics.Fail(place, "all its faces are without area; there is nothing to render");
  }
  if (diagnostics.failed()) return diagnostics.error();
  FinishPrimitives(scene);
  FrameScene(scene);
  scene.warnings = diagnostics.TakeWarnings();
  return scene;
}

}  // namespace swell
