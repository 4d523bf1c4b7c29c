// Meshes of a glTF file, where its nodes place them -> shapes, objects and instances of the scene.
#ifndef SWELL_IMPORT_GLTF_MESHES_H_
#define SWELL_IMPORT_GLTF_MESHES_H_

#include <vector>

#include "src/import/gltf_materials.h"
#include "src/import/gltf_nodes.h"
#include "src/import/gltf_primitive.h"

namespace swell {

class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& file, Scene* scene, Diagnostics* diagnostics, Place place,
             GltfMaterials* materials)
      : file_(file),
        scene_(*scene),
        diagnostics_(*diagnostics),
        place_(place),
        materials_(*materials) {}

  // A mesh that is placed once stands in the world. One that is placed more often is an object
  // with instances, but for its primitives that emit light, which stand in the world each time.
  void Place(const std::vector<GltfPlacedNode>& nodes);

 private:
  enum class Which { kAll, kDark, kBright };

  void AddPlacements(const GltfPlacedNode& placed);
  void AddMesh(int mesh, const std::vector<Transform>& places);
  void AddPrimitives(int mesh, const Transform& to_world, Which which);
  void AddPrimitive(const tinygltf::Primitive& primitive, const std::string& name,
                    const Transform& to_world, Which which);
  void Append(const GltfPrimitive& read, const std::optional<GltfUvFrame>& frame);
  void AppendRare(const GltfPrimitive& read, const GltfSurface& surface, const Transform& to_world,
                  const MeshStart& start);
  static const GltfRows* RowsOf(const GltfPrimitive& read, const std::string& name, size_t width,
                                size_t most = 0);
  void AppendUvs(const GltfRows& uvs, const UvMap& map);
  void AppendColors(const GltfRows& colors, size_t first_vertex);
  void AddInstances(const std::string& name, size_t first_triangle,
                    const std::vector<Transform>& places);
  void Finish(const GltfSurface& surface, const std::string& name, const Transform& to_world,
              const MeshStart& start);
  void OpenVolumes(size_t first_shape);
  void WarnOfPrimitive(const tinygltf::Primitive& primitive);
  void WarnOfTriangles();
  bool CheckMemory(uint64_t bytes, const std::string& what);
  bool failed() const { return diagnostics_.failed(); }

  const GltfFile& file_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  swell::Place place_;
  GltfMaterials& materials_;
  std::vector<std::vector<Transform>> places_;  // of each mesh
  uint64_t placement_count_ = 0;
  uint64_t flat_triangles_ = 0, meshes_with_flat_ = 0;
  uint64_t unchecked_bytes_ = 0;
};

// The transforms of EXT_mesh_gpu_instancing, in the node's space.
Result<std::vector<Transform>> ReadInstancing(const GltfFile& file,
                                              const tinygltf::Value& extension);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_MESHES_H_
