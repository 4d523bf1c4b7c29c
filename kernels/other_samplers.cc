// A row of samples and a pair -> its two numbers, by any sampler.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/other_samplers.cc"
#include <hwy/foreach_target.h>

#include "kernels/rng-inl.h"
#include "kernels/samplers/halton-inl.h"
#include "kernels/samplers/independent-inl.h"
#include "kernels/samplers/sobol-inl.h"
#include "kernels/samplers/stratified-inl.h"
#include "kernels/samplers/zsobol-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Called by kernels of the same target and width, so it needs no dispatch of its own.
Vec2 OtherPair(const SampleRow& row, U32 pair) {
  switch (row.view.kind) {
#define SWELL_SAMPLER_CASE(Kind, name, help) \
  case SamplerKind::k##Kind:                 \
    return Kind::Pair(row, pair);
    SWELL_SAMPLERS(SWELL_SAMPLER_CASE)
#undef SWELL_SAMPLER_CASE
  }
  return Sobol::Pair(row, pair);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
