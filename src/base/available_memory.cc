// Files of /proc and /sys/fs/cgroup in, bytes that can still be taken out.
#include "src/base/available_memory.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace swell {
namespace {

constexpr uint64_t kUnlimited = std::numeric_limits<uint64_t>::max();

// The file's first word as a number; nothing if there is none ("max" in memory.max).
std::optional<uint64_t> NumberIn(const std::string& path) {
  std::ifstream file(path);
  uint64_t number;
  if (file >> number) return number;
  return std::nullopt;
}

// The number behind `key` in a file of lines "key number ...".
std::optional<uint64_t> NumberAfter(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string first;
    uint64_t number;
    if (words >> first && first == key && words >> number) return number;
  }
  return std::nullopt;
}

// The names under which the two versions of control groups keep the same three figures.
struct GroupFiles {
  const char* mount;
  const char* limit;
  const char* used;
  const char* droppable;  // key in memory.stat
};
constexpr GroupFiles kVersion1 = {"/sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                  "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"/sys/fs/cgroup", "memory.max", "memory.current",
                                  "inactive_file"};

uint64_t LeftInGroup(const std::string& folder, const GroupFiles& files) {
  const std::optional<uint64_t> limit = NumberIn(folder + files.limit);
  const std::optional<uint64_t> used = NumberIn(folder + files.used);
  if (!limit || !used) return kUnlimited;
  const uint64_t droppable = NumberAfter(folder + "memory.stat", files.droppable).value_or(0);
  const uint64_t held = *used - std::min(*used, droppable);
  return *limit - std::min(*limit, held);
}

// `group` is the path below the mount, "/" or "/a/b". In a container the mount may already be the
// group itself, so that only the last step, the mount, finds files.
uint64_t LeftInGroups(const std::string& mount, std::string group, const GroupFiles& files) {
  uint64_t left = kUnlimited;
  while (!group.empty() && group != "/") {
    left = std::min(left, LeftInGroup(mount + group + "/", files));
    group.resize(group.find_last_of('/'));
  }
  return std::min(left, LeftInGroup(mount + "/", files));
}

}  // namespace

uint64_t AvailableMemory(const std::string& root) {
  uint64_t left = kUnlimited;
  if (const auto kibibytes = NumberAfter(root + "/proc/meminfo", "MemAvailable:")) {
    left = *kibibytes * 1024;
  }
  // Lines "number:controllers:/path"; version 2 names no controllers.
  std::ifstream groups(root + "/proc/self/cgroup");
  std::string line;
  while (std::getline(groups, line)) {
    const size_t first = line.find(':');
    const size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos || line.compare(second + 1, 1, "/") != 0) continue;
    std::string controllers = line.substr(first, second - first + 1);  // ":cpu,memory:"
    std::replace(controllers.begin(), controllers.end(), ':', ',');
    const bool is_version1 = controllers.find(",memory,") != std::string::npos;
    if (!is_version1 && controllers != ",,") continue;
    const GroupFiles& files = is_version1 ? kVersion1 : kVersion2;
    left = std::min(left, LeftInGroups(root + files.mount, line.substr(second + 1), files));
  }
  return left;
}

std::string BytesForPeople(uint64_t bytes) {
  constexpr const char* kUnits[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  if (bytes < 1024) return std::to_string(bytes) + " bytes";
  double value = static_cast<double>(bytes) / 1024;
  size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %s", value, kUnits[unit]);
  return text;
}

}  // namespace swell
