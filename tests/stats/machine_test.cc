// What the program says of the machine it runs on.
#include "src/stats/machine.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "src/stats/isa.h"

namespace swell {
namespace {

TEST_CASE("DescribeMachine: names the set in use and its lanes") {
  const Machine wide = DescribeMachine(Width::kWide);
  CHECK(wide.isa == IsaInUse(Width::kWide).name);
  CHECK(wide.lanes == IsaInUse(Width::kWide).lanes);
  CHECK(wide.threads >= 1);
  CHECK(!wide.compiler.empty());
  CHECK(DescribeMachine(Width::kOneLane).lanes == 1);
}

TEST_CASE("CoreL2Bytes: is a plausible cache, or nothing") {
  const std::optional<uint64_t> bytes = CoreL2Bytes();
  if (!bytes) return;  // no sysfs here
  CHECK(*bytes >= 64 * 1024);
  CHECK(*bytes <= 1024 * 1024 * 1024);
}

TEST_CASE("PeakResidentBytes: grows with memory that was touched") {
  const std::optional<uint64_t> before = PeakResidentBytes();
  REQUIRE(before.has_value());
  const std::vector<char> memory(*before + (32u << 20), 1);
  CHECK(memory.back() == 1);
  CHECK(PeakResidentBytes().value() >= memory.size());
}

TEST_CASE("SwellVersion: is three numbers") {
  const std::string version = SwellVersion();
  CHECK(std::count(version.begin(), version.end(), '.') == 2);
}

}  // namespace
}  // namespace swell
