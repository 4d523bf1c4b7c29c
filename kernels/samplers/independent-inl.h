// Numbers that know nothing of each other: hashes of pixel, pair and sample.
#if defined(SWELL_KERNELS_SAMPLERS_INDEPENDENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_INDEPENDENT_INL_H_
#undef SWELL_KERNELS_SAMPLERS_INDEPENDENT_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_INDEPENDENT_INL_H_
#endif

#include "kernels/samplers/sample_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Independent {
  static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair) {
    const U32 seed = HashNext(HashNext(row.key, pair), row.Sample());
    return {ToUnitFloat(HashBits(hn::Xor(seed, SetU(0x68E31DA4u)))),
            ToUnitFloat(HashBits(hn::Xor(seed, SetU(0xB5297A4Du))))};
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_INDEPENDENT_INL_H_
