// Noise of a point, and sums of its octaves.
#if defined(SWELL_KERNELS_NOISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_NOISE_INL_H_
#undef SWELL_KERNELS_NOISE_INL_H_
#else
#define SWELL_KERNELS_NOISE_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "kernels/lanes-inl.h"
#include "kernels/noise_table.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE F32 Lerp(F32 t, F32 a, F32 b) { return hn::MulAdd(t, hn::Sub(b, a), a); }

// 6 t^5 - 15 t^4 + 10 t^3
HWY_INLINE F32 Fade(F32 t) {
  const F32 bracket = hn::MulAdd(t, hn::MulAdd(t, Set(6.0f), Set(-15.0f)), Set(10.0f));
  return hn::Mul(hn::Mul(t, hn::Mul(t, t)), bracket);
}

// The product of (x, y, z) with the edge direction of a cube that the hash names.
HWY_INLINE F32 EdgeGradient(U32 hash, F32 x, F32 y, F32 z) {
  const U32 h = hn::And(hash, SetU(15));
  const MaskU edges = hn::Eq(hn::And(h, SetU(14)), SetU(12));  // 12 and 13
  const Mask first_x = ToFloatMask(hn::Or(hn::Lt(h, SetU(8)), edges));
  const Mask second_y = ToFloatMask(hn::Or(hn::Lt(h, SetU(4)), edges));
  const F32 a = hn::IfThenElse(first_x, x, y), b = hn::IfThenElse(second_y, y, z);
  const F32 sign_a = FromBits(hn::ShiftLeft<31>(h));
  const F32 sign_b = FromBits(hn::ShiftLeft<30>(hn::And(h, SetU(2))));
  return hn::Add(hn::Xor(a, sign_a), hn::Xor(b, sign_b));
}

HWY_INLINE U32 Permuted(U32 index) { return Gather(kNoiseTable.data(), index); }

// Perlin 2002: between -1 and 1, 0 at integers, of period 256. Not inlined: fourteen gathers.
inline HWY_NOINLINE F32 Noise(const Vec3& p) {
  const F32 one = Set(1.0f);
  const auto cell = [](F32 v)
                        HWY_ATTR { return hn::Floor(hn::Min(hn::Max(v, Set(-1e9f)), Set(1e9f))); };
  const F32 fx = cell(p.x), fy = cell(p.y), fz = cell(p.z);
  const auto index = [](F32 v) HWY_ATTR {
    return hn::And(hn::BitCast(DU(), hn::ConvertTo(DI(), v)), SetU(255));
  };
  const U32 ix = index(fx), iy = index(fy), iz = index(fz), next = SetU(1);
  const F32 x = hn::Sub(p.x, fx), y = hn::Sub(p.y, fy), z = hn::Sub(p.z, fz);
  const F32 x1 = hn::Sub(x, one), y1 = hn::Sub(y, one), z1 = hn::Sub(z, one);
  const U32 a = hn::Add(Permuted(ix), iy), b = hn::Add(Permuted(hn::Add(ix, next)), iy);
  const U32 aa = hn::Add(Permuted(a), iz), ab = hn::Add(Permuted(hn::Add(a, next)), iz);
  const U32 ba = hn::Add(Permuted(b), iz), bb = hn::Add(Permuted(hn::Add(b, next)), iz);
  const F32 u = Fade(x), v = Fade(y), w = Fade(z);
  const auto plane = [&](U32 step, F32 dz) HWY_ATTR {
    const F32 near = Lerp(u, EdgeGradient(Permuted(hn::Add(aa, step)), x, y, dz),
                          EdgeGradient(Permuted(hn::Add(ba, step)), x1, y, dz));
    const F32 far = Lerp(u, EdgeGradient(Permuted(hn::Add(ab, step)), x, y1, dz),
                         EdgeGradient(Permuted(hn::Add(bb, step)), x1, y1, dz));
    return Lerp(v, near, far);
  };
  return Lerp(w, plane(SetU(0), z), plane(next, z1));
}

// How many octaves a footprint of this width leaves, as a number with a fraction, as pbrt-v4: those
// whose features are at least twice as wide.
HWY_INLINE F32 VisibleOctaves(F32 width, uint32_t octaves) {
  const F32 most = Set(static_cast<float>(octaves));
  const F32 visible = hn::Sub(Set(-1.0f), hn::Log2(D(), hn::Max(width, Set(1e-30f))));
  return hn::Min(hn::Max(visible, hn::Zero(D())), most);
}
HWY_INLINE F32 Fraction(F32 octaves) {  // faded in between 0.3 and 0.7
  const F32 part = hn::Sub(octaves, hn::Floor(octaves));
  const F32 x = hn::Mul(hn::Sub(part, Set(0.3f)), Set(2.5f));
  const F32 t = hn::Min(hn::Max(x, hn::Zero(D())), Set(1.0f));
  return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(Set(2.0f), t, Set(3.0f)));
}

// Fractional Brownian motion, and turbulence, which sums magnitudes: octaves of frequency 1.99 and
// weight `roughness`. Turbulence counts hidden octaves at their mean, 0.2.
template <bool kTurbulence>
HWY_INLINE F32 SumOctaves(const Vec3& p, F32 width, float roughness, uint32_t octaves) {
  const F32 visible = VisibleOctaves(width, octaves), whole = hn::Floor(visible);
  const F32 part = Fraction(visible), mean = Set(0.2f);
  F32 sum = hn::Zero(D());
  float frequency = 1.0f, weight = 1.0f;
  for (uint32_t i = 0; i <= octaves; ++i) {
    const F32 index = Set(static_cast<float>(i));
    const F32 noise = i < octaves ? Noise(Scale(Set(frequency), p)) : hn::Zero(D());
    const Mask full = hn::Lt(index, whole), partial = hn::Eq(index, whole);
    F32 value;
    if (kTurbulence) {
      const F32 size = hn::Abs(noise);
      // The partial octave comes on top of all the hidden ones, its own mean included.
      const F32 hidden = i < octaves ? mean : hn::Zero(D());
      value = hn::IfThenElse(full, size, hidden);
      value = hn::Add(value, hn::IfThenElseZero(partial, Lerp(part, mean, size)));
    } else {
      value = hn::IfThenElse(full, noise, hn::IfThenElseZero(partial, hn::Mul(part, noise)));
    }
    sum = hn::MulAdd(Set(weight), value, sum);
    frequency *= 1.99f;
    weight *= roughness;
  }
  return sum;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_NOISE_INL_H_
