// What a figure was measured on: CPU, threads, caches, compiler, revision, memory.
#ifndef SWELL_STATS_MACHINE_H_
#define SWELL_STATS_MACHINE_H_

#include <cstdint>
#include <optional>
#include <string>

#include "kernels/kernel.h"

namespace swell {

struct Machine {
  std::optional<std::string> cpu;  // model name
  std::string isa;                 // in use
  uint32_t lanes = 0;              // in use
  uint32_t threads = 0;            // hardware threads this process may run on
  std::string compiler;
  std::optional<std::string> git;  // revision of the source, "-dirty" if it was changed
};

// After SelectIsa.
Machine DescribeMachine(Width width);

const char* SwellVersion();                   // "0.1.0"
std::optional<std::string> SourceRevision();  // see Machine::git
std::string CompilerName();                   // "g++ 12.2.0"
std::optional<std::string> CpuName();         // from /proc/cpuinfo
uint32_t AvailableThreads();                  // by the affinity mask; at least 1
std::optional<uint64_t> CoreL2Bytes();        // of the first core, from sysfs
std::optional<uint64_t> PeakResidentBytes();  // of this process so far

}  // namespace swell

#endif  // SWELL_STATS_MACHINE_H_
