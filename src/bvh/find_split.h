// References in, the best plane to part them by in the surface area heuristic out.
#ifndef SWELL_BVH_FIND_SPLIT_H_
#define SWELL_BVH_FIND_SPLIT_H_

#include <cstdint>
#include <limits>
#include <span>

#include "kernels/bvh_node.h"
#include "src/bvh/bounds4.h"

namespace swell {

// Of a triangle 1; a sphere is a leaf of its own and weighs as much as a full block.
inline uint32_t WeightOf(const Reference& ref) { return ref.is_sphere() ? kBlockWidth : 1; }

// Tests of a block or a sphere that references of this weight take, one number a lane.
inline Float4 TestsOf(Int4 weight) {
  constexpr int kWidth = static_cast<int>(kBlockWidth);
  return __builtin_convertvector((weight + (kWidth - 1)) / kWidth, Float4);
}

// What a node knows of its references.
struct RefBounds {
  Bounds4 box;
  Bounds4 centres;  // of CentreOf
  uint32_t spheres = 0;

  void Add(const RefBounds& other) {
    box.Add(other.box);
    centres.Add(other.centres);
    spheres += other.spheres;
  }
  void Add(const Reference& ref) {
    const Bounds4 ref_box = ref.box();
    box.Add(ref_box);
    centres.AddPoint(ref_box.lower + ref_box.upper);
    spheres += ref.is_sphere() ? 1 : 0;
  }
};
RefBounds BoundsOf(std::span<const Reference> refs);

// Twice the centre; only for comparing.
inline Float4 CentreOf(const Bounds4& box) { return box.lower + box.upper; }

// Maps points to bins; monotone.
struct BinMap {
  Float4 lower, scale;
  uint32_t bins;

  BinMap(const Bounds4& range, uint32_t bins_asked);
  Int4 BinsOf(Float4 point) const { return __builtin_convertvector((point - lower) * scale, Int4); }
};

// References whose centre's bin is below `bin` go left. Both sides have some.
struct ObjectSplit {
  int axis = -1;  // none: all centres coincide
  int bin = 0;
  float cost = std::numeric_limits<float>::infinity();  // half area times tests
};

// Of many references the split and its cost are those of a sample of 2^sample_bits.
ObjectSplit FindObjectSplit(std::span<const Reference> refs, const BinMap& map,
                            uint32_t sample_bits);

// Half areas of three boxes, a box a lane.
inline Float4 HalfAreas(const Bounds4 (&boxes)[3]) {
  const Float4 a = boxes[0].upper - boxes[0].lower, b = boxes[1].upper - boxes[1].lower,
               c = boxes[2].upper - boxes[2].lower;
  const Float4 ab01 = __builtin_shuffle(a, b, Int4{0, 4, 1, 5});
  const Float4 ab2 = __builtin_shuffle(a, b, Int4{2, 6, 3, 7});
  const Float4 x = __builtin_shuffle(ab01, c, Int4{0, 1, 4, 4});
  const Float4 y = __builtin_shuffle(ab01, c, Int4{2, 3, 5, 5});
  const Float4 z = __builtin_shuffle(ab2, c, Int4{0, 1, 6, 6});
  return x * y + y * z + z * x;
}

// The best bin of each axis to begin the right side with. Sums(b) are those of the bins on one side
// for the three axes; a side without weight is never the best.
class BestBins {
 public:
  void Try(Float4 cost, int bin) {
    const Int4 better = cost < cost_;
    cost_ = better ? cost : cost_;
    bin_ = better ? Int4{bin, bin, bin, bin} : bin_;
  }
  // The axis with the least cost; -1 if there is none.
  int Axis() const {
    int best = -1;
    float least = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) {
      if (!(cost_[k] < least)) continue;
      least = cost_[k];
      best = k;
    }
    return best;
  }
  float cost(int axis) const { return cost_[axis]; }
  int bin(int axis) const { return bin_[axis]; }

 private:
  Float4 cost_ = Splat(std::numeric_limits<float>::infinity());
  Int4 bin_ = {};
};

// Boxes and weight of one side of a plane, for planes across each axis.
struct Sides {
  Bounds4 box[3];
  Int4 weight = {};  // an axis a lane

  void Add(const Bounds4 (&boxes)[3], Int4 more) {
    for (int k = 0; k < 3; ++k) box[k].Add(boxes[k]);
    weight += more;
  }
  // Not a number or infinite on a side without weight.
  Float4 Costs() const { return HalfAreas(box) * TestsOf(weight); }
};

}  // namespace swell

#endif  // SWELL_BVH_FIND_SPLIT_H_
