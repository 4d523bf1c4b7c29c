// Implements lane_maths_probe.h for every target and both widths.
#include "tests/materials/lane_maths_probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/materials/lane_maths_probe.cc"
#include <hwy/foreach_target.h>

#include "kernels/fresnel-inl.h"
#include "kernels/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

F32 Call(LaneFunction function, F32 a, F32 b, F32 c) {
  F32 sine, cosine;
  switch (function) {
    case LaneFunction::kSinTurns:
      SinCosTurns(a, &sine, &cosine);
      return sine;
    case LaneFunction::kCosTurns:
      SinCosTurns(a, &sine, &cosine);
      return cosine;
    case LaneFunction::kRefractedCosine:
      return RefractedCosine(a, b);
    case LaneFunction::kFresnelDielectric:
      return FresnelDielectric(a, RefractedCosine(a, b), b);
    case LaneFunction::kFresnelSchlick:
      return FresnelSchlick(a, RefractedCosine(a, b), b);
    case LaneFunction::kFresnelConductor:
      break;
  }
  return FresnelConductor(a, b, c);
}

void ProbeLaneFunctionImpl(LaneFunction function, const float* const* in, float* out,
                           size_t count) {
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    Store(Call(function, Load(in[0], i), Load(in[1], i), Load(in[2], i)), out, i);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(ProbeLaneFunctionImpl);
void ProbeLaneFunction(LaneFunction function, const float* const* in, float* out, size_t count) {
  HWY_DYNAMIC_DISPATCH(ProbeLaneFunctionImpl)(function, in, out, count);
}
}  // namespace swell::SWELL_WIDTH
#endif
