// Made-up trees of /proc and /sys/fs/cgroup in, claims about the bytes that are left out.
#include "src/base/available_memory.h"

#include <doctest/doctest.h>

#include <limits>

#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

constexpr uint64_t kMiB = 1024 * 1024;

TEST_CASE("AvailableMemory: is what /proc/meminfo says where no group limits it") {
  const TemporaryFolder root;
  CHECK(AvailableMemory(root.path()) == std::numeric_limits<uint64_t>::max());
  root.Write("proc/meminfo", "MemTotal: 9000 kB\nMemFree: 1 kB\nMemAvailable:   2048 kB\n");
  CHECK(AvailableMemory(root.path()) == 2 * kMiB);
  root.Write("proc/self/cgroup", "0::/\n");
  root.Write("sys/fs/cgroup/memory.max", "max\n");
  root.Write("sys/fs/cgroup/memory.current", "12\n");
  CHECK(AvailableMemory(root.path()) == 2 * kMiB);
}

TEST_CASE("AvailableMemory: the tightest of the group's ancestors counts, less what is in use") {
  const TemporaryFolder root;
  root.Write("proc/meminfo", "MemAvailable: 1048576 kB\n");
  root.Write("proc/self/cgroup", "0::/a/b\n");
  root.Write("sys/fs/cgroup/a/memory.max", std::to_string(10 * kMiB));
  root.Write("sys/fs/cgroup/a/memory.current", std::to_string(7 * kMiB));
  root.Write("sys/fs/cgroup/a/memory.stat", "anon 5\ninactive_file 2097152\n");
  root.Write("sys/fs/cgroup/a/b/memory.max", std::to_string(100 * kMiB));
  root.Write("sys/fs/cgroup/a/b/memory.current", std::to_string(6 * kMiB));
  CHECK(AvailableMemory(root.path()) == 5 * kMiB);
  root.Write("sys/fs/cgroup/a/memory.current", std::to_string(13 * kMiB));
  CHECK(AvailableMemory(root.path()) == 0);
}

TEST_CASE("AvailableMemory: reads groups of version 1, also through a container's mount") {
  const TemporaryFolder root;
  root.Write("proc/meminfo", "MemAvailable: 1048576 kB\n");
  root.Write("proc/self/cgroup", "5:cpu,memory:/docker/x\n4:memoryx:/y\n0::/\n");
  root.Write("sys/fs/cgroup/memory/memory.limit_in_bytes", std::to_string(8 * kMiB));
  root.Write("sys/fs/cgroup/memory/memory.usage_in_bytes", std::to_string(3 * kMiB));
  root.Write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 1048576\n");
  CHECK(AvailableMemory(root.path()) == 6 * kMiB);
}

TEST_CASE("AvailableMemory: this machine has some") { CHECK(AvailableMemory() > kMiB); }

TEST_CASE("BytesForPeople: picks the unit") {
  CHECK(BytesForPeople(0) == "0 bytes");
  CHECK(BytesForPeople(1023) == "1023 bytes");
  CHECK(BytesForPeople(1536) == "1.5 KiB");
  CHECK(BytesForPeople(3 * kMiB) == "3.0 MiB");
  CHECK(BytesForPeople(240 * 1024 * kMiB) == "240.0 GiB");
}

}  // namespace
}  // namespace swell::test
