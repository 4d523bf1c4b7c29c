// Lane maths that every kernel shares: the vector types, bundles of them, loads, stores and
// gathers.
#if defined(SWELL_KERNELS_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LANES_INL_H_
#undef SWELL_KERNELS_LANES_INL_H_
#else
#define SWELL_KERNELS_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/records.h"

// Each kernel source is compiled twice (cmake/SwellKernels.cmake): with all lanes of the target,
// and with one lane of the same arithmetic.
#ifdef SWELL_ONE_LANE
#define SWELL_WIDTH one_lane
#else
#define SWELL_WIDTH wide
#endif

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#ifdef SWELL_ONE_LANE
using D = hn::CappedTag<float, 1>;
#else
using D = hn::ScalableTag<float>;
#endif
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using F32 = hn::Vec<D>;
using U32 = hn::Vec<DU>;
using I32 = hn::Vec<DI>;
using Mask = hn::Mask<D>;    // of float lanes
using MaskU = hn::Mask<DU>;  // of integer lanes

static_assert(hn::MaxLanes(D()) <= kRowPadding, "columns are padded to whole vectors");

// ---------------------------------------------------------------- bundles, over any vector type V
template <class V> struct Vec2T { V x, y; };
template <class V> struct Vec3T { V x, y, z; };
template <class V> struct RgbT { V r, g, b; };
using Vec2 = Vec2T<F32>;
using Vec3 = Vec3T<F32>;
using Rgb = RgbT<F32>;

template <class V> HWY_INLINE Vec3T<V> Add(const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V> HWY_INLINE Vec3T<V> Sub(const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V> HWY_INLINE Vec3T<V> Mul(const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
template <class V> HWY_INLINE Vec3T<V> Scale(V s, const Vec3T<V>& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
// s * a + b
template <class V> HWY_INLINE Vec3T<V> MulAdd(V s, const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::MulAdd(s, a.x, b.x), hn::MulAdd(s, a.y, b.y), hn::MulAdd(s, a.z, b.z)};
}
template <class V> HWY_INLINE Vec3T<V> Neg(const Vec3T<V>& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
template <class V> HWY_INLINE Vec3T<V> Abs(const Vec3T<V>& a) {
  return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)};
}
template <class V> HWY_INLINE Vec3T<V> Max(const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::Max(a.x, b.x), hn::Max(a.y, b.y), hn::Max(a.z, b.z)};
}
template <class V> HWY_INLINE V MaxComponent(const Vec3T<V>& a) {
  return hn::Max(a.x, hn::Max(a.y, a.z));
}
template <class V> HWY_INLINE V Dot(const Vec3T<V>& a, const Vec3T<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class V> HWY_INLINE Vec3T<V> Cross(const Vec3T<V>& a, const Vec3T<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
template <class V> HWY_INLINE Vec3T<V> Normalize(const Vec3T<V>& a) {
  const V length = hn::Sqrt(Dot(a, a));
  return {hn::Div(a.x, length), hn::Div(a.y, length), hn::Div(a.z, length)};
}
template <class M, class V>
HWY_INLINE Vec3T<V> IfThenElse(M mask, const Vec3T<V>& yes, const Vec3T<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

template <class V> HWY_INLINE RgbT<V> Add(const RgbT<V>& a, const RgbT<V>& b) {
  return {hn::Add(a.r, b.r), hn::Add(a.g, b.g), hn::Add(a.b, b.b)};
}
template <class V> HWY_INLINE RgbT<V> Mul(const RgbT<V>& a, const RgbT<V>& b) {
  return {hn::Mul(a.r, b.r), hn::Mul(a.g, b.g), hn::Mul(a.b, b.b)};
}
template <class V> HWY_INLINE RgbT<V> Scale(V s, const RgbT<V>& a) {
  return {hn::Mul(s, a.r), hn::Mul(s, a.g), hn::Mul(s, a.b)};
}
template <class M, class V>
HWY_INLINE RgbT<V> IfThenElse(M mask, const RgbT<V>& yes, const RgbT<V>& no) {
  return {hn::IfThenElse(mask, yes.r, no.r), hn::IfThenElse(mask, yes.g, no.g),
          hn::IfThenElse(mask, yes.b, no.b)};
}
template <class M, class V> HWY_INLINE RgbT<V> IfThenElseZero(M mask, const RgbT<V>& yes) {
  return {hn::IfThenElseZero(mask, yes.r), hn::IfThenElseZero(mask, yes.g),
          hn::IfThenElseZero(mask, yes.b)};
}
template <class V> HWY_INLINE V MaxComponent(const RgbT<V>& a) {
  return hn::Max(a.r, hn::Max(a.g, a.b));
}

// ---------------------------------------------------------------- constants and masks
HWY_INLINE F32 Set(float value) { return hn::Set(D(), value); }
HWY_INLINE U32 SetU(uint32_t value) { return hn::Set(DU(), value); }
HWY_INLINE Mask ToFloatMask(MaskU mask) { return hn::RebindMask(D(), mask); }
HWY_INLINE MaskU ToUintMask(Mask mask) { return hn::RebindMask(DU(), mask); }
HWY_INLINE Vec3 BroadcastVec3(const float* xyz) { return {Set(xyz[0]), Set(xyz[1]), Set(xyz[2])}; }
HWY_INLINE Rgb BroadcastRgb(const float* rgb) { return {Set(rgb[0]), Set(rgb[1]), Set(rgb[2])}; }
HWY_INLINE Mask AndNot(Mask no, Mask yes) { return hn::AndNot(no, yes); }

// Lanes [0, count) of a vector.
HWY_INLINE Mask FirstLanes(size_t count) {
  return hn::Lt(hn::Iota(D(), 0.0f), hn::Set(D(), static_cast<float>(count)));
}

// 32-bit reinterpretation and conversion.
HWY_INLINE U32 Bits(F32 v) { return hn::BitCast(DU(), v); }
HWY_INLINE F32 FromBits(U32 v) { return hn::BitCast(D(), v); }

// ---------------------------------------------------------------- memory
HWY_INLINE F32 Load(const float* column, size_t row) { return hn::LoadU(D(), column + row); }
HWY_INLINE U32 Load(const uint32_t* column, size_t row) { return hn::LoadU(DU(), column + row); }
HWY_INLINE void Store(F32 v, float* column, size_t row) { hn::StoreU(v, D(), column + row); }
HWY_INLINE void Store(U32 v, uint32_t* column, size_t row) { hn::StoreU(v, DU(), column + row); }

// base[index] per lane. Every lane's index must be readable: mask indices to 0 first.
HWY_INLINE F32 Gather(const float* base, U32 index) {
#ifdef SWELL_ONE_LANE  // Highway's partial gathers may read through the unused lanes
  return hn::Set(D(), base[hn::GetLane(index)]);
#else
  return hn::GatherIndex(D(), base, hn::BitCast(DI(), index));
#endif
}
HWY_INLINE U32 Gather(const uint32_t* base, U32 index) {
#ifdef SWELL_ONE_LANE
  return hn::Set(DU(), base[hn::GetLane(index)]);
#else
  return hn::GatherIndex(DU(), base, hn::BitCast(DI(), index));
#endif
}

// base[index] = v for the lanes of `mask`, whose indices differ from each other.
template <class V, class T> HWY_INLINE void ScatterLanes(Mask mask, V v, T* base, U32 index) {
  const hn::DFromV<V> d;
#if HWY_TARGET == HWY_AVX3 && !defined(SWELL_ONE_LANE)
  // One instruction instead of a loop with a branch per lane; Highway 1.0.3 has no masked scatter.
  if constexpr (hn::MaxLanes(D()) == 16) {
    _mm512_mask_i32scatter_epi32(base, mask.raw, index.raw, hn::BitCast(DU(), v).raw, 4);
    return;
  }
#endif
  alignas(64) T value[hn::MaxLanes(D())];
  alignas(64) uint32_t at[hn::MaxLanes(D())];
  alignas(64) uint32_t on[hn::MaxLanes(D())];
  hn::Store(v, d, value);
  hn::Store(index, DU(), at);
  hn::Store(hn::IfThenElseZero(ToUintMask(mask), SetU(1)), DU(), on);
  for (size_t i = 0; i < hn::Lanes(D()); ++i) {
    if (on[i] != 0) base[at[i]] = value[i];
  }
}
HWY_INLINE void Scatter(Mask mask, F32 v, float* base, U32 index) {
  ScatterLanes(mask, v, base, index);
}
HWY_INLINE void Scatter(Mask mask, U32 v, uint32_t* base, U32 index) {
  ScatterLanes(mask, v, base, index);
}

// Bundles of columns.
HWY_INLINE Vec3 Load(const Vec3Fields<In>& c, size_t row) {
  return {Load(c.x, row), Load(c.y, row), Load(c.z, row)};
}
HWY_INLINE Rgb Load(const RgbFields<In>& c, size_t row) {
  return {Load(c.r, row), Load(c.g, row), Load(c.b, row)};
}
HWY_INLINE Vec3 Gather(const Vec3Fields<In>& c, U32 row) {
  return {Gather(c.x, row), Gather(c.y, row), Gather(c.z, row)};
}
HWY_INLINE Rgb Gather(const RgbFields<In>& c, U32 row) {
  return {Gather(c.r, row), Gather(c.g, row), Gather(c.b, row)};
}
HWY_INLINE void Store(const Vec3& v, const Vec3Fields<Out>& c, size_t row) {
  Store(v.x, c.x, row);
  Store(v.y, c.y, row);
  Store(v.z, c.z, row);
}
HWY_INLINE void Store(const Rgb& v, const RgbFields<Out>& c, size_t row) {
  Store(v.r, c.r, row);
  Store(v.g, c.g, row);
  Store(v.b, c.b, row);
}

// first, first + 1, ... Not Iota from first: GCC stores its lanes one by one and loads them at
// once.
HWY_INLINE U32 CountFrom(uint32_t first) { return hn::Add(hn::Iota(DU(), 0), SetU(first)); }

// A vector of row numbers. Where they follow each other, as in runs of the only material around or
// rays of one octant, columns are loaded, else gathered.
class RowLanes {
 public:
  RowLanes(U32 rows, uint32_t first)
      : rows_(rows), first_(first), in_turn_(hn::AllTrue(DU(), hn::Eq(rows, CountFrom(first)))) {}
  template <class T> HWY_INLINE auto Of(const T* column) const {
    return in_turn_ ? Load(column, first_) : Gather(column, rows_);
  }
  HWY_INLINE Vec3 Of(const Vec3Fields<In>& c) const { return {Of(c.x), Of(c.y), Of(c.z)}; }
  HWY_INLINE Rgb Of(const RgbFields<In>& c) const { return {Of(c.r), Of(c.g), Of(c.b)}; }
  HWY_INLINE U32 Numbers() const { return rows_; }
  HWY_INLINE bool InTurn() const { return in_turn_; }

 private:
  U32 rows_;
  size_t first_;
  bool in_turn_;
};

// radiance[path] += v for the lanes of `mask`; no two lanes name the same path.
HWY_INLINE void AddToPaths(Mask mask, const Rgb& v, const RgbFields<Out>& radiance, U32 path) {
  const U32 at = hn::IfThenElseZero(ToUintMask(mask), path);
  Scatter(mask, hn::Add(Gather(radiance.r, at), v.r), radiance.r, at);
  Scatter(mask, hn::Add(Gather(radiance.g, at), v.g), radiance.g, at);
  Scatter(mask, hn::Add(Gather(radiance.b, at), v.b), radiance.b, at);
}

// A whole vector of lanes in memory, aligned, as calls out of line pass it.
HWY_INLINE void StoreLanes(const Vec3& v, float (*to)[hn::MaxLanes(D())]) {
  hn::Store(v.x, D(), to[0]);
  hn::Store(v.y, D(), to[1]);
  hn::Store(v.z, D(), to[2]);
}
HWY_INLINE Vec3 LoadLanes(const float (*from)[hn::MaxLanes(D())]) {
  return {hn::Load(D(), from[0]), hn::Load(D(), from[1]), hn::Load(D(), from[2])};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LANES_INL_H_
