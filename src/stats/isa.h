// The instruction sets this build has kernels for: which of them the CPU runs, which one is chosen.
#ifndef SWELL_STATS_ISA_H_
#define SWELL_STATS_ISA_H_

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/kernel.h"
#include "src/base/result.h"

namespace swell {

struct IsaInfo {
  const char* name;  // as in --isa
  const char* help;
  uint32_t lanes;     // floats in a vector
  bool fused;         // has fused multiply-add: its pictures are equal to the bit (law 1)
  int64_t target;     // Highway's bit; better sets have lower bits
  bool one_lane;      // the one-lane kernels are compiled for it
  bool built;         // this build has kernels for it
  bool cpu_supports;  // this CPU runs them
};

// All that swell knows on this architecture, best first.
std::vector<IsaInfo> Isas();

// The names that can be chosen here, best first, without "auto".
std::vector<std::string> UsableIsaNames();

// Lets the kernels use `name` and what lies below it; "auto" takes the best. To be called before
// the first kernel. An error names what exists.
Status SelectIsa(const std::string& name);

// What kernels of this width run on now; lanes is 1 for kOneLane.
IsaInfo IsaInUse(Width width);

}  // namespace swell

#endif  // SWELL_STATS_ISA_H_
