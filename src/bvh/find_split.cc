// References in, the best plane to part them by in the surface area heuristic out.
#include "src/bvh/find_split.h"

#include "src/bvh/sample.h"

namespace swell {
namespace {

constexpr uint32_t kMaxBins = 32;

template <uint32_t kCapacity>
ObjectSplit FindObjectSplitIn(std::span<const Reference> refs, const BinMap& map,
                              uint32_t sample_bits) {
  Bounds4 boxes[kCapacity][3];
  Int4 weights[kCapacity];
  for (uint32_t b = 0; b < map.bins; ++b) {
    for (Bounds4& box : boxes[b]) box = Bounds4();
    weights[b] = Int4{};
  }
  const Sample sample(refs.size(), sample_bits);
  for (size_t i = 0; i < sample.size(); ++i) {
    const Reference& ref = refs[sample.Row(i)];
    const Bounds4 box = ref.box();
    const int weight = static_cast<int>(WeightOf(ref));
    const Int4 at = map.BinsOf(CentreOf(box));
    for (int k = 0; k < 3; ++k) {
      boxes[at[k]][k].Add(box);
      weights[at[k]][k] += weight;
    }
  }

  const int bins = static_cast<int>(map.bins);
  Float4 right_costs[kCapacity];
  Sides right;
  for (int b = bins - 1; b > 0; --b) {
    right.Add(boxes[b], weights[b]);
    right_costs[b] = right.Costs();
  }
  BestBins best;
  Sides left;
  for (int b = 1; b < bins; ++b) {
    left.Add(boxes[b - 1], weights[b - 1]);
    best.Try(left.Costs() + right_costs[b], b);
  }

  ObjectSplit split;
  split.axis = best.Axis();
  if (split.axis < 0) return split;
  split.bin = best.bin(split.axis);
  split.cost = best.cost(split.axis) * sample.rows_each();
  return split;
}

}  // namespace

RefBounds BoundsOf(std::span<const Reference> refs) {
  return Reduce(refs.size(), RefBounds(), [&](size_t first, size_t last, RefBounds& sum) {
    RefBounds local = sum;
    for (size_t i = first; i < last; ++i) local.Add(refs[i]);
    sum = local;
  });
}

BinMap::BinMap(const Bounds4& range, uint32_t bins_asked) : lower(range.lower), bins(bins_asked) {
  for (int k = 0; k < 3; ++k) {
    const float extent = range.upper[k] - range.lower[k];
    scale[k] = extent > 0x1p-100f ? static_cast<float>(bins) * 0.9999f / extent : 0.0f;
  }
  lower[3] = scale[3] = 0.0f;
}

ObjectSplit FindObjectSplit(std::span<const Reference> refs, const BinMap& map,
                            uint32_t sample_bits) {
  return map.bins <= 16 ? FindObjectSplitIn<16>(refs, map, sample_bits)
                        : FindObjectSplitIn<kMaxBins>(refs, map, sample_bits);
}

}  // namespace swell
