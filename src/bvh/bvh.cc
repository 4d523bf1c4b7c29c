// A scene in, its wide tree out: boxes, the binary tree, the wide nodes and the leaf blocks.
#include "src/bvh/bvh.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/base/check.h"
#include "src/bvh/build_sah.h"
#include "src/bvh/bounds4.h"
#include "src/bvh/prim_boxes.h"
#include "src/bvh/widen.h"
#include "src/scene/objects.h"

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
void GiveBack(void* first, size_t bytes) {
  if (bytes < 2 * kLeastMapped) return;
  const uintptr_t begin = (reinterpret_cast<uintptr_t>(first) + kPage - 1) / kPage * kPage;
  const uintptr_t end = (reinterpret_cast<uintptr_t>(first) + bytes) / kPage * kPage;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

template class PageArray<BvhNode>;
template class PageArray<TriangleBlock>;
template class PageArray<BinaryNode>;
template class PageArray<Reference>;
template class PageArray<uint32_t>;

namespace {

// The tree of the world or of one object, by itself.
struct Part {
  Bvh tree;
  Box3 box;
};

struct PrimSource {
  std::vector<RowRange> triangles, spheres;
  bool instances = false;  // the world's
};

// Of an instance that cannot be hit.
const Box3 kNoBox;

PageArray<Reference> WithBoxes(PageArray<Reference> refs) {
  const auto has_box = [](const Reference& ref) { return !ref.box().IsEmpty(); };
  const auto count =
      static_cast<size_t>(std::count_if(refs.data(), refs.data() + refs.size(), has_box));
  if (count == refs.size()) return refs;
  PageArray<Reference> kept(count);
  std::copy_if(refs.data(), refs.data() + refs.size(), kept.data(), has_box);
  return kept;
}

PageArray<Reference> MakeReferences(const Scene& scene, const PrimSource& source, const Bvh& bvh) {
  size_t count = source.instances ? scene.instances.size() : 0;
  for (const RowRange& range : source.triangles) count += range.count;
  for (const RowRange& range : source.spheres) count += range.count;
  PageArray<Reference> refs(count);
  size_t at = 0;
  const auto add = [&](const RowRange& range, size_t first_prim, bool alone, const auto& box_of) {
    tbb::parallel_for(size_t{0}, range.count, [&](size_t i) {
      const auto prim = static_cast<uint32_t>(first_prim + range.first + i);
      refs[at + i] = Reference(box_of(range.first + i), prim, alone);
    });
    at += range.count;
  };
  for (const RowRange& range : source.triangles) {
    add(range, 0, false, [&](size_t i) { return TriangleBounds(scene, i); });
  }
  for (const RowRange& range : source.spheres) {
    add(range, bvh.triangle_count, true,
        [&](size_t i) { return ToBounds4(SphereBox(scene.spheres[i])); });
  }
  if (!source.instances) return refs;
  add({0, scene.instances.size()}, size_t{bvh.triangle_count} + bvh.sphere_count, true,
      [&](size_t i) {
        const InstanceRecord& instance = scene.instances[i];
        return ToBounds4(InstanceBox3(instance, bvh.objects[instance.object]).value_or(kNoBox));
      });
  return WithBoxes(std::move(refs));
}

// Null if there is nothing. The references are freed with it.
std::unique_ptr<UpperNode> BuildUpper(const Scene& scene, const PrimSource& source,
                                      const BuildOptions& options, const Bvh& bvh) {
  PageArray<Reference> refs = MakeReferences(scene, source, bvh);
  if (refs.size() == 0) return nullptr;
  return BuildSah(scene, {refs.data(), refs.size()}, options);
}

Part BuildPart(const Scene& scene, const PrimSource& source, const BuildOptions& options,
               const Bvh& bvh) {
  Part part;
  part.tree.triangle_count = bvh.triangle_count;
  part.tree.sphere_count = bvh.sphere_count;
  std::unique_ptr<UpperNode> root = BuildUpper(scene, source, options, bvh);
  if (root == nullptr) {
    MakeEmpty(part.tree);
    part.box = {{0, 0, 0}, {0, 0, 0}};
    return part;
  }
  part.box = root->box.ToBox3();
  Assemble(std::move(root), scene, options.progress, part.tree);
  return part;
}

// Lays the trees behind each other; takes them apart on the way, so that memory holds all of them
// once and one of them twice.
void Join(std::vector<Part>& parts, Bvh& bvh) {
  size_t nodes = 0, blocks = 0;
  for (const Part& part : parts) {
    nodes += part.tree.nodes.size();
    blocks += part.tree.blocks.size();
    bvh.depth = std::max(bvh.depth, part.tree.depth);
    bvh.max_abs_coord = std::max(bvh.max_abs_coord, part.tree.max_abs_coord);
  }
  if (parts.size() == 1) {
    bvh.nodes = std::move(parts[0].tree.nodes);
    bvh.blocks = std::move(parts[0].tree.blocks);
    return;
  }
  bvh.nodes = PageArray<BvhNode>(nodes);
  bvh.blocks = PageArray<TriangleBlock>(blocks);
  uint32_t node = 0, block = 0;
  for (Part& part : parts) {
    const Bvh tree = std::move(part.tree);
    tbb::parallel_for(size_t{0}, tree.nodes.size(), [&](size_t i) {
      bvh.nodes[node + i] = tree.nodes[i];
      for (uint32_t& child : bvh.nodes[node + i].child) child = MoveChild(child, node, block);
    });
    std::copy_n(tree.blocks.data(), tree.blocks.size(), bvh.blocks.data() + block);
    node += static_cast<uint32_t>(tree.nodes.size());
    block += static_cast<uint32_t>(tree.blocks.size());
  }
}

// The world's tree first, then those of the objects that have instances.
std::vector<Part> BuildParts(const Scene& scene, const BuildOptions& options, Bvh& bvh) {
  std::vector<uint32_t> used(scene.objects.size(), 0);
  for (const InstanceRecord& instance : scene.instances) used[instance.object] = 1;
  std::vector<uint32_t> objects;
  for (uint32_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) objects.push_back(i);
  }
  std::vector<Part> parts(1 + objects.size());
  bvh.objects.resize(scene.objects.size());
  tbb::parallel_for(size_t{0}, objects.size(), [&](size_t i) {
    const Object& object = scene.objects[objects[i]];
    const PrimSource source{{{object.first_triangle, object.triangle_count}},
                            {{object.first_sphere, object.sphere_count}}};
    parts[1 + i] = BuildPart(scene, source, options, bvh);
    bvh.objects[objects[i]] = MakeObjectRecord(parts[1 + i].box);
  });
  parts[0] = BuildPart(scene, {WorldTriangles(scene), WorldSpheres(scene), true}, options, bvh);
  size_t root = parts[0].tree.nodes.size();
  for (size_t i = 0; i < objects.size(); ++i) {
    bvh.objects[objects[i]].root = static_cast<uint32_t>(root);
    root += parts[1 + i].tree.nodes.size();
  }
  return parts;
}

}  // namespace

Result<Bvh> BuildBvh(const Scene& scene, const BuildOptions& options) {
  const size_t prim_count = scene.triangle_count() + scene.spheres.size() + scene.instances.size();
  if (prim_count > kBlockIndexMask || scene.instances.size() > kMaxInstances) {
    return Error{"the scene has " + std::to_string(prim_count) +
                 " primitives and instances; the limit is " + std::to_string(kBlockIndexMask) +
                 ", of instances " + std::to_string(kMaxInstances) +
                 ": split the scene or simplify its meshes"};
  }
  Bvh bvh;
  bvh.spheres = scene.spheres.data();
  bvh.instances = scene.instances.data();
  bvh.triangle_count = static_cast<uint32_t>(scene.triangle_count());
  bvh.sphere_count = static_cast<uint32_t>(scene.spheres.size());
  for (const SphereRecord& sphere : scene.spheres) {
    const Box3 box = SphereBox(sphere);
    bvh.sphere_boxes.insert(bvh.sphere_boxes.end(), box.lower, box.lower + 3);
    bvh.sphere_boxes.insert(bvh.sphere_boxes.end(), box.upper, box.upper + 3);
  }
  std::vector<Part> parts = BuildParts(scene, options, bvh);
  Join(parts, bvh);
  return bvh;
}

}  // namespace swell
