// The bounds of a bundle of rays in, and what they do not miss out: one test for the whole bundle
// against all children of a node or all triangles of a block.
//
// Why no hit is lost: let r = 2^-24. A child is left out only if no ray of the bundle enters its
// box as CrossBox computes it. There a distance to a plane is off (plane - org) inv by at most 1.1
// times the margin kBoxMargin |org| |inv| and by a rounding; kBundleMargin |org| is taken off the
// interval of (plane - org) before it is multiplied, and kWiden off the distances. A triangle is
// left out only
// - if its edge functions have both signs for all rays, or all its sheared vertices are on one side
//   of all rays in x or y. Ray and bundle each shear a vertex with an error of at most 5 r W, where
//   W is the largest distance of a vertex from an origin in the 1-norm, so that an edge function is
//   off by at most 16 r W P in either, where P bounds the sheared vertices' 1-norm: 32 r W P covers
//   both. Where the rays' dominant axes differ, each shears along its own: as if vertices were
//   moved by 5 r W in space, which is 5 r W (1 + s) along the axis of the bounds, if slopes there
//   are at most s = kSteepest; the bounds' own vertices are off as much, and 2 r s W by the slopes'
//   rounding: not 10 r W but 58 r W, and 256 r W P cover that.
// - or if no vertex is ahead of any ray (IsBehind).
// - or if all rays of the bundle end before its plane or begin beyond it. A hit at t is within
//   18 r D in each axis of a point of the triangle (triangle-inl.h), D being the largest component
//   from an origin to a vertex, if no product underflows: so the ray's ends are on two sides of the
//   plane or one is within 18 r D |n| of it, n being the normal and |n| its 1-norm. The normal
//   computed is off by 4 r times the product of the edges' 1-norms, a distance from the plane by 16
//   r times that product and the largest component to the plane; 20 r D |n| are taken off.
//   Nothing underflows where the edges' sum is above 2^-60 for all rays, as IsPlain asks; it is
//   computed within 3 times 16 r W P.
#if defined(SWELL_KERNELS_CROSS_BUNDLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_CROSS_BUNDLE_INL_H_
#undef SWELL_KERNELS_CROSS_BUNDLE_INL_H_
#else
#define SWELL_KERNELS_CROSS_BUNDLE_INL_H_
#endif

#include "kernels/bundle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Where the first ray may enter children [first, first + Lanes) of a node, and which any may enter
// up to t.
HWY_INLINE FB CrossChildren(const BundleBounds& bounds, const BvhNode& node, size_t first, float t,
                            MaskB& hit) {
  const DB db;
  const float* planes = node.bounds[0] + first;
  FB enter = hn::Zero(db), leave = InfinityOf(db);
  for (uint32_t k = 0; k < 3; ++k) {
    const FB sign = hn::Set(db, bounds.sign[k]);
    const FB least = hn::Set(db, bounds.least[k]), most = hn::Set(db, bounds.most[k]);
    const FB near =
        hn::MulSub(hn::Load(db, planes + bounds.planes.near[k]), sign, hn::Set(db, bounds.near[k]));
    const FB far =
        hn::MulSub(hn::Load(db, planes + bounds.planes.far[k]), sign, hn::Set(db, bounds.far[k]));
    enter = hn::Max(enter, hn::Min(hn::Mul(near, least), hn::Mul(near, most)));
    leave = hn::Min(leave, hn::Max(hn::Mul(far, least), hn::Mul(far, most)));
  }
  enter = hn::Mul(enter, hn::Set(db, 1.0f - kWiden));
  leave = hn::Min(hn::Mul(leave, hn::Set(db, 1.0f + kWiden)), hn::Set(db, t));
  hit = hn::Le(enter, leave);
  return enter;
}

inline constexpr float kRounding = 0x1p-24f;

// The least and the greatest of an edge function over the rays of a bundle.
template <class V> struct EdgeRange { V least, most; };

// p and q are sheared by the middle of the slopes. With origin and slopes off the middle by o and s
// the edge function becomes p x q - s.x A + s.y B - o' x (q' - p'), where o' is o seen along the
// ray and q' - p' the edge as that ray sees it.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE EdgeRange<V> RangeOfEdge(DT dt, const BundleBounds& bounds, const Vec3T<V>& p,
                                    const Vec3T<V>& q, V org_x, V org_y, V slack) {
  const V slope_x = hn::Set(dt, bounds.slope_half[0]), slope_y = hn::Set(dt, bounds.slope_half[1]);
  const V middle = hn::MulSub(p.x, q.y, hn::Mul(p.y, q.x));
  const V a = hn::Abs(hn::MulSub(p.z, q.y, hn::Mul(q.z, p.y)));
  const V b = hn::Abs(hn::MulSub(p.z, q.x, hn::Mul(q.z, p.x)));
  const V edge_z = hn::Abs(hn::Sub(q.z, p.z));
  const V edge_x = hn::MulAdd(slope_x, edge_z, hn::Abs(hn::Sub(q.x, p.x)));
  const V edge_y = hn::MulAdd(slope_y, edge_z, hn::Abs(hn::Sub(q.y, p.y)));
  V half = hn::MulAdd(slope_x, a, hn::Mul(slope_y, b));
  half = hn::MulAdd(org_x, edge_y, hn::MulAdd(org_y, edge_x, half));
  half = hn::MulAdd(half, hn::Set(dt, 1.0f + kWiden), slack);
  return {hn::Sub(middle, half), hn::Add(middle, half)};
}

template <class V> HWY_INLINE V MaxOf(V a, V b, V c) { return hn::Max(a, hn::Max(b, c)); }
template <class V> HWY_INLINE V SumOf(const Vec3T<V>& v) { return hn::Add(v.x, hn::Add(v.y, v.z)); }
template <class V> HWY_INLINE V MinOf(V a, V b, V c) { return hn::Min(a, hn::Min(b, c)); }

// Lanes of triangles whose vertices are all on one side of all rays in one coordinate; not if any
// is NaN.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE hn::Mask<DT> IsBeside(V a, V b, V c, V a_half, V b_half, V c_half, V shift) {
  const V back = hn::Neg(shift);
  const auto above =
      hn::And(hn::Gt(hn::Sub(a, a_half), shift),
              hn::And(hn::Gt(hn::Sub(b, b_half), shift), hn::Gt(hn::Sub(c, c_half), shift)));
  const auto below =
      hn::And(hn::Lt(hn::Add(a, a_half), back),
              hn::And(hn::Lt(hn::Add(b, b_half), back), hn::Lt(hn::Add(c, c_half), back)));
  return hn::Or(above, below);
}

// Lanes of triangles no vertex of which is ahead of any ray along the dominant axis of all: a hit's
// distance is a sum of their distances with weights of one sign, so it is not above zero, however
// it is rounded.
HWY_INLINE MaskB IsBehind(const BundleBounds& bounds, const Vec3T<FB> (&vertex)[3]) {
  const DB db;
  const FB sign = hn::Set(db, bounds.sign[bounds.axis]);
  const FB z =
      MaxOf(hn::Mul(sign, vertex[0].z), hn::Mul(sign, vertex[1].z), hn::Mul(sign, vertex[2].z));
  return hn::Le(z, hn::Set(db, bounds.behind));
}

// A triangle's plane. The normal is as long as twice the area.
template <class V> struct Plane {
  Vec3T<V> point, normal, abs_normal;
  V size;    // the product of two edges' 1-norms: what the normal's roundings are relative to
  V extent;  // the largest component of an edge
};

template <class V>
HWY_INLINE Plane<V> PlaneOf(const Vec3T<V>& a, const Vec3T<V>& b, const Vec3T<V>& c) {
  const Vec3T<V> ab = Sub(b, a), ac = Sub(c, a), abs_ab = Abs(ab), abs_ac = Abs(ac);
  const Vec3T<V> n = {hn::MulSub(ab.y, ac.z, hn::Mul(ab.z, ac.y)),
                      hn::MulSub(ab.z, ac.x, hn::Mul(ab.x, ac.z)),
                      hn::MulSub(ab.x, ac.y, hn::Mul(ab.y, ac.x))};
  return {a, n, Abs(n), hn::Mul(SumOf(abs_ab), SumOf(abs_ac)),
          hn::Max(MaxComponent(abs_ab), MaxComponent(abs_ac))};
}

// A box, given as middle and half, as a plane sees it.
template <class V> struct FromBox {
  Vec3T<V> to, half;  // from the middle to the plane's point
  V farthest;         // the largest component from any point of the box to the plane's point
};

HWY_INLINE FromBox<FB> SeeFromBox(const Plane<FB>& plane, const float (&middle)[3],
                                  const float (&half)[3]) {
  const DB db;
  const Vec3T<FB> to = {hn::Sub(plane.point.x, hn::Set(db, middle[0])),
                        hn::Sub(plane.point.y, hn::Set(db, middle[1])),
                        hn::Sub(plane.point.z, hn::Set(db, middle[2]))};
  const Vec3T<FB> h = {hn::Set(db, half[0]), hn::Set(db, half[1]), hn::Set(db, half[2])};
  return {to, h, MaxComponent(Add(Abs(to), h))};
}

// The signed distances, times the normal's length, of the plane from all points of a box; `slack`
// and their own rounding are added.
HWY_INLINE EdgeRange<FB> RangeFromBox(const Plane<FB>& plane, const FromBox<FB>& box, FB slack) {
  const FB rounding = hn::Mul(hn::Mul(box.farthest, plane.size), hn::Set(DB(), 16 * kRounding));
  const FB most = hn::Add(Dot(plane.abs_normal, box.half), hn::Add(rounding, slack));
  const FB middle = Dot(plane.normal, box.to);
  return {hn::Sub(middle, most), hn::Add(middle, most)};
}

// Lanes of triangles whose plane all rays, from origin to end, are certainly on one side of.
HWY_INLINE MaskB IsOffPlane(const BundleBounds& bounds, const Vec3T<FB> (&vertex)[3], FB slack) {
  const DB db;
  const Plane<FB> plane = PlaneOf(vertex[0], vertex[1], vertex[2]);
  const Vec3T<FB>& n = plane.normal;
  const FB det = hn::Abs(hn::MulAdd(hn::Set(db, bounds.slope[0]), n.x,
                                    hn::MulAdd(hn::Set(db, bounds.slope[1]), n.y, n.z)));
  FB det_half = hn::MulAdd(hn::Set(db, bounds.slope_half[0]), plane.abs_normal.x,
                           hn::Mul(hn::Set(db, bounds.slope_half[1]), plane.abs_normal.y));
  det_half = hn::MulAdd(plane.size, hn::Set(db, 64 * kRounding),
                        hn::MulAdd(slack, hn::Set(db, 3.0f), det_half));
  const MaskB is_plain = hn::And(hn::Gt(hn::Sub(det, det_half), hn::Set(db, 0x1p-50f)),
                                 hn::Lt(hn::Add(det, det_half), hn::Set(db, 0x1p50f)));
  const FromBox<FB> from_org = SeeFromBox(plane, bounds.org, bounds.org_half);
  const FromBox<FB> from_end = SeeFromBox(plane, bounds.end, bounds.end_half);
  const FB farthest = hn::Add(from_org.farthest, plane.extent);
  const FB off = hn::Mul(hn::Mul(farthest, SumOf(plane.abs_normal)), hn::Set(db, 20 * kRounding));
  const EdgeRange<FB> org = RangeFromBox(plane, from_org, off);
  const EdgeRange<FB> end = RangeFromBox(plane, from_end, off);
  const FB zero = hn::Zero(db);
  return hn::And(is_plain, hn::Or(hn::Gt(hn::Min(org.least, end.least), zero),
                                  hn::Lt(hn::Max(org.most, end.most), zero)));
}

// Bit i: some ray of the bundle may hit triangle i of the block. Only for bundles with slopes.
HWY_INLINE uint32_t CrossTriangles(const BundleBounds& bounds, const TriangleBlock& block) {
  const DB db;
  uint32_t crossed = 0;
  const float rounding = bounds.one_axis ? 0x1p-19f : 0x1p-16f;  // of an edge, relative to W P
  const FB org_half_z = hn::Set(db, bounds.org_half[2]);
  const FB slope_x = hn::Set(db, bounds.slope[0]), slope_y = hn::Set(db, bounds.slope[1]);
  const FB half_x = hn::Set(db, bounds.slope_half[0]), half_y = hn::Set(db, bounds.slope_half[1]);
  // How far a ray's origin, seen along it, is off the middle.
  const FB org_x =
      hn::MulAdd(hn::Add(hn::Abs(slope_x), half_x), org_half_z, hn::Set(db, bounds.org_half[0]));
  const FB org_y =
      hn::MulAdd(hn::Add(hn::Abs(slope_y), half_y), org_half_z, hn::Set(db, bounds.org_half[1]));
  const FB org_off = hn::Add(hn::Add(org_x, org_y), org_half_z);
  for (size_t first = 0; first < kBlockWidth; first += hn::Lanes(db)) {
    Vec3T<FB> vertex[3], p[3];
    FB reach = hn::Zero(db), size = hn::Zero(db);
    for (size_t k = 0; k < 3; ++k) {
      const float* of_vertex = block.vertex[k][0] + first;
      vertex[k] = {hn::Load(db, of_vertex + bounds.columns.x),
                   hn::Load(db, of_vertex + bounds.columns.y),
                   hn::Load(db, of_vertex + bounds.columns.z)};
      const FB x = hn::Sub(vertex[k].x, hn::Set(db, bounds.org[0]));
      const FB y = hn::Sub(vertex[k].y, hn::Set(db, bounds.org[1]));
      const FB z = hn::Sub(vertex[k].z, hn::Set(db, bounds.org[2]));
      p[k] = {hn::NegMulAdd(slope_x, z, x), hn::NegMulAdd(slope_y, z, y), z};
      reach = hn::Max(reach, hn::Add(hn::Abs(x), hn::Add(hn::Abs(y), hn::Abs(z))));
      size = hn::Max(size, hn::Add(hn::Abs(p[k].x), hn::Abs(p[k].y)));
    }
    reach = hn::Add(reach, org_off);
    size = hn::Add(hn::MulAdd(hn::Add(half_x, half_y), reach, size), org_off);
    const FB slack = hn::Mul(hn::Mul(reach, size), hn::Set(db, rounding));
    const EdgeRange<FB> a = RangeOfEdge(db, bounds, p[2], p[1], org_x, org_y, slack);
    const EdgeRange<FB> b = RangeOfEdge(db, bounds, p[0], p[2], org_x, org_y, slack);
    const EdgeRange<FB> c = RangeOfEdge(db, bounds, p[1], p[0], org_x, org_y, slack);
    const FB zero = hn::Zero(db);
    const MaskB positive = hn::Gt(MaxOf(a.least, b.least, c.least), zero);
    const MaskB negative = hn::Lt(MinOf(a.most, b.most, c.most), zero);
    const MaskB front = hn::Gt(hn::Add(a.least, hn::Add(b.least, c.least)), zero);
    const MaskB back = hn::Lt(hn::Add(a.most, hn::Add(b.most, c.most)), zero);
    const MaskB outside =
        hn::Or(hn::And(negative, hn::Or(positive, front)), hn::And(positive, back));
    const FB shift = hn::Mul(reach, hn::Set(db, 0.5f * rounding));
    const FB za = hn::Abs(p[0].z), zb = hn::Abs(p[1].z), zc = hn::Abs(p[2].z);
    const MaskB beside_x =
        IsBeside<DB>(p[0].x, p[1].x, p[2].x, hn::Mul(half_x, za), hn::Mul(half_x, zb),
                     hn::Mul(half_x, zc), hn::Add(org_x, shift));
    const MaskB beside_y =
        IsBeside<DB>(p[0].y, p[1].y, p[2].y, hn::Mul(half_y, za), hn::Mul(half_y, zb),
                     hn::Mul(half_y, zc), hn::Add(org_y, shift));
    MaskB missed = hn::Or(outside, hn::Or(beside_x, beside_y));
    missed = hn::Or(missed, IsBehind(bounds, vertex));
    if (bounds.have_ends) missed = hn::Or(missed, IsOffPlane(bounds, vertex, slack));
    crossed |= MaskBits(db, hn::Not(missed)) << first;
  }
  return crossed;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_CROSS_BUNDLE_INL_H_
