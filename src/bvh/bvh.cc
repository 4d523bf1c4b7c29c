// A scene in, its wide tree out: boxes, the binary tree, the wide nodes and the leaf blocks.
#include "src/bvh/bvh.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/base/check.h"
#include "src/bvh/build_sah.h"
#include "src/bvh/prim_boxes.h"
#include "src/bvh/widen.h"
#include "src/scene/objects.h"

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
template class PageArray<BuildPrim>;
template class PageArray<BinaryNode>;

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

PageArray<BuildPrim> WithBoxes(PageArray<BuildPrim> prims) {
  const auto has_box = [](const BuildPrim& prim) { return prim.box.lower[0] <= prim.box.upper[0]; };
  const auto count =
      static_cast<size_t>(std::count_if(prims.data(), prims.data() + prims.size(), has_box));
  if (count == prims.size()) return prims;
  PageArray<BuildPrim> kept(count);
  std::copy_if(prims.data(), prims.data() + prims.size(), kept.data(), has_box);
  return kept;
}

PageArray<BuildPrim> MakePrims(const Scene& scene, const PrimSource& source, const Bvh& bvh) {
  size_t count = source.instances ? scene.instances.size() : 0;
  for (const RowRange& range : source.triangles) count += range.count;
  for (const RowRange& range : source.spheres) count += range.count;
  PageArray<BuildPrim> prims(count);
  size_t at = 0;
  const auto add = [&](const RowRange& range, size_t first_prim, bool leaf, const auto& box_of) {
    tbb::parallel_for(size_t{0}, range.count, [&](size_t i) {
      const auto prim = static_cast<uint32_t>(first_prim + range.first + i);
      prims[at + i] = {box_of(range.first + i), prim, leaf ? 1u : 0u};
    });
    at += range.count;
  };
  for (const RowRange& range : source.triangles) {
    add(range, 0, false, [&](size_t i) { return TriangleBox(scene, i); });
  }
  for (const RowRange& range : source.spheres) {
    add(range, bvh.triangle_count, true, [&](size_t i) { return SphereBox(scene.spheres[i]); });
  }
  if (!source.instances) return prims;
  add({0, scene.instances.size()}, size_t{bvh.triangle_count} + bvh.sphere_count, true,
      [&](size_t i) {
        const InstanceRecord& instance = scene.instances[i];
        return InstanceBox3(instance, bvh.objects[instance.object]).value_or(kNoBox);
      });
  return WithBoxes(std::move(prims));
}

Part BuildPart(const Scene& scene, const PrimSource& source, const BuildOptions& options,
               const Bvh& bvh) {
  Part part;
  part.tree.triangle_count = bvh.triangle_count;
  part.tree.sphere_count = bvh.sphere_count;
  PageArray<BuildPrim> prims = MakePrims(scene, source, bvh);
  if (prims.size() == 0) {
    MakeEmpty(part.tree);
    part.box = {{0, 0, 0}, {0, 0, 0}};
    return part;
  }
  const BinaryTree binary = BuildSah(std::move(prims), options);
  part.box = binary.nodes[0].box;
  Widen(binary, scene, part.tree);
  return part;
}

// A reference of a tree whose nodes and blocks come to stand behind others.
uint32_t Moved(uint32_t child, uint32_t nodes, uint32_t blocks) {
  if ((child & kLeafBit) == 0) return child + nodes;
  return (child & kSphereLeafBit) == 0 ? child + blocks : child;
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
      for (uint32_t& child : bvh.nodes[node + i].child) child = Moved(child, node, block);
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
