// Halton points, a prime base for each dimension, digits scrambled anew for each pixel (Owen 1995;
// the scramble of a digit is linear: Matousek 1998, "On the L2-Discrepancy for Anchored Boxes").
#if defined(SWELL_KERNELS_SAMPLERS_HALTON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_HALTON_INL_H_
#undef SWELL_KERNELS_SAMPLERS_HALTON_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_HALTON_INL_H_
#endif

#include "kernels/samplers/independent-inl.h"
#include "kernels/samplers/tables.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Halton {
  static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair) {
    constexpr uint32_t kPairs = kPrimeCount / 2;
    const U32 x_dimension = hn::ShiftLeft<1>(hn::Min(pair, SetU(kPairs - 1)));
    const U32 seed = HashNext(row.key, pair);
    const Vec2 unscrambled = Independent::Pair(row, pair);
    const F32 x =
        Inverse(row, x_dimension, HashBits(hn::Add(seed, SetU(0x85EBCA6Bu))), unscrambled.x);
    const F32 y = Inverse(row, hn::Add(x_dimension, SetU(1)),
                          HashBits(hn::Add(seed, SetU(0xC2B2AE35u))), unscrambled.y);
    // Beyond the table of primes strata would hold less than one sample each anyway.
    const Mask has_primes = ToFloatMask(hn::Lt(pair, SetU(kPairs)));
    return {hn::IfThenElse(has_primes, x, unscrambled.x),
            hn::IfThenElse(has_primes, y, unscrambled.y)};
  }

 private:
  // Digits until each sample has an interval of its own, which `rest` in [0, 1) fills. A digit d
  // becomes (a d + c) mod base, with a and c by a hash of the digits before it: any two digits of
  // a node go to any two places equally likely, and the variance of Owen's scrambling asks no more.
  // Whole numbers stay below 2^24, where quotients round to the right side of whole numbers.
  static HWY_INLINE F32 Inverse(const SampleRow& row, U32 dimension, U32 node, F32 rest) {
    const F32 one = Set(1.0f);
    const F32 count = Set(static_cast<float>(row.view.samples_per_pixel));
    const F32 base = hn::ConvertTo(D(), hn::BitCast(DI(), Gather(kPrimeTable.prime, dimension)));
    F32 digits = hn::ConvertTo(D(), hn::BitCast(DI(), row.Sample()));
    F32 reach = one, point = hn::Zero(D()), scale = one;
    for (Mask going = hn::Lt(reach, count); !hn::AllFalse(D(), going);
         going = hn::Lt(reach, count)) {
      const F32 quotient = hn::Floor(hn::Div(digits, base));
      const F32 digit = hn::NegMulAdd(quotient, base, digits);
      const F32 last = hn::Sub(base, one);  // products next to the base round to it
      const F32 u = ToUnitFloat(HashNext(node, SetU(1)));
      const F32 a = hn::Min(hn::Floor(hn::MulAdd(u, last, one)), last);
      const F32 v = ToUnitFloat(HashNext(node, SetU(2)));
      const F32 c = hn::Min(hn::Floor(hn::Mul(v, base)), last);
      const F32 moved = hn::MulAdd(a, digit, c);
      const F32 scrambled = hn::NegMulAdd(hn::Floor(hn::Div(moved, base)), base, moved);

      scale = hn::IfThenElse(going, hn::Div(scale, base), scale);
      point = hn::IfThenElse(going, hn::MulAdd(scrambled, scale, point), point);
      reach = hn::IfThenElse(going, hn::Mul(reach, base), reach);
      node = HashNext(node, hn::Add(hn::BitCast(DU(), hn::ConvertTo(DI(), digit)), SetU(3)));
      digits = quotient;
    }
    return hn::Min(hn::MulAdd(rest, scale, point), Set(0x1.fffffep-1f));
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_HALTON_INL_H_
