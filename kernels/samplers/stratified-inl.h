// A grid of at least as many cells as samples, nearly square; each sample takes a cell by a
// permutation of its own for each pixel and pair (after Kensler 2013, "Correlated Multi-Jittered
// Sampling"), and a random point in it.
#if defined(SWELL_KERNELS_SAMPLERS_STRATIFIED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLERS_STRATIFIED_INL_H_
#undef SWELL_KERNELS_SAMPLERS_STRATIFIED_INL_H_
#else
#define SWELL_KERNELS_SAMPLERS_STRATIFIED_INL_H_
#endif

#include "kernels/samplers/independent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A permutation of [0, count) of i < count: bijections of words as wide as count - 1, repeated
// until the word is below count (Black and Rogaway 2002), then turned by a random step, which makes
// each place equally likely.
HWY_INLINE U32 Permute(U32 i, uint32_t count, U32 seed) {
  constexpr int kRounds = 8;
  if (count == 1) return hn::Zero(DU());
  const int bits = 32 - static_cast<int>(hwy::Num0BitsAboveMS1Bit_Nonzero32(count - 1));
  const U32 mask = SetU((2u << (bits - 1)) - 1);
  const int half = HWY_MAX(1, bits / 2);
  U32 key[kRounds];
  for (int r = 0; r < kRounds; ++r) key[r] = HashNext(seed, SetU(static_cast<uint32_t>(r)));

  const U32 limit = SetU(count);
  for (MaskU done = hn::Ne(i, i); !hn::AllTrue(DU(), done);) {
    U32 x = i;
    for (int r = 0; r < kRounds; ++r) {
      x = hn::Add(x, hn::ShiftRight<16>(key[r]));
      x = hn::And(hn::Mul(x, hn::Or(key[r], SetU(1))), mask);
      x = hn::Xor(x, hn::ShiftRightSame(x, half));
    }
    i = hn::IfThenElse(done, i, x);
    done = hn::Lt(i, limit);
  }
  const F32 step = hn::Mul(ToUnitFloat(HashNext(seed, SetU(kRounds))), Set(float(count)));
  const U32 turned = hn::Add(i, hn::BitCast(DU(), hn::ConvertTo(DI(), step)));
  return hn::IfThenElse(hn::Lt(turned, limit), turned, hn::Sub(turned, limit));
}

struct Stratified {
  static HWY_INLINE Vec2 Pair(const SampleRow& row, U32 pair) {
    const float count = static_cast<float>(row.view.samples_per_pixel);  // at most 2^22: exact
    const F32 columns = hn::Floor(hn::Sqrt(Set(count)));
    const F32 rows = hn::Ceil(hn::Div(Set(count), columns));
    const uint32_t cells = static_cast<uint32_t>(hn::GetLane(hn::Mul(columns, rows)));

    const U32 seed = HashNext(row.key, pair);
    const U32 in_grid = hn::Min(row.Sample(), SetU(cells - 1));
    const U32 cell = Permute(in_grid, cells, HashBits(hn::Add(seed, SetU(0x85EBCA6Bu))));
    const F32 at = hn::ConvertTo(D(), hn::BitCast(DI(), cell));
    const F32 y = hn::Floor(hn::Div(at, columns));
    const F32 x = hn::NegMulAdd(y, columns, at);
    const Vec2 jitter = Independent::Pair(row, pair);

    const F32 last = Set(0x1.fffffep-1f);
    return {hn::Min(hn::Div(hn::Add(x, jitter.x), columns), last),
            hn::Min(hn::Div(hn::Add(y, jitter.y), rows), last)};
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLERS_STRATIFIED_INL_H_
