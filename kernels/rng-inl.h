// Random numbers as a function of (pixel, sample, dimension, seed): Owen-scrambled Sobol' points,
// two dimensions at a time, each pair shuffled on its own (Burley 2020, "Practical Hash-based Owen
// Scrambling", JCGT 9(4); scrambling hash of Vegdahl 2021, "Building a Better LK Hash").
#if defined(SWELL_KERNELS_RNG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_RNG_INL_H_
#undef SWELL_KERNELS_RNG_INL_H_
#else
#define SWELL_KERNELS_RNG_INL_H_
#endif

#include "kernels/dimensions.h"
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

// The sample points of one path.
class Sampler {
 public:
  Sampler(U32 pixel, U32 sample, uint32_t seed)
      : key_(HashBits(hn::Xor(pixel, HashBits(SetU(seed ^ 0x9E3779B9u))))),
        reversed_sample_(ReverseBits(sample)) {}

  // For numbers that are not stratified, as many as wanted, by HashUniform: one seed for each
  // `use`.
  HWY_INLINE U32 Seed(U32 use) const {
    return HashBits(hn::Xor(HashBits(hn::Add(key_, hn::Mul(use, SetU(0x9E3779B9u)))),
                            HashBits(hn::Add(reversed_sample_, SetU(0x27D4EB2Fu)))));
  }

  // Two dimensions that are stratified together: pair `pair` of the path, see dimensions.h.
  HWY_INLINE Vec2 Pair(U32 pair) const {
    const U32 seed0 = HashBits(hn::Add(key_, hn::Mul(pair, SetU(0x9E3779B9u))));
    const U32 seed1 = HashBits(hn::Add(seed0, SetU(0x85EBCA6Bu)));
    const U32 seed2 = HashBits(hn::Add(seed0, SetU(0xC2B2AE35u)));

    const U32 index = ReverseBits(ScrambleReversed(reversed_sample_, seed0));
    const U32 x = ReverseBits(ScrambleReversed(index, seed1));
    const U32 y = ReverseBits(ScrambleReversed(SobolSecondReversed(index), seed2));

    return {ToUnitFloat(x), ToUnitFloat(y)};
  }

 private:
  U32 key_;
  U32 reversed_sample_;
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_RNG_INL_H_
