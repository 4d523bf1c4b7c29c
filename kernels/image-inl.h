// Texels of an image by lanes of coordinates: fetched, wrapped, filtered.
#if defined(SWELL_KERNELS_IMAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_IMAGE_INL_H_
#undef SWELL_KERNELS_IMAGE_INL_H_
#else
#define SWELL_KERNELS_IMAGE_INL_H_
#endif

#include "kernels/image_view.h"
#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The low 16 bits as IEEE binary16: the float with those bits in place has an exponent that is 112
// too small; the product is exact, also for denormals.
HWY_INLINE F32 HalfToFloat(U32 half) {
  const U32 magnitude = hn::ShiftLeft<13>(hn::And(half, SetU(0x7FFF)));
  const U32 sign = hn::ShiftLeft<16>(hn::And(half, SetU(0x8000)));
  return hn::Or(hn::Mul(FromBits(magnitude), Set(0x1p112f)), FromBits(sign));
}

// Number of a texel within its level, which is made of tiles.
HWY_INLINE U32 TexelNumber(const ImageLevel& level, U32 x, U32 y) {
  const U32 inner = SetU(kTileSide - 1);
  const U32 tile = hn::Add(hn::Mul(hn::ShiftRight<kTileShift>(y), SetU(level.tiles_across)),
                           hn::ShiftRight<kTileShift>(x));
  const U32 in_tile = hn::Or(hn::ShiftLeft<kTileShift>(hn::And(y, inner)), hn::And(x, inner));
  return hn::Or(hn::ShiftLeft<2 * kTileShift>(tile), in_tile);
}

// x and y must lie in the level. A single channel is in all three.
HWY_INLINE Rgb FetchTexel(const ImageView& image, const ImageLevel& level, U32 x, U32 y) {
  const uint32_t* words = image.words + level.first;
  const U32 at = TexelNumber(level, x, y);
  const U32 byte = SetU(0xFF);
  const bool grey = image.channels == 1;
  if (image.format == TexelFormat::kByte) {
    if (grey) {
      const U32 shift = hn::ShiftLeft<3>(hn::And(at, SetU(3)));
      const U32 word = hn::Shr(Gather(words, hn::ShiftRight<2>(at)), shift);
      const F32 value = Gather(image.decode, hn::And(word, byte));
      return {value, value, value};
    }
    const U32 word = Gather(words, at);
    return {Gather(image.decode, hn::And(word, byte)),
            Gather(image.decode, hn::And(hn::ShiftRight<8>(word), byte)),
            Gather(image.decode, hn::And(hn::ShiftRight<16>(word), byte))};
  }
  if (image.format == TexelFormat::kHalf) {
    if (grey) {
      const U32 shift = hn::ShiftLeft<4>(hn::And(at, SetU(1)));
      const F32 value = HalfToFloat(hn::Shr(Gather(words, hn::ShiftRight<1>(at)), shift));
      return {value, value, value};
    }
    const U32 first = hn::Add(at, at);
    const U32 rg = Gather(words, first);
    return {HalfToFloat(rg), HalfToFloat(hn::ShiftRight<16>(rg)),
            HalfToFloat(Gather(words + 1, first))};
  }
  const float* floats = reinterpret_cast<const float*>(words);
  if (grey) {
    const F32 value = Gather(floats, at);
    return {value, value, value};
  }
  const U32 first = hn::Add(hn::Add(at, at), at);
  return {Gather(floats, first), Gather(floats + 1, first), Gather(floats + 2, first)};
}

// floor(v) for numbers that fit 32 bits; others end somewhere within them.
HWY_INLINE I32 FloorToInt(F32 v) {
  const F32 bounded = hn::Min(hn::Max(v, Set(-1.0e9f)), Set(1.0e9f));
  return hn::ConvertTo(DI(), hn::Floor(bounded));
}

// The cell of [0, count) that holds x in [0, 1], a number of `count` steps.
HWY_INLINE U32 CellOf(F32 x, uint32_t count) {
  const I32 cell = FloorToInt(hn::Mul(x, Set(static_cast<float>(count))));
  const I32 most = hn::Set(DI(), static_cast<int32_t>(count) - 1);
  return hn::BitCast(DU(), hn::Min(hn::Max(cell, hn::Zero(DI())), most));
}

// The texel at (u, v) in [0, 1], v from the top; beyond that the nearest one.
HWY_INLINE Rgb NearestTexel(const ImageView& image, F32 u, F32 v) {
  const ImageLevel& level = image.levels[0];
  return FetchTexel(image, level, CellOf(u, level.width), CellOf(v, level.height));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_IMAGE_INL_H_
