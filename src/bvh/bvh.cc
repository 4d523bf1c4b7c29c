// A scene in, its wide tree out: boxes, the binary tree, the wide nodes and the leaf blocks.
#include "src/bvh/bvh.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include "src/base/check.h"
#include "src/bvh/build_sah.h"
#include "src/bvh/bounds4.h"
#include "src/bvh/prim_boxes.h"
#include "src/bvh/widen.h"

namespace swell {

template <class T> PageArray<T>::PageArray(size_t size) : size_(size) {
  constexpr size_t kHugePage = size_t{2} << 20;
  if (size == 0) return;
  const size_t align = size * sizeof(T) >= kHugePage ? kHugePage : 64;
  const size_t bytes = (size * sizeof(T) + align - 1) / align * align;
  void* memory = std::aligned_alloc(align, bytes);
  if (memory == nullptr) throw std::bad_alloc();
  if (align == kHugePage)
    madvise(memory, bytes, MADV_HUGEPAGE);  // advice: failing loses speed only
  data_.reset(static_cast<T*>(memory));
}
template class PageArray<BvhNode>;
template class PageArray<TriangleBlock>;
template class PageArray<Reference>;

namespace {

PageArray<Reference> MakeReferences(const Scene& scene) {
  const size_t triangles = scene.triangle_count();
  PageArray<Reference> refs(triangles + scene.spheres.size());
  tbb::parallel_for(size_t{0}, refs.size(), [&](size_t i) {
    const bool is_sphere = i >= triangles;
    const Box3 box = is_sphere ? SphereBox(scene.spheres[i - triangles]) : TriangleBox(scene, i);
    refs[i] = Reference(ToBounds4(box), static_cast<uint32_t>(i), is_sphere);
  });
  return refs;
}

}  // namespace

Result<Bvh> BuildBvh(const Scene& scene, const BuildOptions& options) {
  const size_t prim_count = scene.triangle_count() + scene.spheres.size();
  if (prim_count > kBlockIndexMask) {
    return Error{"the scene has " + std::to_string(prim_count) + " primitives; the limit is " +
                 std::to_string(kBlockIndexMask) + ": split the scene or simplify its meshes"};
  }
  Bvh bvh;
  bvh.spheres = scene.spheres.data();
  bvh.triangle_count = static_cast<uint32_t>(scene.triangle_count());
  bvh.sphere_count = static_cast<uint32_t>(scene.spheres.size());
  for (const SphereRecord& sphere : scene.spheres) {
    const Box3 box = SphereBox(sphere);
    bvh.sphere_boxes.insert(bvh.sphere_boxes.end(), box.lower, box.lower + 3);
    bvh.sphere_boxes.insert(bvh.sphere_boxes.end(), box.upper, box.upper + 3);
  }
  if (prim_count == 0) {
    MakeEmpty(bvh);
  } else {
    Assemble(*BuildSah(scene, MakeReferences(scene), options), scene, bvh);
  }
  return bvh;
}

}  // namespace swell
