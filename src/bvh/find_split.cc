// References in, the best plane to part them by in the surface area heuristic out.
#include "src/bvh/find_split.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <utility>

#include "src/bvh/prim_boxes.h"

namespace swell {
namespace {

constexpr size_t kGrain = 8192;  // references of one task where a pass is parallel
constexpr uint32_t kMaxBins = 32;
constexpr uint32_t kSpatialBins = 16;

struct Bin {
  Bounds4 box;
  RefCount count;

  void Add(const Bin& other) {
    box.Add(other.box);
    count.Add(other.count);
  }
  float Cost() const { return count.all() == 0 ? 0.0f : box.HalfArea() * count.Tests(); }
};

// `add_rows(first, last, sum)` over all rows, in parallel where it pays. Sums and minima are
// exact, so the order does not matter.
template <class T, class AddRows> T Reduce(size_t count, const T& zero, const AddRows& add_rows) {
  T sum = zero;
  if (count < 2 * kGrain) {
    add_rows(0, count, sum);
    return sum;
  }
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, count, kGrain), zero,
      [&](const tbb::blocked_range<size_t>& r, T part) {
        add_rows(r.begin(), r.end(), part);
        return part;
      },
      [](T a, const T& b) {
        a.Add(b);
        return a;
      });
}

RefCount One(const Reference& ref) { return ref.is_sphere() ? RefCount{0, 1} : RefCount{1, 0}; }

template <uint32_t kCapacity> struct Bins {
  explicit Bins(uint32_t bins_used) : bins(bins_used) {}
  void Add(const Bins& other) {
    for (int k = 0; k < 3; ++k) {
      for (uint32_t b = 0; b < bins; ++b) bin[k][b].Add(other.bin[k][b]);
    }
  }
  uint32_t bins;
  Bin bin[3][kCapacity];
};

template <uint32_t kCapacity>
ObjectSplit BestObjectSplit(const Bins<kCapacity>& bins, const BinMap& map) {
  ObjectSplit best;
  for (int k = 0; k < 3; ++k) {
    if (map.scale[k] == 0.0f) continue;
    Bin right[kCapacity + 1];
    for (uint32_t b = bins.bins - 1; b > 0; --b) {
      right[b] = bins.bin[k][b];
      if (b + 1 < bins.bins) right[b].Add(right[b + 1]);
    }
    Bin left;
    for (uint32_t b = 1; b < bins.bins; ++b) {
      left.Add(bins.bin[k][b - 1]);
      if (left.count.all() == 0 || right[b].count.all() == 0) continue;
      const float cost = left.Cost() + right[b].Cost();
      if (cost < best.cost) best = {k, static_cast<int>(b), cost, left.box, right[b].box};
    }
  }
  return best;
}

template <uint32_t kCapacity>
ObjectSplit FindObjectSplitIn(std::span<const Reference> refs, const BinMap& map) {
  const Bins<kCapacity> zero(map.bins);
  return BestObjectSplit(Reduce(refs.size(), zero,
                                [&](size_t first, size_t last, Bins<kCapacity>& sum) {
                                  for (size_t i = first; i < last; ++i) {
                                    const Bin one = {refs[i].box(), One(refs[i])};
                                    const Int4 at = map.BinsOf(CentreOf(one.box));
                                    for (int k = 0; k < 3; ++k) sum.bin[k][at[k]].Add(one);
                                  }
                                }),
                         map);
}

// Parts of references by bins of space; a reference is counted where it begins and where it ends.
struct SpatialBins {
  void Add(const SpatialBins& other) {
    for (int k = 0; k < 3; ++k) {
      for (uint32_t b = 0; b < kSpatialBins; ++b) {
        box[k][b].Add(other.box[k][b]);
        begins[k][b].Add(other.begins[k][b]);
        ends[k][b].Add(other.ends[k][b]);
      }
    }
  }
  Bounds4 box[3][kSpatialBins];
  RefCount begins[3][kSpatialBins], ends[3][kSpatialBins];
};

// Bins of space and the planes between them; plane b is the lower end of bin b.
struct SpatialMap : BinMap {
  explicit SpatialMap(const Bounds4& box) : BinMap(box, kSpatialBins) {
    for (int k = 0; k < 3; ++k) {
      const float width = scale[k] == 0.0f ? 0.0f : 1.0f / scale[k];
      for (uint32_t b = 0; b < kSpatialBins; ++b) {
        planes[k][b] = lower[k] + static_cast<float>(b) * width;
      }
    }
  }
  float planes[3][kSpatialBins];
};

// The triangle of a reference, to be cut by planes. Roundings do not matter for choosing a plane.
struct Corners {
  Corners(const Scene& scene, uint32_t triangle) {
    for (size_t k = 0; k < 3; ++k) {
      const float* p = &scene.positions[3 * size_t{scene.indices[3 * size_t{triangle} + k]}];
      at[k] = Float4{p[0], p[1], p[2], 0.0f};
    }
  }
  Float4 at[3];
};

// Boxes of a triangle's parts in the bins [first, last] of an axis: its edges, from plane to plane.
void CutByBins(const Corners& corners, const SpatialMap& map, int axis, int first, int last,
               Bounds4 (&parts)[kSpatialBins]) {
  for (int b = first; b <= last; ++b) parts[b] = Bounds4();
  for (size_t k = 0; k < 3; ++k) {
    Float4 from = corners.at[k], to = corners.at[k == 2 ? 0 : k + 1];
    if (from[axis] > to[axis]) std::swap(from, to);
    const int begin = std::clamp(map.BinsOf(from)[axis], first, last);
    const int end = std::clamp(map.BinsOf(to)[axis], first, last);
    const Float4 edge = to - from;
    const float per_length = begin == end ? 0.0f : 1.0f / edge[axis];
    Bounds4 part = parts[begin];
    part.AddPoint(from);
    for (int b = begin; b < end; ++b) {
      const Float4 p = from + edge * Splat((map.planes[axis][b + 1] - from[axis]) * per_length);
      part.AddPoint(p);
      parts[b] = part;
      part = parts[b + 1];
      part.AddPoint(p);
    }
    part.AddPoint(to);
    parts[end] = part;
  }
}

void AddToBins(const Scene& scene, const Reference& ref, const SpatialMap& map, SpatialBins& sum) {
  const Bounds4 box = ref.box();
  const RefCount one = One(ref);
  const Int4 first = map.BinsOf(box.lower), last = map.BinsOf(box.upper);
  const bool one_bin = first[0] == last[0] && first[1] == last[1] && first[2] == last[2];
  if (one_bin || ref.is_sphere()) {
    const Int4 centre = map.BinsOf(CentreOf(box) * Splat(0.5f));
    for (int k = 0; k < 3; ++k) {
      sum.box[k][centre[k]].Add(box);
      sum.begins[k][centre[k]].Add(one);
      sum.ends[k][centre[k]].Add(one);
    }
    return;
  }
  const Corners corners(scene, ref.prim());
  for (int k = 0; k < 3; ++k) {
    int begin = first[k], end = last[k];
    if (begin == end) {
      sum.box[k][begin].Add(box);
    } else {
      Bounds4 parts[kSpatialBins];
      CutByBins(corners, map, k, begin, end, parts);
      for (int b = begin; b <= end; ++b) parts[b] = Intersection(parts[b], box);
      while (begin < end && parts[begin].IsEmpty()) ++begin;
      while (begin < end && parts[end].IsEmpty()) --end;
      for (int b = begin; b <= end; ++b) sum.box[k][b].Add(parts[b]);
    }
    sum.begins[k][begin].Add(one);
    sum.ends[k][end].Add(one);
  }
}

}  // namespace

RefBounds BoundsOf(std::span<const Reference> refs) {
  return Reduce(refs.size(), RefBounds(), [&](size_t first, size_t last, RefBounds& sum) {
    RefBounds local = sum;
    for (size_t i = first; i < last; ++i) {
      const Bounds4 box = refs[i].box();
      local.box.Add(box);
      local.centres.AddPoint(CentreOf(box));
      local.spheres += refs[i].is_sphere();
    }
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

ObjectSplit FindObjectSplit(std::span<const Reference> refs, const BinMap& map) {
  return map.bins <= 16 ? FindObjectSplitIn<16>(refs, map) : FindObjectSplitIn<kMaxBins>(refs, map);
}

uint32_t MostCrossing(std::span<const Reference> refs, const Bounds4& box) {
  struct Crossings {
    void Add(const Crossings& other) {
      for (int k = 0; k < 3; ++k) {
        for (uint32_t b = 0; b <= kSpatialBins; ++b) change[k][b] += other.change[k][b];
      }
    }
    int change[3][kSpatialBins + 1] = {};  // from the plane before
  };
  const BinMap map(box, kSpatialBins);
  const Crossings all =
      Reduce(refs.size(), Crossings(), [&](size_t first, size_t last, Crossings& sum) {
        for (size_t i = first; i < last; ++i) {
          const Bounds4 ref = refs[i].box();
          const Int4 from = map.BinsOf(ref.lower), to = map.BinsOf(ref.upper);
          for (int k = 0; k < 3; ++k) {
            ++sum.change[k][from[k] + 1];
            --sum.change[k][to[k] + 1];
          }
        }
      });
  int most = 0;
  for (int k = 0; k < 3; ++k) {
    int crossing = 0;
    for (const int change : all.change[k]) most = std::max(most, crossing += change);
  }
  return static_cast<uint32_t>(most);
}

SpatialSplit FindSpatialSplit(const Scene& scene, std::span<const Reference> refs,
                              const Bounds4& box) {
  const SpatialMap map(box);
  const SpatialBins bins =
      Reduce(refs.size(), SpatialBins(), [&](size_t first, size_t last, SpatialBins& sum) {
        for (size_t i = first; i < last; ++i) AddToBins(scene, refs[i], map, sum);
      });
  SpatialSplit best;
  for (int k = 0; k < 3; ++k) {
    if (map.scale[k] == 0.0f) continue;
    Bin right[kSpatialBins + 1];
    for (int b = kSpatialBins - 1; b > 0; --b) {
      right[b] = right[b + 1];
      right[b].Add({bins.box[k][b], bins.ends[k][b]});
    }
    Bin left;
    for (int b = 1; b < static_cast<int>(kSpatialBins); ++b) {
      left.Add({bins.box[k][b - 1], bins.begins[k][b - 1]});
      if (left.count.all() == 0 || right[b].count.all() == 0) continue;
      const float cost = left.Cost() + right[b].Cost();
      if (cost >= best.cost) continue;
      best = {k, map.planes[k][b], cost, left.box, right[b].box, left.count, right[b].count};
    }
  }
  return best;
}

CutParts CutReference(const Scene& scene, const Reference& ref, int axis, float plane) {
  const Bounds4 box = ref.box();
  const Bounds4 none;
  if (box.upper[axis] <= plane) return {box, none};
  if (box.lower[axis] >= plane) return {none, box};
  const auto [left, right] = TriangleParts(scene, ref.prim(), axis, plane);
  return {Intersection(box, ToBounds4(left)), Intersection(box, ToBounds4(right))};
}

}  // namespace swell
