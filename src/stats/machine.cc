// Asks the operating system and the build what this program runs on.
#include "src/stats/machine.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "src/stats/isa.h"
#include "swell/build_info.h"

namespace swell {
namespace {

std::optional<std::string> ReadLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return line;
}

// "1024K" or "2M", as sysfs writes cache sizes.
std::optional<uint64_t> ParseSize(const std::string& text) {
  uint64_t bytes = 0;
  size_t i = 0;
  for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i) {
    bytes = bytes * 10 + static_cast<uint64_t>(text[i] - '0');
  }
  if (i == 0 || bytes == 0) return std::nullopt;
  const char unit = i < text.size() ? text[i] : 'B';
  if (unit == 'K') return bytes << 10;
  if (unit == 'M') return bytes << 20;
  return bytes;
}

}  // namespace

Machine DescribeMachine(Width width) {
  const IsaInfo isa = IsaInUse(width);
  return {CpuName(), isa.name, isa.lanes, AvailableThreads(), CompilerName(), SourceRevision()};
}

const char* SwellVersion() { return SWELL_VERSION; }

std::optional<std::string> SourceRevision() {
  const std::string revision = SWELL_GIT_REVISION;
  if (revision == "unknown") return std::nullopt;
  return revision;
}

std::string CompilerName() {
#if defined(__clang__)
  return "clang++ " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__) +
         "." + std::to_string(__clang_patchlevel__);
#elif defined(__GNUC__)
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

std::optional<std::string> CpuName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return std::nullopt;
}

uint32_t AvailableThreads() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) == 0 && CPU_COUNT(&set) > 0) {
    return static_cast<uint32_t>(CPU_COUNT(&set));
  }
  return std::max(1u, std::thread::hardware_concurrency());
}

std::optional<uint64_t> CoreL2Bytes() {
  for (int index = 0; index < 8; ++index) {
    const std::string folder =
        "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/";
    if (ReadLine(folder + "level").value_or("") != "2") continue;
    if (ReadLine(folder + "type").value_or("") == "Instruction") continue;
    return ParseSize(ReadLine(folder + "size").value_or(""));
  }
  return std::nullopt;
}

std::optional<uint64_t> PeakResidentBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0 || usage.ru_maxrss <= 0) return std::nullopt;
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace swell
