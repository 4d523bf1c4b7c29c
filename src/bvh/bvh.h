// Owns the wide tree of a scene; kernels see it through a BvhView.
#ifndef SWELL_BVH_BVH_H_
#define SWELL_BVH_BVH_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "kernels/bvh_node.h"
#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

// Uninitialised memory for `size` trivial values. Large arrays ask for 2 MiB pages, which random
// access over a tree needs: with 4 KiB pages most visits miss the TLB.
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
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
  size_t size_ = 0;
};

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

struct BuildOptions {
  uint32_t bins = 32;        // per axis; at most 64
  uint32_t parallel = 4096;  // primitives below which a subtree is built by one thread
};

// Builds the tree of the world, of its own primitives and its instances, and one of each object
// that has instances. The result depends on the scene and the options only, not on the number of
// threads. `scene` must outlive it (spheres and instances are not copied). Fails if the scene has
// more primitives and instances than references can count.
Result<Bvh> BuildBvh(const Scene& scene, const BuildOptions& options = {});

// "" if every primitive and every instance that can be hit is in exactly one leaf of its tree,
// every box holds what is below it, and the depth is as stated and within kMaxBvhDepth; else what
// is wrong.
std::string ValidateBvh(const Bvh& bvh, const Scene& scene);

}  // namespace swell

#endif  // SWELL_BVH_BVH_H_
