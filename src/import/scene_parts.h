// What a file describes, in its order, but made by several threads: meshes from files of their own,
// images, what imported files describe, and in between the shapes that are made while the file is
// read.
#ifndef SWELL_IMPORT_SCENE_PARTS_H_
#define SWELL_IMPORT_SCENE_PARTS_H_

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/import/diagnostics.h"
#include "src/import/row_map.h"
#include "src/import/shapes.h"
#include "src/import/shared_reads.h"
#include "src/scene/scene.h"

namespace swell {

// A mesh takes less as an object with instances than flat in the world, and its rays hardly longer.
inline constexpr uint64_t kLeastSharedTriangles = 4096;

// Parts are joined in the order in which they were begun, so that the scene does not depend on the
// threads.
class SceneParts {
 public:
  explicit SceneParts(SharedReads* reads) : reads_(*reads) {}
  SceneParts(const SceneParts&) = delete;

  // For shapes that are made at once.
  Scene& Open(Place place);
  // For the mesh of a PLY file, which other parts may name too.
  void AddPly(const Placement& placement, const std::string& path);
  // For an image, which messages call with `prefix`.
  void AddImage(Place place, const std::string& prefix, std::shared_ptr<SharedImage> image);
  // For an imported file. Both outlive the parts.
  void AddImport(SceneParts* inner, Diagnostics* diagnostics);

  // How many parts there are. What is opened next is not in them.
  size_t Close();
  // Whether parts [first, Close()) may hold shapes.
  bool MayHoldShapes(size_t first) const;

  // What follows, once all is read that was named.

  // Changes what shapes name of other tables.
  void Map(const RowMap& map);
  // Makes objects of meshes that the world has several times, from one file and with the same
  // surface: a part holds each in the file's own space, to be placed at `uses`. Smaller ones, those
  // of objects and those that `may_share` refuses stay where they are.
  struct SharedMesh {
    std::string name;
    Place place;
    const SceneParts* parts;
    size_t part;
    std::vector<Transform> uses;
  };
  using MayShare = std::function<bool(const Placement& placement)>;
  std::vector<SharedMesh> ShareMeshes(const MayShare& may_share);
  // Makes the meshes of PLY files.
  void MakeAll();
  // Adds what is to be said of all parts. The first error of a part, in their order, replaces that
  // of the diagnostics, which is about what came after the parts.
  void Tell(Diagnostics* diagnostics);
  // Appends all parts to the scene.
  void Join(Scene* scene, Diagnostics* diagnostics);

  // After Join: where in the scene the part begins; `part` may be one beyond the last.
  struct Start {
    uint32_t triangle = 0, sphere = 0, shape = 0;
  };
  const Start& start(size_t part) const { return starts_[part]; }

 private:
  // What remains of a finished part; there may be very many.
  struct Rows {
    std::vector<float> positions, normals, uvs;
    std::vector<uint32_t> indices, prim_shape;
    std::vector<Shape> shapes;
    std::vector<SphereRecord> spheres;
    uint64_t left_out_triangles = 0;
  };
  struct ImageUse {
    std::string prefix;
    std::shared_ptr<SharedImage> image;
  };
  struct ImportUse {
    SceneParts* parts;
    Diagnostics* diagnostics;
  };
  struct PlyUse {
    Placement placement;
    std::shared_ptr<SharedPly> ply;
  };
  struct Part {
    Place place;
    Rows rows;
    // One of these, until it is joined.
    std::unique_ptr<Scene> open;  // what is made at once
    std::unique_ptr<PlyUse> ply;
    std::unique_ptr<ImageUse> image;
    std::unique_ptr<ImportUse> import;
    std::unique_ptr<Diagnostics> diagnostics;  // null: nothing to say
  };
  // The mesh of a part, of these or of imported ones.
  struct FoundMesh {
    SceneParts* parts;
    size_t part;
    PlyUse* use;
  };
  Part& Begin(Place place);
  void FindMeshes(std::vector<FoundMesh>* found);
  void BeginMaking();
  static void MakePly(Part* part);
  static void TellImage(Part* part);
  static Rows TakeRows(Scene& scene);
  static void Append(Rows& rows, Scene* scene);
  struct Sizes {
    size_t positions = 0, normals = 0, uvs = 0, indices = 0;
  };
  void AddSizes(Sizes* sizes) const;
  void AppendAll(Scene* scene, Diagnostics* diagnostics);

  SharedReads& reads_;
  std::deque<Part> parts_;  // which do not move
  bool open_ = false;       // the last of them
  std::vector<Start> starts_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_SCENE_PARTS_H_
