// Random numbers as a function of (pixel, sample, dimension, seed), by the render's sampler.
#if defined(SWELL_KERNELS_RNG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_RNG_INL_H_
#undef SWELL_KERNELS_RNG_INL_H_
#else
#define SWELL_KERNELS_RNG_INL_H_
#endif

#include "kernels/dimensions.h"
#include "kernels/samplers/sobol-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// By the sampler of the row: the default inline, the others as one copy out of line, so that the
// kernels that draw stay as small and fast as with the default alone.
Vec2 OtherPair(const SampleRow& row, U32 pair);  // other_samplers.cc

// The sample points of one path.
class Sampler {
 public:
  Sampler(U32 pixel, U32 sample, uint32_t seed, SamplerView view)
      : row_{HashBits(hn::Xor(pixel, HashBits(SetU(seed ^ 0x9E3779B9u)))), ReverseBits(sample),
             pixel, seed, view} {}

  // For numbers that are not stratified, as many as wanted, by HashUniform: one seed for each
  // `use`.
  HWY_INLINE U32 Seed(U32 use) const {
    return HashBits(hn::Xor(HashNext(row_.key, use),
                            HashBits(hn::Add(row_.reversed_sample, SetU(0x27D4EB2Fu)))));
  }

  // Two dimensions that are stratified together: pair `pair` of the path, see dimensions.h.
  HWY_INLINE Vec2 Pair(U32 pair) const {
    if (HWY_LIKELY(row_.view.kind == SamplerKind::kSobol)) return Sobol::Pair(row_, pair);
    const SampleRow in_memory = row_;  // row_ itself stays in registers
    return OtherPair(in_memory, pair);
  }

 private:
  SampleRow row_;
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_RNG_INL_H_
