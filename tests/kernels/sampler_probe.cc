// Pixels, samples and pairs -> the points of the samplers, and the bits they are made of.
#include "tests/kernels/lane_probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/kernels/sampler_probe.cc"
#include <hwy/foreach_target.h>

#include "kernels/rng-inl.h"
#include "tests/kernels/probe_row-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void ProbeSamplerPair(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const Vec2 u = Sampler(row.Word(0), row.Word(1), args.seed, args.sampler).Pair(row.Word(2));
    row.Put(0, u.x);
    row.Put(1, u.y);
  }
}

void ProbeSobol(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    row.Put(0, ReverseBits(row.Word(0)));
    row.Put(1, ScrambleReversed(row.Word(0), row.Word(1)));
    row.Put(2, SobolSecondReversed(row.Word(0)));
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(ProbeSamplerPair);
void ProbeSamplerPair(const ProbeArgs& args) { HWY_DYNAMIC_DISPATCH(ProbeSamplerPair)(args); }
HWY_EXPORT(ProbeSobol);
void ProbeSobol(const ProbeArgs& args) { HWY_DYNAMIC_DISPATCH(ProbeSobol)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
