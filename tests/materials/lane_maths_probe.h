// Lets tests call single lane functions: columns in, a column out.
#ifndef SWELL_TESTS_MATERIALS_LANE_MATHS_PROBE_H_
#define SWELL_TESTS_MATERIALS_LANE_MATHS_PROBE_H_

#include "kernels/kernel.h"
#include "kernels/records.h"

namespace swell {

enum class LaneFunction {
  kSinTurns,           // (u)
  kCosTurns,           // (u)
  kRefractedCosine,    // (cos_i, eta)
  kFresnelDielectric,  // (cos_i, eta)
  kFresnelSchlick,     // (cos_i, eta)
  kFresnelConductor,   // (cos_i, eta, k)
};

// out[i] = function(in[0][i], in[1][i], in[2][i]); columns are padded.
SWELL_KERNEL(void, ProbeLaneFunction, LaneFunction function, const float* const* in, float* out,
             size_t count);

}  // namespace swell

#endif  // SWELL_TESTS_MATERIALS_LANE_MATHS_PROBE_H_
