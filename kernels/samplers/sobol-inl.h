// Owen-scrambled Sobol' points, two dimensions at a time, each pair shuffled on its own (Burley
// 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)).
#if defined(SWELL_KERNELS_SAMPLERS_SOBOL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_SOBOL_INL_H_
#undef SWELL_KERNELS_SAMPLERS_SOBOL_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_SOBOL_INL_H_
#endif

#include "kernels/samplers/sample_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Sobol {
  static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair) {
    const U32 seed0 = HashNext(row.key, pair);
    const U32 seed1 = HashBits(hn::Add(seed0, SetU(0x85EBCA6Bu)));
    const U32 seed2 = HashBits(hn::Add(seed0, SetU(0xC2B2AE35u)));

    const U32 index = ReverseBits(ScrambleReversed(row.reversed_sample, seed0));
    const U32 x = ReverseBits(ScrambleReversed(index, seed1));
    const U32 y = ReverseBits(ScrambleReversed(SobolSecondReversed(index), seed2));

    return {ToUnitFloat(x), ToUnitFloat(y)};
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_SOBOL_INL_H_
