// What a file describes, in its order, but made by several threads: meshes from files of their own,
// images, and in between the shapes that are made while the file is read.
#ifndef SWELL_IMPORT_SCENE_PARTS_H_
#define SWELL_IMPORT_SCENE_PARTS_H_

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <tbb/task_group.h>

#include "src/import/diagnostics.h"
#include "src/import/shared_ply.h"
#include "src/scene/scene.h"

namespace swell {

// Parts are joined in the order in which they were begun, so that the scene does not depend on the
// threads.
class SceneParts {
 public:
  SceneParts() = default;
  SceneParts(const SceneParts&) = delete;
  ~SceneParts() { group_.wait(); }

  // Geometry of its own, to be appended; nothing else of the scene may be used.
  using Make = std::function<void(Scene& part, Diagnostics& diagnostics)>;

  // For shapes that are made at once.
  Scene& Open(Place place);
  // For what takes time: begun by some thread, done when Join begins.
  void Defer(Place place, Make make);
  // For what uses a file that others may use too: the file is begun to be read when it is first
  // named, and `make` is begun when Join begins.
  using MakeOfPly = std::function<void(SharedPly& ply, Scene& part, Diagnostics& diagnostics)>;
  void DeferPly(Place place, const std::string& path, MakeOfPly make);
  // For an image, which will be row `row` of the scene's: `make` leaves it as the part's only one.
  void DeferImage(Place place, uint32_t row, Make make);

  // How many parts there are. What is opened next is not in them.
  size_t Close();
  // Whether parts [first, Close()) may hold shapes.
  bool MayHoldShapes(size_t first) const;

  // Appends all parts to the scene. The first error of a part, in their order, replaces that of the
  // diagnostics, which is about what came after the parts.
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
    std::unique_ptr<TexelImage> image;
  };
  struct Part {
    Place place;
    bool deferred = false;
    uint32_t image = kNoTexture;
    Rows rows;
    std::unique_ptr<Scene> open;               // what is made at once, until it is joined
    std::unique_ptr<Diagnostics> diagnostics;  // null: nothing to say
  };
  struct PlyUse {
    Part* part;
    std::shared_ptr<SharedPly> ply;
    MakeOfPly make;
  };
  Part& Begin(Place place);
  void MakeOfPlys();
  static void Run(const Make& make, Part* part);
  static Rows TakeRows(Scene& scene);
  static void Append(Rows& rows, Scene* scene);
  void Reserve(Scene* scene) const;

  std::deque<Part> parts_;  // which do not move
  bool open_ = false;       // the last of them
  std::vector<Start> starts_;
  std::map<std::string, std::shared_ptr<SharedPly>> plys_;  // by path
  std::vector<PlyUse> ply_uses_;
  tbb::task_group group_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_SCENE_PARTS_H_
