// Runs a check on every instruction set that this CPU has kernels for, and with both widths.
#ifndef SWELL_TESTS_SUPPORT_FOR_EACH_TARGET_H_
#define SWELL_TESTS_SUPPORT_FOR_EACH_TARGET_H_

#include <hwy/targets.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "kernels/kernel.h"

namespace swell::test {

// Sizes at which kernels are tested: none, one, odd, a full vector, one more, many.
inline constexpr size_t kRowCounts[] = {0, 1, 7, 16, 17, 1000};

// Targets with fused multiply-add give the same bits in both widths (law 1).
inline bool HasFma(const std::string& target) {
  return target == "avx3" || target == "avx2" || target == "neon";
}

// Calls check(name, width). Kernels run on the target of that name inside the call.
template <class Check> void ForEachTarget(const Check& check) {
  struct Target {
    const char* name;
    int64_t bit;
  };
  constexpr Target kTargets[] = {
#if HWY_ARCH_X86
    {"avx3", HWY_AVX3},
    {"avx2", HWY_AVX2},
    {"sse4", HWY_SSE4},
#elif HWY_ARCH_ARM
    {"neon", HWY_NEON},
#endif
    {"scalar", HWY_SCALAR},
  };
  const int64_t supported = hwy::SupportedTargets() | HWY_SCALAR;
  for (const Target& target : kTargets) {
    if ((supported & target.bit) == 0) continue;
    // With all lower targets (higher bits): the one-lane kernels are not compiled for every target.
    hwy::SetSupportedTargetsForTest(supported & ~(target.bit - 1));
    check(target.name, Width::kWide);
    check(target.name, Width::kOneLane);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_FOR_EACH_TARGET_H_
