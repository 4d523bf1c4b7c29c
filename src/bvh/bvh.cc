// A scene in, its wide tree out: boxes, the binary tree, the wide nodes and the leaf blocks.
#include "src/bvh/bvh.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "src/base/check.h"
#include "src/bvh/build_sah.h"
#include "src/bvh/bounds4.h"
#include "src/bvh/prim_boxes.h"
#include "src/bvh/widen.h"

namespace swell {

namespace {

constexpr size_t kHugePage = size_t{2} << 20;
constexpr size_t kPage = 4096;
constexpr size_t kLeastMapped = size_t{8} << 10;

// A whole number of pages, at a multiple of `align`; null if there are none.
void* MapPages(size_t bytes, size_t align) {
  const size_t slack = align - kPage;
  void* const memory = mmap(nullptr, bytes + slack, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  char* const begin = static_cast<char*>(memory);
  const size_t before = (align - reinterpret_cast<uintptr_t>(begin) % align) % align;
  if (before > 0) munmap(begin, before);
  if (slack > before) munmap(begin + before + bytes, slack - before);
  return begin + before;
}

}  // namespace

template <class T> void PageArray<T>::Free::operator()(T* p) const {
  if (mapped_bytes == 0) return std::free(p);
  munmap(p, mapped_bytes);
}

template <class T> PageArray<T>::PageArray(size_t size) : size_(size) {
  if (size == 0) return;
  const size_t bytes = (size * sizeof(T) + kPage - 1) / kPage * kPage;
  void* memory;
  if (bytes < kLeastMapped) {
    memory = std::aligned_alloc(64, bytes);
  } else {
    memory = MapPages(bytes, bytes >= kHugePage ? kHugePage : kPage);
    data_.get_deleter().mapped_bytes = bytes;
  }
  if (memory == nullptr) throw std::bad_alloc();
  // Advice: failing loses speed only.
  if (bytes >= kHugePage) madvise(memory, bytes, MADV_HUGEPAGE);
  data_.reset(static_cast<T*>(memory));
}
template class PageArray<BvhNode>;
template class PageArray<TriangleBlock>;
template class PageArray<Reference>;
template class PageArray<uint32_t>;

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

// The references are freed with it.
std::unique_ptr<UpperNode> BuildTree(const Scene& scene, const BuildOptions& options) {
  PageArray<Reference> refs = MakeReferences(scene);
  return BuildSah(scene, {refs.data(), refs.size()}, options);
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
    const std::unique_ptr<UpperNode> root = BuildTree(scene, options);
    Assemble(*root, scene, options.progress, bvh);
  }
  return bvh;
}

}  // namespace swell
