// References in, the best plane to cut them by in the surface area heuristic, and their parts, out.
#include "src/bvh/spatial_split.h"

#include <algorithm>

#include "src/bvh/find_split.h"
#include "src/bvh/prim_boxes.h"
#include "src/bvh/sample.h"

namespace swell {
namespace {

constexpr int kSpatialBins = 16;

// Parts of references by bins of space; a reference is counted where it begins and where it ends.
struct SpatialBins {
  Bounds4 box[kSpatialBins][3];
  Int4 begins[kSpatialBins] = {}, ends[kSpatialBins] = {};  // weights, an axis a lane
};

// Bins of space and the planes between them; plane b is the lower end of bin b.
struct SpatialMap : BinMap {
  explicit SpatialMap(const Bounds4& box) : BinMap(box, kSpatialBins) {
    for (int k = 0; k < 3; ++k) {
      const float width = scale[k] == 0.0f ? 0.0f : 1.0f / scale[k];
      for (int b = 0; b < kSpatialBins; ++b) {
        planes[k][b] = lower[k] + static_cast<float>(b) * width;
      }
    }
  }
  float planes[3][kSpatialBins];
};

using Double4 = double __attribute__((vector_size(32)));

// The edges of a reference's triangle, to be cut by planes. Roundings do not matter for choosing a
// plane.
struct Edges {
  Edges(const Scene& scene, uint32_t triangle) {
    Float4 corner[3];
    for (size_t k = 0; k < 3; ++k) {
      corner[k] = VertexOf(scene, triangle, k);
    }
    for (size_t k = 0; k < 3; ++k) {
      const Float4 to = corner[k == 2 ? 0 : k + 1];
      from[k] = corner[k];
      edge[k] = to - corner[k];
      per_length[k] = Splat(1.0f) / edge[k];
    }
  }
  Float4 from[3], edge[3], per_length[3];
};

// Cuts a triangle by planes across an axis, from the lowest to the highest.
class Slicer {
 public:
  Slicer(const Edges& edges, int axis, float lowest) : edges_(edges), axis_(axis) {
    for (int k = 0; k < 3; ++k) MoveTo(k, lowest);
  }

  // The box of what is between the plane before and this one, without its extent along the axis.
  Bounds4 SliceTo(float plane) {
    Bounds4 box;
    for (int k = 0; k < 3; ++k) {
      const Float4 along_before = along_[k], before = point_[k];
      MoveTo(k, plane);
      const Int4 misses = along_before == along_[k];
      box.lower = Min(NotWhere(misses, Min(before, point_[k])), box.lower);
      box.upper = Max(NotWhere(misses, Max(before, point_[k])), box.upper);
    }
    return box;
  }

 private:
  // NaN there, which Min and Max drop if it comes first.
  static Float4 NotWhere(Int4 mask, Float4 p) {
    return std::bit_cast<Float4>(std::bit_cast<Int4>(p) | mask);
  }
  // Where an edge meets the plane; the end that is nearer if it does not. An edge within the plane
  // is not a number times infinity, of which Max makes 0.
  void MoveTo(int k, float plane) {
    const float at = (plane - edges_.from[k][axis_]) * edges_.per_length[k][axis_];
    along_[k] = Min(Max(Splat(at), Float4{}), Splat(1.0f));
    point_[k] = edges_.from[k] + edges_.edge[k] * along_[k];
  }

  const Edges& edges_;
  const int axis_;
  Float4 along_[3], point_[3];  // from 0 to 1 along each edge, and where that is
};

void AddWhole(const Reference& ref, const Bounds4& box, const SpatialMap& map, SpatialBins& sum) {
  const Int4 centre = map.BinsOf(CentreOf(box) * Splat(0.5f));
  const int weight = static_cast<int>(WeightOf(ref));
  for (int k = 0; k < 3; ++k) {
    sum.box[centre[k]][k].Add(box);
    sum.begins[centre[k]][k] += weight;
    sum.ends[centre[k]][k] += weight;
  }
}

void AddToBins(const Scene& scene, const Reference& ref, const SpatialMap& map, SpatialBins& sum) {
  const Bounds4 box = ref.box();
  const Int4 first = map.BinsOf(box.lower), last = map.BinsOf(box.upper);
  const bool one_bin = first[0] == last[0] && first[1] == last[1] && first[2] == last[2];
  if (one_bin || ref.is_sphere()) return AddWhole(ref, box, map, sum);
  const Edges edges(scene, ref.prim());
  for (int k = 0; k < 3; ++k) {
    int begin = first[k], end = last[k];
    if (begin == end) {
      sum.box[begin][k].Add(box);
    } else {
      Bounds4 parts[kSpatialBins];
      Slicer slicer(edges, k, box.lower[k]);
      for (int b = begin; b <= end; ++b) {
        parts[b] = Intersection(slicer.SliceTo(b < end ? map.planes[k][b + 1] : box.upper[k]), box);
      }
      while (begin < end && parts[begin].IsEmpty()) ++begin;
      while (begin < end && parts[end].IsEmpty()) --end;
      for (int b = begin; b <= end; ++b) sum.box[b][k].Add(parts[b]);
    }
    ++sum.begins[begin][k];
    ++sum.ends[end][k];
  }
}

}  // namespace

float MostCrossing(std::span<const Reference> refs, const Bounds4& box) {
  const BinMap map(box, kSpatialBins);
  Int4 change[kSpatialBins + 1] = {};  // from the plane before
  const Sample sample(refs.size(), kCutSampleBits);
  for (size_t i = 0; i < sample.size(); ++i) {
    const Bounds4 ref = refs[sample.Row(i)].box();
    const Int4 from = map.BinsOf(ref.lower), to = map.BinsOf(ref.upper);
    for (int k = 0; k < 3; ++k) {
      ++change[from[k] + 1][k];
      --change[to[k] + 1][k];
    }
  }
  Int4 crossing = {}, most = {};
  for (const Int4& by : change) {
    crossing += by;
    most = crossing > most ? crossing : most;
  }
  return static_cast<float>(std::max({most[0], most[1], most[2]})) * sample.rows_each();
}

SpatialSplit FindSpatialSplit(const Scene& scene, std::span<const Reference> refs,
                              const Bounds4& box) {
  const SpatialMap map(box);
  SpatialBins bins;
  const Sample sample(refs.size(), kCutSampleBits);
  for (size_t i = 0; i < sample.size(); ++i) {
    AddToBins(scene, refs[sample.Row(i)], map, bins);
  }

  Float4 right_costs[kSpatialBins];
  Sides right;
  for (int b = kSpatialBins - 1; b > 0; --b) {
    right.Add(bins.box[b], bins.ends[b]);
    right_costs[b] = right.Costs();
  }
  BestBins best;
  Sides left;
  for (int b = 1; b < kSpatialBins; ++b) {
    left.Add(bins.box[b - 1], bins.begins[b - 1]);
    const Float4 costs = left.Costs() + right_costs[b];
    best.Try(costs, b);
  }

  SpatialSplit split;
  const int axis = best.Axis();
  if (axis < 0) return split;
  const int bin = best.bin(axis);
  split.axis = axis;
  split.plane = map.planes[axis][bin];
  split.cost = best.cost(axis) * sample.rows_each();
  int left_weight = 0, right_weight = 0;
  for (int b = 0; b < kSpatialBins; ++b) {
    (b < bin ? split.left : split.right).Add(bins.box[b][axis]);
    (b < bin ? left_weight : right_weight) += b < bin ? bins.begins[b][axis] : bins.ends[b][axis];
  }
  split.left_weight = static_cast<float>(left_weight) * sample.rows_each();
  split.right_weight = static_cast<float>(right_weight) * sample.rows_each();
  return split;
}

// No branch depends on where the vertices are.
CutParts CutTriangle(const Scene& scene, size_t triangle, int axis, float plane) {
  Float4 vertex[3];
  Int4 below[3], above[3];
  Bounds4 whole, left, right;
  const Bounds4 none;
  const auto add = [&](Float4 p, Int4 to_left, Int4 to_right) {
    left.lower = Min(left.lower, to_left ? p : none.lower);
    left.upper = Max(left.upper, to_left ? p : none.upper);
    right.lower = Min(right.lower, to_right ? p : none.lower);
    right.upper = Max(right.upper, to_right ? p : none.upper);
  };
  for (size_t k = 0; k < 3; ++k) {
    vertex[k] = VertexOf(scene, triangle, k);
    const Float4 at = Splat(vertex[k][axis]);
    below[k] = at < Splat(plane);
    above[k] = at > Splat(plane);
    whole.AddPoint(vertex[k]);
    add(vertex[k], ~above[k], ~below[k]);
  }
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = k == 2 ? 0 : k + 1;
    const Int4 crosses = (below[k] & above[next]) | (above[k] & below[next]);
    const Double4 from = __builtin_convertvector(vertex[k], Double4);
    const Double4 edge = __builtin_convertvector(vertex[next], Double4) - from;
    const double along = (double{plane} - from[axis]) / edge[axis];
    add(__builtin_convertvector(from + along * edge, Float4), crosses, crosses);
  }
  // What only touches the plane is part of the other side; what lies in it goes left.
  const bool any_left = (below[0] | below[1] | below[2])[0] != 0;
  const bool any_right = (above[0] | above[1] | above[2])[0] != 0;
  const float margin = MarginOf(whole);
  return {any_left || !any_right ? Widened(left, margin) : none,
          any_right ? Widened(right, margin) : none};
}

CutParts CutReference(const Scene& scene, const Reference& ref, int axis, float plane) {
  const Bounds4 box = ref.box();
  const Bounds4 none;
  if (box.upper[axis] <= plane) return {box, none};
  if (box.lower[axis] >= plane) return {none, box};
  const CutParts parts = CutTriangle(scene, ref.prim(), axis, plane);
  return {Intersection(box, parts.left), Intersection(box, parts.right)};
}

}  // namespace swell
