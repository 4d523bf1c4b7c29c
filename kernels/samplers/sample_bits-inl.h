// What samplers share: bits of points and their scrambling, hashes, and what a row of samples is
// (scrambling hash of Vegdahl 2021, "Building a Better LK Hash").
#if defined(SWELL_KERNELS_SAMPLERS_SAMPLE_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_SAMPLE_BITS_INL_H_
#undef SWELL_KERNELS_SAMPLERS_SAMPLE_BITS_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_SAMPLE_BITS_INL_H_
#endif

#include "kernels/sampler.h"
#include "kernels/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

template <int kBits> HWY_INLINE U32 SwapBitGroups(U32 x, uint32_t low_groups) {
  const U32 low = SetU(low_groups);
  return hn::Or(hn::And(hn::ShiftRight<kBits>(x), low), hn::ShiftLeft<kBits>(hn::And(x, low)));
}
HWY_INLINE U32 ReverseBits(U32 x) {
  x = SwapBitGroups<1>(x, 0x55555555u);
  x = SwapBitGroups<2>(x, 0x33333333u);
  x = SwapBitGroups<4>(x, 0x0F0F0F0Fu);
  x = SwapBitGroups<8>(x, 0x00FF00FFu);
  return hn::Or(hn::ShiftRight<16>(x), hn::ShiftLeft<16>(x));
}

// Owen scrambling of a bit-reversed word: every bit is flipped by a hash of the bits below it.
HWY_INLINE U32 ScrambleReversed(U32 x, U32 seed) {
  x = hn::Xor(x, hn::Mul(x, SetU(0x3d20adeau)));
  x = hn::Add(x, seed);
  x = hn::Mul(x, hn::Or(hn::ShiftRight<16>(seed), SetU(1)));
  x = hn::Xor(x, hn::Mul(x, SetU(0x05526c56u)));
  return hn::Xor(x, hn::Mul(x, SetU(0x53a22864u)));
}

// The bit-reversed second Sobol' dimension of `index`: its generator matrix is Pascal's triangle
// mod 2, which is a product of five sparse steps; reversed, the steps shift to the right of the
// index.
HWY_INLINE U32 SobolSecondReversed(U32 index) {
  U32 x = index;
  x = hn::Xor(x, hn::And(hn::ShiftRight<1>(x), SetU(0x55555555u)));
  x = hn::Xor(x, hn::And(hn::ShiftRight<2>(x), SetU(0x33333333u)));
  x = hn::Xor(x, hn::And(hn::ShiftRight<4>(x), SetU(0x0F0F0F0Fu)));
  x = hn::Xor(x, hn::And(hn::ShiftRight<8>(x), SetU(0x00FF00FFu)));
  return hn::Xor(x, hn::And(hn::ShiftRight<16>(x), SetU(0x0000FFFFu)));
}

// [0, 1) with 24 bits.
HWY_INLINE F32 ToUnitFloat(U32 x) {
  const I32 high = hn::BitCast(DI(), hn::ShiftRight<8>(x));
  return hn::Mul(hn::ConvertTo(D(), high), Set(0x1p-24f));
}

// Hash of a hash and one more number.
HWY_INLINE U32 HashNext(U32 hash, U32 number) {
  return HashBits(hn::Add(hash, hn::Mul(number, SetU(0x9E3779B9u))));
}

// Which numbers of a path are asked for. A sampler is a struct with
//   static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair);
// a function of the row and the pair alone, whatever the lane.
struct SampleRow {
  U32 key;              // hash of pixel and seed
  U32 reversed_sample;  // the sample's index, bits reversed
  U32 pixel;            // x | y << 16
  uint32_t seed;
  SamplerView view;

  HWY_INLINE U32 Sample() const { return ReverseBits(reversed_sample); }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_SAMPLE_BITS_INL_H_
