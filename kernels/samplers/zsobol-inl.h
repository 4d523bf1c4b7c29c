// One Owen-scrambled Sobol' sequence for the picture: pixels take blocks of it in Morton order,
// with the digits of the order shuffled, so that neighbours share out the strata (Ahmed and Wonka
// 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
// of Pixels").
#if defined(SWELL_KERNELS_SAMPLERS_ZSOBOL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_ZSOBOL_INL_H_
#undef SWELL_KERNELS_SAMPLERS_ZSOBOL_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_ZSOBOL_INL_H_
#endif

#include "kernels/samplers/sample_bits-inl.h"
#include "kernels/samplers/tables.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct ZSobol {
  static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair) {
    const uint32_t samples = row.view.samples_per_pixel;
    const int sample_bits =
        samples < 2 ? 0 : 32 - static_cast<int>(hwy::Num0BitsAboveMS1Bit_Nonzero32(samples - 1));
    // Pixels share a sequence of 2^32 points; those of tiles that need more do not know each other.
    const int pixel_bits = HWY_MIN(30, (32 - sample_bits) & ~1);
    const U32 curve = Morton(row.pixel);
    const U32 tile = hn::ShiftRightSame(curve, pixel_bits);
    const U32 in_tile = hn::Sub(curve, hn::ShiftLeftSame(tile, pixel_bits));
    const U32 index = hn::Or(hn::ShiftLeftSame(in_tile, sample_bits), row.Sample());
    const U32 seed = HashNext(HashNext(SetU(row.seed ^ 0x9E3779B9u), hn::Add(tile, SetU(1))), pair);

    const U32 shuffled = ShuffleDigits(index, sample_bits & 1, pixel_bits + sample_bits, seed);
    const U32 x =
        ReverseBits(ScrambleReversed(shuffled, HashBits(hn::Add(seed, SetU(0x85EBCA6Bu)))));
    const U32 y = ReverseBits(ScrambleReversed(SobolSecondReversed(shuffled),
                                               HashBits(hn::Add(seed, SetU(0xC2B2AE35u)))));
    return {ToUnitFloat(x), ToUnitFloat(y)};
  }

 private:
  // Bits of x at even places, of y at odd ones.
  static HWY_INLINE U32 Morton(U32 pixel) {
    U32 x = pixel;  // x | y << 16; each step spreads halves of groups
    x = SwapMiddle<8>(x, 0x0000FF00u);
    x = SwapMiddle<4>(x, 0x00F000F0u);
    x = SwapMiddle<2>(x, 0x0C0C0C0Cu);
    return SwapMiddle<1>(x, 0x22222222u);
  }
  template <int kBits> static HWY_INLINE U32 SwapMiddle(U32 x, uint32_t lower) {
    const U32 swap = hn::And(hn::Xor(x, hn::ShiftRight<kBits>(x)), SetU(lower));
    return hn::Xor(x, hn::Xor(swap, hn::ShiftLeft<kBits>(swap)));
  }

  static HWY_INLINE MaskU HasBit(U32 word, uint32_t bit) {
    return hn::Ne(hn::And(word, SetU(bit)), hn::Zero(DU()));
  }

  // Digits of two bits, from the first of `bits` down to bit `lowest`, each in an order by a hash
  // of the digits above it; and the bit below.
  static HWY_INLINE U32 ShuffleDigits(U32 index, int lowest, int bits, U32 seed) {
    U32 shuffled = hn::Zero(DU());
    for (int shift = bits - 2; shift >= lowest; shift -= 2) {
      const U32 above = hn::ShiftRight<2>(hn::ShiftRightSame(index, shift));
      const U32 hash = HashNext(hn::Add(seed, SetU(static_cast<uint32_t>(shift))), above);
      const U32 which = hn::ShiftRight<16>(hn::Mul(hn::ShiftRight<16>(hash), SetU(kDigitOrders)));
      const U32 order = Gather(kDigitOrderTable.order, which);
      const U32 digit = hn::ShiftRightSame(index, shift);
      // Not hn::Shr: of one lane, Highway 1.0.3 takes the next lane for the count's upper half.
      const U32 half = hn::IfThenElse(HasBit(digit, 2), hn::ShiftRight<4>(order), order);
      const U32 moved =
          hn::And(hn::IfThenElse(HasBit(digit, 1), hn::ShiftRight<2>(half), half), SetU(3));
      shuffled = hn::Or(shuffled, hn::ShiftLeftSame(moved, shift));
    }
    if (lowest == 0) return shuffled;
    const U32 flip = hn::ShiftRight<31>(HashNext(hn::Sub(seed, SetU(1)), hn::ShiftRight<1>(index)));
    return hn::Or(shuffled, hn::And(hn::Xor(index, flip), SetU(1)));
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_ZSOBOL_INL_H_
