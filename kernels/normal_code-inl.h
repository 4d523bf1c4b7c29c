// A normal in twelve bits and back: what a ray remembers of the surface that it left, so that the
// probability of a light it hits can be found again.
#if defined(SWELL_KERNELS_NORMAL_CODE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_NORMAL_CODE_INL_H_
#undef SWELL_KERNELS_NORMAL_CODE_INL_H_
#else
#define SWELL_KERNELS_NORMAL_CODE_INL_H_
#endif

#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The code of surfaces that send light to both sides, and of points in no surface.
inline constexpr uint32_t kNoNormalCode = 0;
// Steps of an octahedral map (Cigolle et al. 2014) along each side; even, so that axes are exact.
inline constexpr uint32_t kNormalSteps = 62;
// A decoded normal is at most this off its own, as the sine of the angle (tested).
inline constexpr float kNormalCodeError = 0.068f;

HWY_INLINE F32 OneWithSign(F32 v) { return hn::CopySign(Set(1.0f), v); }

// `n` is unit; the codes are 1 to 63^2.
HWY_INLINE U32 EncodeNormal(const Vec3& n) {
  const F32 one = Set(1.0f);
  const F32 sum = hn::Add(hn::Add(hn::Abs(n.x), hn::Abs(n.y)), hn::Abs(n.z));
  const F32 x = hn::Div(n.x, sum), y = hn::Div(n.y, sum);
  const Mask lower = hn::Lt(n.z, hn::Zero(D()));
  const F32 folded_x = hn::Mul(hn::Sub(one, hn::Abs(y)), OneWithSign(x));
  const F32 folded_y = hn::Mul(hn::Sub(one, hn::Abs(x)), OneWithSign(y));
  const F32 half = Set(kNormalSteps / 2);
  const auto step = [&](F32 v) HWY_ATTR {
    const F32 at = hn::Min(hn::Max(hn::MulAdd(half, v, half), hn::Zero(D())), Set(kNormalSteps));
    return hn::BitCast(DU(), hn::NearestInt(at));
  };
  const U32 column = step(hn::IfThenElse(lower, folded_x, x));
  const U32 row = step(hn::IfThenElse(lower, folded_y, y));
  return hn::Add(hn::Add(hn::Mul(row, SetU(kNormalSteps + 1)), column), SetU(1));
}

// Zero for kNoNormalCode.
HWY_INLINE Vec3 DecodeNormal(U32 code) {
  const F32 one = Set(1.0f), zero = hn::Zero(D());
  const MaskU none = hn::Eq(code, SetU(kNoNormalCode));
  const F32 cell =
      hn::ConvertTo(D(), hn::BitCast(DI(), hn::IfThenZeroElse(none, hn::Sub(code, SetU(1)))));
  // Exact: a cell's number is far below 2^24, and half a cell keeps clear of whole numbers.
  const F32 row = hn::Floor(hn::Mul(hn::Add(cell, Set(0.5f)), Set(1.0f / (kNormalSteps + 1))));
  const F32 column = hn::NegMulAdd(row, Set(kNormalSteps + 1), cell);
  const F32 x = hn::MulSub(column, Set(2.0f / kNormalSteps), one);
  const F32 y = hn::MulSub(row, Set(2.0f / kNormalSteps), one);
  const F32 z = hn::Sub(one, hn::Add(hn::Abs(x), hn::Abs(y)));
  const F32 fold = hn::Max(hn::Neg(z), zero);
  const Vec3 n = Normalize(
      Vec3{hn::NegMulAdd(fold, OneWithSign(x), x), hn::NegMulAdd(fold, OneWithSign(y), y), z});
  const Mask some = hn::Not(ToFloatMask(none));
  return {hn::IfThenElseZero(some, n.x), hn::IfThenElseZero(some, n.y),
          hn::IfThenElseZero(some, n.z)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_NORMAL_CODE_INL_H_
