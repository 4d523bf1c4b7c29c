// References to primitives in, a binary tree by the surface area heuristic out, widened part by
// part.
#include "src/bvh/build_sah.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/base/check.h"
#include "src/bvh/find_split.h"
#include "src/bvh/halve_leaf.h"
#include "src/bvh/partition.h"
#include "src/bvh/sample.h"
#include "src/bvh/spatial_split.h"

namespace swell {
namespace {

// Below so many references fewer bins do: the expected costs of four scenes stay within 0.5 %.
constexpr uint32_t kFewRefs = 1024;
constexpr uint32_t kFewBins = 16;

// Cutting is tried in nodes of so many references where the children of the best other split
// overlap by this much of their parent. Cuts in smaller nodes take a sixth of the build and save
// rays 1 %.
constexpr uint32_t kLeastToCut = 256;
constexpr float kLeastOverlap = 0.35f;
// Where a plane cuts few references, the surfaces there could be parted without, and to cut them
// makes the tree worse: 13.5 instead of 11.9 expected tests in a room of meshes. A surface of n
// triangles has about sqrt(n) at a plane; pillars and slivers have six times as many (300k
// triangles: 101 tests instead of 140, with the room and a valley of 1M left as they were).
constexpr float kLeastCut = 0.02f;
constexpr float kLeastCutOfRoot = 3.0f;
// What to cut one reference of a node has to save, in half areas of the scene for every reference
// of the node: its memory. See docs/decisions/0008.
constexpr float kPriceOfCut = 2e-4f;
// What to halve a leaf's box has to save, in half areas of the scene: room in a wide node.
constexpr float kPriceOfHalf = 1e-4f;
// How much worse a cut may be that was found in a sample, whose planes are not the very best.
// Smaller samples without it: 300k pillars take 98 tests instead of 94. 1.4 cuts the meshes of a
// room.
constexpr float kSampleFavour = 1.06f;

constexpr size_t kMostParts = 4096;  // about; each has memory of its own from the system
// Below this no pass over references is parallel: a thread that waited for one within a part might
// begin another part, in the same scratch memory.
constexpr uint32_t kLargestPart = 8192;
// The memory of fewer references goes back to the system together, not part by part, as other cores
// are stopped for that: the room with two threads is at 1.07 of Embree's rate instead of 1.02.
constexpr uint32_t kLeastGivenBack = 32768;

struct Range {
  Reference* refs;
  uint32_t count;
  uint32_t spare;  // references that cutting may add
  uint32_t share;  // of the scene's primitives, for progress
  bool cut;        // primitives may be in other ranges, too
  RefBounds bounds;

  std::span<const Reference> span() const { return {refs, count}; }
};

struct Children {
  Range left, right;
  PageArray<Reference> storage;  // of both, if references were cut
};

class Builder {
 public:
  Builder(const Scene& scene, const BuildOptions& options, float root_area)
      : scene_(scene),
        options_(options),
        root_area_(root_area),
        part_size_(std::clamp(static_cast<uint32_t>(scene.triangle_count() / kMostParts),
                              std::min(options.parallel, kLargestPart), kLargestPart)) {}

  std::unique_ptr<UpperNode> BuildUpper(const Range& range, uint32_t level) {
    auto node = std::make_unique<UpperNode>();
    if (range.count < part_size_) {
      BinaryTree& tree = trees_.local();
      tree.nodes.clear();
      tree.prims.clear();
      tree.block_begins.clear();
      tree.cut = false;
      BuildLower(range, level, tree);
      node->box = tree.nodes[0].box;
      node->part = std::make_unique<TreePart>(Widen(tree));
      node->part->share = range.share;
      if (options_.progress != nullptr) {
        options_.progress->done += (kBuildSteps - 1) * uint64_t{range.share};
      }
      return node;
    }
    node->box = range.bounds.box;
    const Children children = Part(range, level);
    if (children.storage.size() > 0) GiveBack(range);
    const auto build = [&](const Range& child) {
      auto of_child = BuildUpper(child, level + 1);
      if (child.count < kLeastGivenBack && range.count >= kLeastGivenBack) GiveBack(child);
      return of_child;
    };
    tbb::parallel_invoke([&] { node->left = build(children.left); },
                         [&] { node->right = build(children.right); });
    return node;
  }

 private:
  // References that are used up or cut are not needed any more; the rest of their array is.
  static void GiveBack(const Range& range) {
    swell::GiveBack(range.refs, range.count * sizeof(Reference));
  }

  void BuildLower(const Range& range, uint32_t level, BinaryTree& tree) {
    SWELL_CHECK(level < kMaxBinaryDepth);
    const size_t at = tree.nodes.size();
    tree.nodes.push_back({range.bounds.box, 0, 0, 0, 0});
    const bool fits = range.bounds.spheres == 0 ? range.count <= kBlockWidth : range.count == 1;
    if (fits) {
      tree.nodes[at].leaf = AddLeaf(range, tree);
      if (range.cut && range.bounds.spheres == 0) {
        tree.cut = true;
        const float least = options_.cut_always ? 0.0f : kPriceOfHalf * root_area_;
        HalveLeaf(scene_, range.span(), least, at, tree);
      }
      return;
    }
    const Children children = Part(range, level);
    tree.nodes[at].left = static_cast<uint32_t>(tree.nodes.size());
    BuildLower(children.left, level + 1, tree);
    tree.nodes[at].right = static_cast<uint32_t>(tree.nodes.size());
    BuildLower(children.right, level + 1, tree);
  }

  uint32_t AddLeaf(const Range& range, BinaryTree& tree) const {
    if (range.refs[0].is_sphere()) {
      const uint32_t row = range.refs[0].prim() - static_cast<uint32_t>(scene_.triangle_count());
      const uint32_t spheres = static_cast<uint32_t>(scene_.spheres.size());
      if (row < spheres) return kLeafBit | kSphereLeafBit | row;
      return kLeafBit | kSphereLeafBit | kInstanceLeafBit | (row - spheres);
    }
    const uint32_t block = static_cast<uint32_t>(tree.block_begins.size());
    const uint32_t begin = static_cast<uint32_t>(tree.prims.size());
    tree.block_begins.push_back(begin);
    for (const Reference& ref : range.span()) {
      const auto first = tree.prims.begin() + begin;
      if (std::find(first, tree.prims.end(), ref.prim()) == tree.prims.end()) {
        tree.prims.push_back(ref.prim());
      }
    }
    const uint32_t count = static_cast<uint32_t>(tree.prims.size()) - begin;
    return kLeafBit | ((count - 1) << kBlockCountShift) | block;
  }

  // Halvings that `count` references need.
  static uint32_t LevelsOf(uint32_t count) { return std::bit_width(count - 1); }

  // Parts the range in two, neither empty. Every split leaves at most 2^(kMaxBinaryDepth - level -
  // 1) references to a side, those that cutting may add included, so that halving alone would stay
  // within the depth: the bound holds for the root, and below it is kept by halving once it is
  // reached.
  Children Part(const Range& range, uint32_t level) const {
    if (LevelsOf(range.count + range.spare) + level + 2 > kMaxBinaryDepth) return Halves(range);
    const uint32_t most = range.count < kFewRefs ? kFewBins : 32;
    const BinMap map(range.bounds.centres, std::clamp(options_.bins, 2u, most));
    const ObjectSplit split = FindObjectSplit(range.span(), map, kSplitSampleBits);
    Parted parted;
    if (split.axis >= 0) {
      const int axis = split.axis;
      const float lower = map.lower[axis], scale = map.scale[axis];
      const float bin = static_cast<float>(split.bin);
      parted = Partition(range.refs, range.count, [=](const Reference& ref) {
        return (ref.CentreOn(axis) - lower) * scale < bin;
      });
    }
    if (WorthCutting(range, parted)) {
      Children children;
      if (Cut(range, split, children)) return children;
    }
    if (parted.left > 0) return At(range, parted);
    if (range.bounds.spheres == 0 || range.bounds.spheres == range.count) {
      // Boxes with one centre all reach over to its side of any plane, so a cut would leave as many
      // there: to try at every level took six sevenths of a million coincident triangles' build.
      Range uncut = range;
      uncut.spare = 0;
      return Halves(uncut);
    }
    return At(range, Partition(range.refs, range.count,
                               [](const Reference& ref) { return !ref.is_sphere(); }));
  }

  static Children Halves(const Range& range) {
    const uint32_t left = range.count / 2;
    return At(range,
              {left, BoundsOf(range.span().first(left)), BoundsOf(range.span().subspan(left))});
  }

  static Children At(const Range& range, const Parted& parted) {
    const uint32_t left = parted.left;
    SWELL_CHECK(left > 0 && left < range.count);
    const uint32_t spare = PartOf(range.spare, left, range.count);
    const uint32_t share = PartOf(range.share, left, range.count);
    return {{range.refs, left, spare, share, range.cut, parted.of_left},
            {range.refs + left, range.count - left, range.spare - spare, range.share - share,
             range.cut, parted.of_right},
            {}};
  }

  static uint32_t PartOf(uint32_t whole, uint32_t count, uint32_t of) {
    return static_cast<uint32_t>(uint64_t{whole} * count / of);
  }

  bool WorthCutting(const Range& range, const Parted& parted) const {
    if (range.spare == 0) return false;
    if (parted.left == 0 || options_.cut_always) return true;
    if (range.count < kLeastToCut) return false;
    const Bounds4 overlap = Intersection(parted.of_left.box, parted.of_right.box);
    const float least =
        std::max(options_.overlap * root_area_, kLeastOverlap * range.bounds.box.HalfArea());
    return !overlap.IsEmpty() && overlap.HalfArea() > least;
  }

  // Fills `children` if cutting is better than `other`, and within what the range may add.
  bool Cut(const Range& range, const ObjectSplit& other, Children& children) const {
    const float count = static_cast<float>(range.count);
    const float least = options_.cut_always
                            ? 0.0f
                            : std::min(kLeastCut * count, kLeastCutOfRoot * std::sqrt(count));
    if (MostCrossing(range.span(), range.bounds.box) < least) return false;
    const SpatialSplit split = FindSpatialSplit(scene_, range.span(), range.bounds.box);
    if (split.axis < 0) return false;
    const float weight =
        count + static_cast<float>(range.bounds.spheres) * static_cast<float>(kBlockWidth - 1);
    const float added = split.left_weight + split.right_weight - weight;
    const float better = range.count > 1u << kCutSampleBits ? kSampleFavour : 1.0f;
    const bool pays = split.cost < better * other.cost && added >= least;
    if (added > static_cast<float>(range.spare) || !(pays || options_.cut_always)) return false;
    const float price_of_cut = options_.cut_always ? 0.0f : kPriceOfCut * root_area_ * count;
    CutResult cut = CutReferences(scene_, range.span(), split, price_of_cut);
    const uint32_t left = static_cast<uint32_t>(cut.left.size());
    const uint32_t right = static_cast<uint32_t>(cut.right.size());
    const uint32_t most = range.count + range.spare;
    if (left == 0 || right == 0 || left >= range.count || right >= range.count ||
        left + right > most) {
      return false;
    }
    const uint32_t rest = most - left - right;
    const uint32_t left_rest = PartOf(rest, left, left + right);
    const uint32_t share = PartOf(range.share, left, left + right);
    children.left = {cut.left.data(), left, left_rest, share, true, BoundsOf(cut.left)};
    children.right = {cut.right.data(),    right, rest - left_rest,
                      range.share - share, true,  BoundsOf(cut.right)};
    children.storage = std::move(cut.refs);
    return true;
  }

  const Scene& scene_;
  const BuildOptions& options_;
  const float root_area_;
  const uint32_t part_size_;
  tbb::enumerable_thread_specific<BinaryTree> trees_;
};

}  // namespace

std::unique_ptr<UpperNode> BuildSah(const Scene& scene, std::span<Reference> refs,
                                    const BuildOptions& options) {
  const uint32_t count = static_cast<uint32_t>(refs.size());
  SWELL_CHECK(count > 0);
  const uint32_t spare = static_cast<uint32_t>(static_cast<double>(count) * options.most_cuts);
  const Range range = {refs.data(), count, spare, count, false, BoundsOf(refs)};
  return Builder(scene, options, range.bounds.box.HalfArea()).BuildUpper(range, 0);
}

}  // namespace swell
