// How many bytes this process can still take: the machine's free memory within the limits of its
// control groups.
#ifndef SWELL_BASE_AVAILABLE_MEMORY_H_
#define SWELL_BASE_AVAILABLE_MEMORY_H_

#include <cstdint>
#include <string>

namespace swell {

// The least of what /proc/meminfo and the memory limits of the process's control group and its
// ancestors (both versions of them) leave; page cache that can be dropped counts as free, swap does
// not. The largest uint64_t where none of them can be read. `root` is put before every path, for
// tests.
uint64_t AvailableMemory(const std::string& root = "");

// "1.5 GiB", "12.0 MiB", "700 bytes".
std::string BytesForPeople(uint64_t bytes);

}  // namespace swell

#endif  // SWELL_BASE_AVAILABLE_MEMORY_H_
