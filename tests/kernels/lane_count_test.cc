// Tests that kernels run on the target and with the width that a test asks for.
#include "kernels/lane_count.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

TEST_CASE("LaneCount: is the width of the target that was chosen, and one for one lane") {
  std::set<std::string> targets;
  ForEachTarget([&](const std::string& target, Width width) {
    INFO(target, ", one lane: ", width == Width::kOneLane);
    targets.insert(target);
    const uint32_t wide = target == "avx3" ? 16 : target == "avx2" ? 8 : target == "scalar" ? 1 : 4;
    CHECK(LaneCount(width) == (width == Width::kWide ? wide : 1));
  });
  CHECK(targets.count("scalar") == 1);
}

TEST_CASE("ForEachTarget: gives back the best target") {
  const uint32_t before = LaneCount(Width::kWide);
  ForEachTarget([](const char* /*target*/, Width /*width*/) {});
  CHECK(LaneCount(Width::kWide) == before);
}

}  // namespace
}  // namespace swell::test
