// Boxes of primitives in, a binary tree by the surface area heuristic out.
#include "src/bvh/build_sah.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <bit>
#include <cmath>

#include "src/base/check.h"

namespace swell {
namespace {

constexpr uint32_t kMaxBins = 64;
// Below so many primitives fewer bins do: 0.87 of the time of 32 bins everywhere (131k triangles,
// one thread), and no rays a second lost that could be measured.
constexpr uint32_t kFewPrims = 128;
constexpr uint32_t kFewBins = 16;
constexpr size_t kGrain = 8192;  // primitives of one task where a pass is parallel

struct Bin {
  Box3 box;
  uint32_t triangles = 0, spheres = 0;

  void Add(const Bin& bin) {
    box.Add(bin.box);
    triangles += bin.triangles;
    spheres += bin.spheres;
  }
  uint32_t count() const { return triangles + spheres; }
  // Of testing all primitives, in tests of a block.
  float Cost() const {
    if (count() == 0) return 0.0f;
    return box.HalfArea() *
           static_cast<float>((triangles + kBlockWidth - 1) / kBlockWidth + spheres);
  }
};

struct Range {
  BuildPrim* prims;
  BuildPrim* spare;  // as many rows, free to use
  uint32_t first, count;
};

// What a node knows of its primitives.
struct Bounds {
  Box3 box;
  Box3 centres;  // of Box3::Centre
  uint32_t spheres = 0;

  void Add(const Bounds& other) {
    box.Add(other.box);
    centres.Add(other.centres);
    spheres += other.spheres;
  }
  void Add(const BuildPrim& prim) {
    const float centre[3] = {prim.box.Centre(0), prim.box.Centre(1), prim.box.Centre(2)};
    box.Add(prim.box);
    centres.AddPoint(centre);
    spheres += prim.is_sphere;
  }
};

// Sums and minima over rows [0, count), in parallel where it pays; exact, so in any order.
template <class T, class AddRow> T Reduce(size_t count, const T& zero, const AddRow& add_row) {
  const auto rows = [&](size_t first, size_t last, T sum) {
    for (size_t i = first; i < last; ++i) add_row(i, sum);
    return sum;
  };
  if (count < 2 * kGrain) {
    T sum = zero;
    for (size_t i = 0; i < count; ++i) add_row(i, sum);
    return sum;
  }
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, count, kGrain), zero,
      [&](const tbb::blocked_range<size_t>& r, T sum) { return rows(r.begin(), r.end(), sum); },
      [](T a, const T& b) {
        a.Add(b);
        return a;
      });
}

template <uint32_t kCapacity> struct Bins {
  Bin bin[3][kCapacity];
  uint32_t bins;

  void Add(const Bins& other) {
    for (int k = 0; k < 3; ++k) {
      for (uint32_t b = 0; b < bins; ++b) bin[k][b].Add(other.bin[k][b]);
    }
  }
};

// Maps a centre to its bin; monotone.
struct Binning {
  float lower[3], scale[3];
  uint32_t bins;

  Binning(const Box3& centres, uint32_t bins_asked) : bins(bins_asked) {
    for (int k = 0; k < 3; ++k) {
      const float extent = centres.upper[k] - centres.lower[k];
      lower[k] = centres.lower[k];
      scale[k] = extent > 0x1p-100f ? static_cast<float>(bins) * 0.9999f / extent : 0.0f;
    }
  }
  uint32_t BinOf(const Box3& box, int k) const {
    const float at = (box.Centre(k) - lower[k]) * scale[k];
    return std::min(static_cast<uint32_t>(at), bins - 1);
  }
};

struct Split {
  int axis = -1;  // none: all centres coincide
  uint32_t bin;   // the right side begins with this bin
  float cost = std::numeric_limits<float>::infinity();
};

template <uint32_t kCapacity> Split BestSplit(const Bins<kCapacity>& bins, const Binning& binning) {
  Split best;
  for (int k = 0; k < 3; ++k) {
    if (binning.scale[k] == 0.0f) continue;
    float right_cost[kCapacity];
    Bin right;
    for (uint32_t b = bins.bins - 1; b > 0; --b) {
      right.Add(bins.bin[k][b]);
      right_cost[b] = right.Cost();
    }
    const uint32_t all = right.count() + bins.bin[k][0].count();
    Bin left;
    for (uint32_t b = 1; b < bins.bins; ++b) {
      left.Add(bins.bin[k][b - 1]);
      if (left.count() == 0 || left.count() == all) continue;
      const float cost = left.Cost() + right_cost[b];
      if (cost < best.cost) best = {k, b, cost};
    }
  }
  return best;
}

// Rows for which goes_left holds first, all in their order. Uses and swaps the spare rows where the
// pass is parallel.
template <class GoesLeft> uint32_t Partition(Range& range, const GoesLeft& goes_left) {
  BuildPrim* prims = range.prims + range.first;
  if (range.count < 2 * kGrain) {
    return static_cast<uint32_t>(std::partition(prims, prims + range.count, goes_left) - prims);
  }
  const size_t chunks = (range.count + kGrain - 1) / kGrain;
  std::vector<uint32_t> left(chunks + 1, 0);
  const auto last = [&](size_t chunk) {
    return std::min<size_t>(range.count, (chunk + 1) * kGrain);
  };
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    uint32_t count = 0;
    for (size_t i = chunk * kGrain; i < last(chunk); ++i) count += goes_left(prims[i]);
    left[chunk + 1] = count;
  });
  for (size_t chunk = 0; chunk < chunks; ++chunk) left[chunk + 1] += left[chunk];
  const size_t middle = left[chunks];
  BuildPrim* spare = range.spare + range.first;
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    size_t l = left[chunk], r = middle + chunk * kGrain - l;
    for (size_t i = chunk * kGrain; i < last(chunk); ++i) {
      spare[goes_left(prims[i]) ? l++ : r++] = prims[i];
    }
  });
  std::swap(range.prims, range.spare);
  return static_cast<uint32_t>(middle);
}

class Builder {
 public:
  Builder(const BuildOptions& options, BinaryTree& tree) : options_(options), tree_(tree) {}

  // Writes the subtree of `range` to nodes from `at` on. Every split leaves at most
  // 2^(kMaxBinaryDepth - level - 1) primitives to a side, so that halving alone would stay within
  // the depth: the bound holds for the root, and below it is kept by halving once it is reached.
  void Build(Range range, uint32_t at, uint32_t level) {
    SWELL_CHECK(level < kMaxBinaryDepth);
    const BuildPrim* prims = range.prims + range.first;
    const Bounds bounds =
        Reduce(range.count, Bounds(), [&](size_t i, Bounds& sum) { sum.Add(prims[i]); });
    tree_.nodes[at] = {bounds.box, range.first, range.count, 0};
    const bool fits = bounds.spheres == 0 ? range.count <= kBlockWidth : range.count == 1;
    if (fits) {
      Finish(range);
      return;
    }
    const uint32_t left = DoSplit(range, bounds, level);
    tree_.nodes[at].right = at + 2 * left;
    Range left_range = range, right_range = range;
    left_range.count = left;
    right_range.first += left;
    right_range.count -= left;
    const auto build_left = [&] { Build(left_range, at + 1, level + 1); };
    const auto build_right = [&] { Build(right_range, at + 2 * left, level + 1); };
    if (range.count >= options_.parallel) {
      tbb::parallel_invoke(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
  }

 private:
  // Halvings that `count` primitives need.
  static uint32_t LevelsOf(uint32_t count) { return std::bit_width(count - 1); }

  // Reorders the range; returns how many go left, at least one and not all.
  uint32_t DoSplit(Range& range, const Bounds& bounds, uint32_t level) const {
    if (LevelsOf(range.count) + level + 2 > kMaxBinaryDepth) return range.count / 2;
    const uint32_t most = range.count < kFewPrims ? kFewBins : kMaxBins;
    const Binning binning(bounds.centres, std::clamp(options_.bins, 2u, most));
    const Split split = range.count < kFewPrims ? FindSplit<kFewBins>(range, binning)
                                                : FindSplit<kMaxBins>(range, binning);
    uint32_t left;
    if (split.axis >= 0) {
      left = Partition(range, [&](const BuildPrim& prim) {
        return binning.BinOf(prim.box, split.axis) < split.bin;
      });
    } else {
      left = Partition(range, [](const BuildPrim& prim) { return prim.is_sphere == 0; });
      if (left == 0 || left == range.count) left = range.count / 2;
    }
    SWELL_CHECK(left > 0 && left < range.count);
    return left;
  }

  template <uint32_t kCapacity> static Split FindSplit(const Range& range, const Binning& binning) {
    const BuildPrim* prims = range.prims + range.first;
    Bins<kCapacity> zero;
    zero.bins = binning.bins;
    return BestSplit(Reduce(range.count, zero,
                            [&](size_t i, Bins<kCapacity>& sum) {
                              Bin one;
                              one.box = prims[i].box;
                              one.spheres = prims[i].is_sphere;
                              one.triangles = 1 - prims[i].is_sphere;
                              for (int k = 0; k < 3; ++k) {
                                sum.bin[k][binning.BinOf(prims[i].box, k)].Add(one);
                              }
                            }),
                     binning);
  }

  // A leaf's rows belong into tree_.prims, wherever the last partition left them.
  void Finish(const Range& range) {
    BuildPrim* to = tree_.prims.data();
    if (range.prims == to) return;
    std::copy_n(range.prims + range.first, range.count, to + range.first);
  }

  const BuildOptions& options_;
  BinaryTree& tree_;
};

}  // namespace

BinaryTree BuildSah(PageArray<BuildPrim> prims, const BuildOptions& options) {
  const uint32_t count = static_cast<uint32_t>(prims.size());
  SWELL_CHECK(count > 0);
  PageArray<BuildPrim> spare(count);
  BinaryTree tree{PageArray<BinaryNode>(2 * size_t{count} - 1), std::move(prims)};
  Builder(options, tree).Build({tree.prims.data(), spare.data(), 0, count}, 0, 0);
  return tree;
}

}  // namespace swell
