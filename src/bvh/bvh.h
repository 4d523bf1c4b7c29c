// Owns the wide tree of a scene; kernels see it through a BvhView.
#ifndef SWELL_BVH_BVH_H_
#define SWELL_BVH_BVH_H_

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/bvh_node.h"
#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

// Uninitialised memory for `size` trivial values. Large arrays ask for 2 MiB pages, which random
// access over a tree needs: with 4 KiB pages most visits miss the TLB. All but small ones go back
// to the system as soon as they are freed.
template <class T> class PageArray {
 public:
  PageArray() = default;
  explicit PageArray(size_t size);

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  size_t size() const { return size_; }
  T& operator[](size_t i) { return data_.get()[i]; }
  const T& operator[](size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    size_t mapped_bytes = 0;  // 0: allocated
    void operator()(T* p) const;
  };
  std::unique_ptr<T, Free> data_;
  size_t size_ = 0;
};

// Gives the whole pages among `bytes` of a PageArray back to the system; what they held is lost.
// Does nothing for few bytes, which may be a small array's.
void GiveBack(void* first, size_t bytes);

// The tree of the world, and behind it those of the objects that have instances.
struct Bvh {
  PageArray<BvhNode> nodes;
  PageArray<TriangleBlock> blocks;
  std::vector<float> sphere_boxes;  // see BvhView
  std::vector<ObjectRecord> objects;
  const SphereRecord* spheres = nullptr;
  const InstanceRecord* instances = nullptr;
  uint32_t triangle_count = 0;
  uint32_t sphere_count = 0;
  uint32_t depth = 0;
  float max_abs_coord = 0.0f;

  BvhView view() const {
    return {nodes.data(),
            blocks.data(),
            spheres,
            sphere_boxes.data(),
            instances,
            objects.data(),
            static_cast<uint32_t>(nodes.size()),
            static_cast<uint32_t>(blocks.size()),
            sphere_count,
            triangle_count,
            depth,
            max_abs_coord};
  }
  size_t bytes() const {
    return nodes.size() * sizeof(BvhNode) + blocks.size() * sizeof(TriangleBlock) +
           sphere_boxes.size() * sizeof(float) + objects.size() * sizeof(ObjectRecord);
  }
};

// How far a build is, for another thread to read.
struct BuildProgress {
  std::atomic<uint64_t> done{0};  // of kBuildSteps for every primitive
};
inline constexpr uint64_t kBuildSteps = 5;

struct BuildOptions {
  uint32_t bins = 32;        // per axis; at most 32
  uint32_t parallel = 4096;  // references below which a subtree is built by one thread
  // Spatial splits: triangles may be in several leaves, each time with the box of a part. At most
  // `most_cuts` times the primitives are added; 0 turns them off. They are tried where the children
  // of the best other split overlap by more than `overlap` of the scene's area.
  float most_cuts = 1.0f;
  float overlap = 1e-5f;
  bool cut_always = false;  // cut where it costs, too: for tests
  BuildProgress* progress = nullptr;
};

// Builds the tree of the world, of its own primitives and its instances, and one of each object
// that has instances. The result depends on the scene and the options only, not on the number of
// threads. `scene` must outlive it (spheres and instances are not copied). Fails if the scene has
// more primitives and instances than references can count.
Result<Bvh> BuildBvh(const Scene& scene, const BuildOptions& options = {});

// "" if every sphere and every instance that can be hit is in one leaf of its tree, and every
// triangle in one or, part by part, in several, every box holds what is below it, and the depth is
// as stated and within kMaxBvhDepth; else what is wrong.
std::string ValidateBvh(const Bvh& bvh, const Scene& scene);

}  // namespace swell

#endif  // SWELL_BVH_BVH_H_
