// The references of a leaf in, boxes that hold them part by part out.
#include "src/bvh/halve_leaf.h"

#include <algorithm>

#include "src/bvh/spatial_split.h"

namespace swell {
namespace {

constexpr uint32_t kMostLevels = 3;  // a wide node's worth of parts

struct Half {
  Reference refs[kBlockWidth];
  uint32_t count = 0;
  Bounds4 box;

  std::span<const Reference> span() const { return {refs, count}; }
  void Add(const Bounds4& part, uint32_t prim) {
    if (part.IsEmpty()) return;
    refs[count++] = Reference(part, prim, false);
    box.Add(part);
  }
};

int LongestAxis(const Bounds4& box) {
  const Float4 extent = box.upper - box.lower;
  const int xy = extent[0] < extent[1] ? 1 : 0;
  return extent[xy] < extent[2] ? 2 : xy;
}

class Halver {
 public:
  Halver(const Scene& scene, float least, BinaryTree& tree)
      : scene_(scene), least_(least), tree_(tree) {}

  void Halve(std::span<const Reference> refs, size_t at, uint32_t levels) {
    const Bounds4 box = tree_.nodes[at].box;
    const float most = box.HalfArea() - least_;
    if (levels == 0 || !(most > 0.0f)) return;
    const int axis = LongestAxis(box);
    const float plane = 0.5f * box.lower[axis] + 0.5f * box.upper[axis];
    Half left, right;
    for (const Reference& ref : refs) {
      const CutParts parts = CutReference(scene_, ref, axis, plane);
      if (parts.left.IsEmpty() && parts.right.IsEmpty()) return;  // all in the margin
      left.Add(parts.left, ref.prim());
      right.Add(parts.right, ref.prim());
    }
    if (left.count == 0 || right.count == 0) return;
    if (!(left.box.HalfArea() + right.box.HalfArea() < most)) return;
    tree_.nodes[at].left = AddHalf(left, at, levels);
    tree_.nodes[at].right = AddHalf(right, at, levels);
  }

 private:
  uint32_t AddHalf(const Half& half, size_t parent, uint32_t levels) {
    const size_t at = tree_.nodes.size();
    tree_.nodes.push_back({half.box, 0, 0, LeafOf(half, tree_.nodes[parent].leaf), 0});
    Halve(half.span(), at, levels - 1);
    return static_cast<uint32_t>(at);
  }

  // The same block, up to the last triangle that has a part here.
  uint32_t LeafOf(const Half& half, uint32_t whole) const {
    const auto first = tree_.prims.begin() + tree_.block_begins[LeafBlock(whole)];
    uint32_t last = 0;
    for (const Reference& ref : half.span()) {
      const auto at = std::find(first, tree_.prims.end(), ref.prim());
      last = std::max(last, static_cast<uint32_t>(at - first));
    }
    return kLeafBit | (last << kBlockCountShift) | LeafBlock(whole);
  }

  const Scene& scene_;
  const float least_;
  BinaryTree& tree_;
};

}  // namespace

void HalveLeaf(const Scene& scene, std::span<const Reference> refs, float least, size_t at,
               BinaryTree& tree) {
  Halver(scene, least, tree).Halve(refs, at, kMostLevels);
}

}  // namespace swell
