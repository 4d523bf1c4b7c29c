// The tests of a ray against a box, a triangle and a sphere, over any vector type: many rays
// against one, or one ray against many, with the same operations in the same order.
//
// Why every traversal finds the same hit: a hit's distance is never below the computed entry into
// the primitive's own box (ClampToBox). If every box above contains that box exactly, then, because
// a computed entry is a composition of monotone rounded operations, no entry on the way to a hit
// lies beyond the hit, and culling by `entry <= best` loses neither the least hit nor a tie.
//
// Why no ray slips through: let r = 2^-24, D the largest |vertex - org| in any axis. The sheared
// vertices are off by at most 5 r D, the slabs by at most 5 r (|plane| + |org|); the margins of
// kBoxMargin = 32 r on either side exceed both, so a ray that passes the edge tests enters the box.
//
// Why the same holds for a triangle whose parts are in several leaves (spatial splits), each with
// the box of a part and the whole triangle's margin: it is enough that one of these boxes is
// entered at or before the hit's distance t and left at or after it. Let P be the point of the
// triangle that the hit's weights give. Some part holds P.
// - The weights are those of the computed sheared vertices to within 2 r each (ExactEdges), so P is
//   off the ray by at most 5 r D (vertices) + 4 r D (weights; a sheared vertex is within 2 D).
// - t is off P along the ray by at most 3 r D (the sum) + 6 r D (inverses, products, weights).
// - So the ray at t is within 18 r D of P in each axis; D is at most M + O, the largest coordinates
//   of the triangle and of the origin. The slabs are off by 2 r M + 4 r O, the cuts and the
//   widened planes by 2 r M. Both margins together, 32 r (M + O), exceed the sum, 22 r (M + O).
// Without fused multiply-add a vertex is off by 6 r D and a slab by 3 r M + 4 r O: 24 r (M + O).
// Assumed is that no product of differences is below 2^-100, where rounding is no longer relative.
//
// A triangle that is not cut is its own only part: so its box is always entered at or before a
// hit's distance and left at or after it, and ClampToBox changes nothing. It is left out where the
// assumption holds for certain (IsPlain): with the edges' sum at 2^-60 or more, what underflow
// takes from an edge is below 2^-89 of the weights, and D is above 2^-31.
#if defined(SWELL_KERNELS_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRIANGLE_INL_H_
#undef SWELL_KERNELS_TRIANGLE_INL_H_
#else
#define SWELL_KERNELS_TRIANGLE_INL_H_
#endif

#include "kernels/bvh_node.h"
#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// ---------------------------------------------------------------- box
// A ray as slabs see it: t of a plane at x is inv * x + bias.
template <class V> struct Slabs {
  Vec3T<V> inv;        // 1 / dir, limited to finite values
  Vec3T<V> near_bias;  // -org * inv less the margin
  Vec3T<V> far_bias;   // -org * inv plus the margin
};

template <class V> struct Interval { V enter, leave; };

// Where a ray enters and leaves a box; outside if enter > leave. A NaN of one axis widens the
// interval: it is in the first operand, which Max and Min drop.
template <class V>
HWY_INLINE Interval<V> CrossBox(const Slabs<V>& ray, const Vec3T<V>& near, const Vec3T<V>& far,
                                V first, V last) {
  const V near_x = hn::MulAdd(near.x, ray.inv.x, ray.near_bias.x);
  const V near_y = hn::MulAdd(near.y, ray.inv.y, ray.near_bias.y);
  const V near_z = hn::MulAdd(near.z, ray.inv.z, ray.near_bias.z);
  const V far_x = hn::MulAdd(far.x, ray.inv.x, ray.far_bias.x);
  const V far_y = hn::MulAdd(far.y, ray.inv.y, ray.far_bias.y);
  const V far_z = hn::MulAdd(far.z, ray.inv.z, ray.far_bias.z);
  return {hn::Max(hn::Max(near_x, near_y), hn::Max(near_z, first)),
          hn::Min(hn::Min(far_x, far_y), hn::Min(far_z, last))};
}

template <class V> struct Box { Vec3T<V> lower, upper; };

// The widened box of triangles, to the bit as the builder computes it.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Box<V> TriangleBox(DT dt, const Vec3T<V>& a, const Vec3T<V>& b, const Vec3T<V>& c) {
  const Vec3T<V> lower = {hn::Min(a.x, hn::Min(b.x, c.x)), hn::Min(a.y, hn::Min(b.y, c.y)),
                          hn::Min(a.z, hn::Min(b.z, c.z))};
  const Vec3T<V> upper = {hn::Max(a.x, hn::Max(b.x, c.x)), hn::Max(a.y, hn::Max(b.y, c.y)),
                          hn::Max(a.z, hn::Max(b.z, c.z))};
  const V x = hn::Max(hn::Neg(lower.x), upper.x);
  const V y = hn::Max(hn::Neg(lower.y), upper.y);
  const V z = hn::Max(hn::Neg(lower.z), upper.z);
  const V margin = hn::Mul(hn::Max(x, hn::Max(y, z)), hn::Set(dt, kBoxMargin));
  return {{hn::Sub(lower.x, margin), hn::Sub(lower.y, margin), hn::Sub(lower.z, margin)},
          {hn::Add(upper.x, margin), hn::Add(upper.y, margin), hn::Add(upper.z, margin)}};
}

// ---------------------------------------------------------------- triangle
// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Axes are permuted so that z
// is the ray's dominant one; the permutation is cyclic, so the order of vertices is kept or turned
// for the whole ray, and the test is two-sided.
template <class V> struct ShearRay {
  V org_x, org_y, org_z;  // permuted
  V shear_x, shear_y;     // dir.x / dir.z, dir.y / dir.z, permuted
  V inv_z;                // 1 / dir.z, permuted
};

// A vertex seen from the ray: the ray runs along z from the origin.
template <class V> HWY_INLINE Vec3T<V> ShearVertex(const ShearRay<V>& ray, V x, V y, V z) {
  z = hn::Sub(z, ray.org_z);
  return {hn::NegMulAdd(ray.shear_x, z, hn::Sub(x, ray.org_x)),
          hn::NegMulAdd(ray.shear_y, z, hn::Sub(y, ray.org_y)), z};
}

template <class V> struct Edges { V a, b, c, det; };  // a is opposite to vertex a, det their sum

// Twice the area of (origin, p, q). Not fused: both products round alike, so the sign is that of
// the exact value or the result is zero, and swapping p and q changes the sign only.
template <class V> HWY_INLINE V EdgeFunction(const Vec3T<V>& p, const Vec3T<V>& q) {
  return hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
}

template <class V>
HWY_INLINE Edges<V> EdgeFunctions(const Vec3T<V>& a, const Vec3T<V>& b, const Vec3T<V>& c) {
  const V at_a = EdgeFunction(c, b);
  const V at_b = EdgeFunction(a, c);
  const V at_c = EdgeFunction(b, a);
  return {at_a, at_b, at_c, hn::Add(hn::Add(at_a, at_b), at_c)};
}

#if HWY_NATIVE_FMA
// a b - c within rounding.
template <class DT, class V> HWY_INLINE V ProductLess(DT, V a, V b, V c) {
  return hn::MulSub(a, b, c);
}
#else
// The same by Dekker's product (1971) of halves.
template <class DT, class V> HWY_INLINE V UpperHalf(DT dt, V a) {
  const V c = hn::Mul(a, hn::Set(dt, 4097.0f));
  return hn::Sub(c, hn::Sub(c, a));
}
template <class DT, class V> HWY_INLINE V ProductLess(DT dt, V a, V b, V c) {
  const V product = hn::Mul(a, b);
  const V a_high = UpperHalf(dt, a), b_high = UpperHalf(dt, b);
  const V a_low = hn::Sub(a, a_high), b_low = hn::Sub(b, b_high);
  const V high = hn::Sub(hn::Mul(a_high, b_high), product);
  const V middle = hn::Add(hn::Add(high, hn::Mul(a_high, b_low)), hn::Mul(a_low, b_high));
  return hn::Add(hn::Sub(product, c), hn::Add(middle, hn::Mul(a_low, b_low)));
}
#endif

// EdgeFunction within 2 r of the exact value, however much cancels: Kahan's difference of products
// (Jeannerod, Louvet and Muller 2013, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants"). It is never on the other side of zero than EdgeFunction.
template <class DT, class V> HWY_INLINE V ExactEdge(DT dt, const Vec3T<V>& p, const Vec3T<V>& q) {
  const V product = hn::Mul(p.y, q.x);
  return hn::Sub(ProductLess(dt, p.x, q.y, product), ProductLess(dt, p.y, q.x, product));
}

template <class DT, class V>
HWY_INLINE Edges<V> ExactEdges(DT dt, const Vec3T<V>& a, const Vec3T<V>& b, const Vec3T<V>& c) {
  const V at_a = ExactEdge(dt, c, b);
  const V at_b = ExactEdge(dt, a, c);
  const V at_c = ExactEdge(dt, b, a);
  return {at_a, at_b, at_c, hn::Add(hn::Add(at_a, at_b), at_c)};
}

// Inside or on an edge. NaN may pass: it makes the distance NaN, which no comparison accepts.
template <class DT, class V> HWY_INLINE hn::Mask<DT> Inside(DT dt, const Edges<V>& e) {
  const V zero = hn::Zero(dt);
  const V least = hn::Min(e.a, hn::Min(e.b, e.c));
  const V most = hn::Max(e.a, hn::Max(e.b, e.c));
  return hn::And(hn::Or(hn::Ge(least, zero), hn::Le(most, zero)), hn::Ne(e.det, zero));
}

// The distance times e.det.
template <class V>
HWY_INLINE V ScaledDistance(const ShearRay<V>& ray, const Edges<V>& e, V a_z, V b_z, V c_z) {
  const V along = hn::MulAdd(e.a, a_z, hn::MulAdd(e.b, b_z, hn::Mul(e.c, c_z)));
  return hn::Mul(along, ray.inv_z);
}

// inv_det: the inverse of e.det; where it overflows there is no hit.
template <class V>
HWY_INLINE V TriangleDistance(const ShearRay<V>& ray, const Edges<V>& e, V inv_det, V a_z, V b_z,
                              V c_z) {
  return hn::Mul(ScaledDistance(ray, e, a_z, b_z, c_z), inv_det);
}

// Whether the ray may hit: not outside, and no distance that is certainly below zero, as that of
// the triangle the ray starts from.
template <class DT, class V>
HWY_INLINE hn::Mask<DT> MayHit(DT dt, const ShearRay<V>& ray, const Vec3T<V>& a, const Vec3T<V>& b,
                               const Vec3T<V>& c) {
  const hn::RebindToSigned<DT> di;
  const Edges<V> edges = ExactEdges(dt, a, b, c);
  const V scaled = ScaledDistance(ray, edges, a.z, b.z, c.z);
  const auto signs = hn::BitCast(di, hn::Xor(scaled, edges.det));
  return hn::AndNot(hn::RebindMask(dt, hn::Lt(signs, hn::Zero(di))), Inside(dt, edges));
}

// Moves a distance that rounding put before the primitive's own box to the box; `hit` loses the
// rays that miss the box.
template <class M, class V> HWY_INLINE V ClampToBox(const Interval<V>& box, V t, M& hit) {
  hit = hn::And(hit, hn::Le(box.enter, box.leave));
  return hn::Max(t, box.enter);
}

// Where ClampToBox changes nothing, as argued above: the edges' sum and the direction are far from
// the ends of what floats hold.
template <class DT, class V> HWY_INLINE hn::Mask<DT> IsPlain(DT dt, V det, V inv_z) {
  const V d = hn::Abs(det), z = hn::Abs(inv_z);
  return hn::And(hn::And(hn::Gt(d, hn::Set(dt, 0x1p-60f)), hn::Lt(d, hn::Set(dt, 0x1p60f))),
                 hn::And(hn::Gt(z, hn::Set(dt, 0x1p-30f)), hn::Lt(z, hn::Set(dt, 0x1p30f))));
}

// ---------------------------------------------------------------- sphere
// A value and what rounding took from it (Dekker 1971, Knuth 1969).
template <class V> struct Twofold { V high, low; };

template <class V> HWY_INLINE Twofold<V> TwoSum(V a, V b) {
  const V sum = hn::Add(a, b);
  const V of_b = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, of_b)), hn::Sub(b, of_b))};
}
template <class V> HWY_INLINE Twofold<V> TwoProduct(V a, V b) {
  const V product = hn::Mul(a, b);
  return {product, hn::MulSub(a, b, product)};
}
// x.high y.high + ... to twice the precision, and the cross terms with `low`.
template <class V>
HWY_INLINE Twofold<V> TwoDot(const Vec3T<V>& a, const Vec3T<V>& high, const Vec3T<V>& low) {
  const Twofold<V> x = TwoProduct(a.x, high.x);
  const Twofold<V> y = TwoProduct(a.y, high.y);
  const Twofold<V> z = TwoProduct(a.z, high.z);
  const Twofold<V> xy = TwoSum(x.high, y.high);
  const Twofold<V> xyz = TwoSum(xy.high, z.high);
  const V rounding = hn::Add(hn::Add(hn::Add(x.low, y.low), z.low), hn::Add(xy.low, xyz.low));
  return {xyz.high, hn::Add(rounding, Dot(a, low))};
}

template <class V> struct Rows { Vec3T<V> x, y, z; };

// |to_object (org - centre)|^2 - 1 to twice the precision.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE V HeightOverSphere(DT dt, const Rows<V>& to_object, const Vec3T<V>& org,
                              const Vec3T<V>& centre) {
  const Vec3T<V> minus_centre = Neg(centre);
  const Twofold<V> from_x = TwoSum(org.x, minus_centre.x);
  const Twofold<V> from_y = TwoSum(org.y, minus_centre.y);
  const Twofold<V> from_z = TwoSum(org.z, minus_centre.z);
  const Vec3T<V> high = {from_x.high, from_y.high, from_z.high};
  const Vec3T<V> low = {from_x.low, from_y.low, from_z.low};
  const Twofold<V> x = TwoDot(to_object.x, high, low);
  const Twofold<V> y = TwoDot(to_object.y, high, low);
  const Twofold<V> z = TwoDot(to_object.z, high, low);
  const Vec3T<V> o = {x.high, y.high, z.high};
  const Vec3T<V> twice_low = {hn::Add(x.low, x.low), hn::Add(y.low, y.low), hn::Add(z.low, z.low)};
  const Twofold<V> square = TwoDot(o, o, twice_low);
  const Twofold<V> height = TwoSum(square.high, hn::Set(dt, -1.0f));
  return hn::Add(height.high, hn::Add(height.low, square.low));
}

// The first distance above zero at which a ray meets the sphere; NaN or not positive if none.
// Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection"
// (Ray Tracing Gems, chapter 7), on the unit sphere of the sphere's own space.
//
// The sign of c = |org|^2 - 1 decides on which side of the surface a ray starts, and near the
// surface the near root is proportional to it; there it is taken to twice the precision. So a
// hit's distance is good to a few roundings of the distance, not of the sphere's radius, and a ray
// that starts off the surface by more than its own origin's rounding does not meet it there.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE V SphereDistance(DT dt, const SphereRecord& sphere, const Vec3T<V>& org,
                            const Vec3T<V>& dir) {
  const float* m = sphere.world_to_object;
  const Rows<V> rows = {{hn::Set(dt, m[0]), hn::Set(dt, m[1]), hn::Set(dt, m[2])},
                        {hn::Set(dt, m[4]), hn::Set(dt, m[5]), hn::Set(dt, m[6])},
                        {hn::Set(dt, m[8]), hn::Set(dt, m[9]), hn::Set(dt, m[10])}};
  const float* w = sphere.object_to_world;
  const Vec3T<V> centre = {hn::Set(dt, w[3]), hn::Set(dt, w[7]), hn::Set(dt, w[11])};
  const Vec3T<V> from_centre = Sub(org, centre);
  const Vec3T<V> o = {Dot(rows.x, from_centre), Dot(rows.y, from_centre), Dot(rows.z, from_centre)};
  const Vec3T<V> d = {Dot(rows.x, dir), Dot(rows.y, dir), Dot(rows.z, dir)};
  const V one = hn::Set(dt, 1.0f);
  const V zero = hn::Zero(dt);

  const V a = Dot(d, d);
  const V b = hn::Neg(Dot(o, d));
  const V b_over_a = hn::Div(b, a);
  V c = hn::MulAdd(o.x, o.x, hn::MulAdd(o.y, o.y, hn::MulSub(o.z, o.z, one)));
  const Vec3T<V> closest = MulAdd(b_over_a, d, o);
  V discriminant = hn::Sub(one, Dot(closest, closest));
  const auto near_surface = hn::Lt(hn::Abs(c), hn::Set(dt, 0x1p-5f));
  if (!hn::AllFalse(dt, near_surface)) {
    c = hn::IfThenElse(near_surface, HeightOverSphere(dt, rows, org, centre), c);
    discriminant = hn::IfThenElse(near_surface, hn::MulSub(b_over_a, b, c), discriminant);
  }
  const V root = hn::Sqrt(hn::Mul(a, hn::Max(discriminant, zero)));
  const V q = hn::Add(b, hn::CopySign(root, b));
  const V t_c = hn::Div(c, q);
  const V t_q = hn::Div(q, a);
  const V t_near = hn::Min(t_c, t_q);
  const V t = hn::IfThenElse(hn::Gt(t_near, zero), t_near, hn::Max(t_c, t_q));
  return hn::IfThenElse(hn::Ge(discriminant, zero), t, hn::Neg(one));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRIANGLE_INL_H_
