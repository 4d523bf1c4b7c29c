// Names of instruction sets to Highway's target masks. Compiled with the kernels' own list of
// targets (src/CMakeLists.txt), so that HWY_TARGETS here is what they were built for.
#include "src/stats/isa.h"

#include <hwy/targets.h>

#include "src/base/check.h"

namespace swell {
namespace {

// Read once, before SelectIsa can narrow it. Every CPU runs the scalar target.
int64_t DetectedTargets() {
  static const int64_t detected = hwy::SupportedTargets() | HWY_SCALAR;
  return detected;
}

IsaInfo Describe(const char* name, const char* help, uint32_t lanes, bool fused, int64_t target,
                 bool one_lane) {
  const bool built = (HWY_TARGETS & target) != 0;
  return {name, help, lanes, fused, target, one_lane, built, (DetectedTargets() & target) != 0};
}

// Whether HWY_TARGETS, which is of the full vectors, speaks for the one-lane kernels too: a static
// build compiles each for the best target that it may use.
#ifdef HWY_COMPILE_ONLY_STATIC
constexpr bool kOneLaneIsListed = false;
#else
constexpr bool kOneLaneIsListed = true;
#endif

bool Usable(const IsaInfo& isa) { return isa.built && isa.cpu_supports; }

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::vector<IsaInfo> Isas() {
  return {
#if HWY_ARCH_X86
    Describe("avx3", "AVX-512 (F, BW, DQ, VL)", 16, true, HWY_AVX3, false),
        Describe("avx2", "AVX2 with FMA", 8, true, HWY_AVX2, true),
        Describe("sse4", "SSE4.2", 4, false, HWY_SSE4, false),
#elif HWY_ARCH_ARM
    Describe("neon", "NEON", 4, true, HWY_NEON, true),
#endif
        Describe("scalar", "plain C++, any CPU", 1, false, HWY_SCALAR, true),
  };
}

std::vector<std::string> UsableIsaNames() {
  std::vector<std::string> names;
  for (const IsaInfo& isa : Isas()) {
    if (Usable(isa)) names.push_back(isa.name);
  }
  return names;
}

Status SelectIsa(const std::string& name) {
  if (name == "auto") {
    hwy::SetSupportedTargetsForTest(0);
    return Done{};
  }
  for (const IsaInfo& isa : Isas()) {
    if (isa.name != name) continue;
    if (!isa.built) {
      return Error{"this build has no kernels for '" + name + "'; choose auto, " +
                   Joined(UsableIsaNames())};
    }
    if (!isa.cpu_supports) {
      return Error{"this CPU has no '" + name + "'; choose auto, " + Joined(UsableIsaNames())};
    }
    // All lower targets too: not every kernel is compiled for every target.
    hwy::SetSupportedTargetsForTest(DetectedTargets() & ~(isa.target - 1));
    return Done{};
  }
  return Error{"unknown instruction set '" + name + "'; choose auto, " + Joined(UsableIsaNames())};
}

IsaInfo IsaInUse(Width width) {
  const int64_t chosen = hwy::SupportedTargets() | HWY_SCALAR;
  for (IsaInfo isa : Isas()) {
    const bool listed = width == Width::kWide || kOneLaneIsListed;
    if ((listed && !isa.built) || (chosen & isa.target) == 0) continue;
    if (width == Width::kWide) return isa;
    if (!isa.one_lane) continue;
    isa.lanes = 1;
    return isa;
  }
  SWELL_CHECK(false && "some target is always built");
  return {};
}

}  // namespace swell
