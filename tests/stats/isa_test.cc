// The instruction sets: what can be chosen, what is in use after a choice.
#include "src/stats/isa.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace swell {
namespace {

struct RestoreIsa {
  ~RestoreIsa() { (void)SelectIsa("auto"); }
};

TEST_CASE("SelectIsa: every usable set is the one in use afterwards") {
  const RestoreIsa restore;
  const std::vector<std::string> usable = UsableIsaNames();
  REQUIRE(!usable.empty());
  for (const std::string& name : usable) {
    INFO(name);
    CHECK(static_cast<bool>(SelectIsa(name)));
    CHECK(IsaInUse(Width::kWide).name == name);
  }
}

TEST_CASE("SelectIsa: auto takes the best usable set") {
  const RestoreIsa restore;
  REQUIRE(static_cast<bool>(SelectIsa("auto")));
  CHECK(IsaInUse(Width::kWide).name == UsableIsaNames().front());
}

TEST_CASE("SelectIsa: a choice can be taken back") {
  const RestoreIsa restore;
  REQUIRE(static_cast<bool>(SelectIsa("scalar")));
  CHECK(IsaInUse(Width::kWide).lanes == 1);
  REQUIRE(static_cast<bool>(SelectIsa("auto")));
  CHECK(IsaInUse(Width::kWide).name == UsableIsaNames().front());
}

TEST_CASE("IsaInUse: the one-lane kernels never use a set they are not compiled for") {
  const RestoreIsa restore;
  for (const std::string& name : UsableIsaNames()) {
    INFO(name);
    REQUIRE(static_cast<bool>(SelectIsa(name)));
    const IsaInfo isa = IsaInUse(Width::kOneLane);
    CHECK(isa.one_lane);
    CHECK(isa.lanes == 1);
    // Nor one above the choice: bits of better sets are lower.
    CHECK(isa.target >= IsaInUse(Width::kWide).target);
  }
}

TEST_CASE("SelectIsa: an unknown name is an error that says which exist") {
  const Status status = SelectIsa("avx1024");
  REQUIRE(!status);
  for (const std::string& name : UsableIsaNames()) {
    CHECK(status.error().message.find(name) != std::string::npos);
  }
}

TEST_CASE("Isas: scalar is always usable, better sets come first") {
  const std::vector<IsaInfo> isas = Isas();
  CHECK(std::string(isas.back().name) == "scalar");
  CHECK(isas.back().cpu_supports);
  CHECK(std::is_sorted(isas.begin(), isas.end(),
                       [](const IsaInfo& a, const IsaInfo& b) { return a.target < b.target; }));
}

}  // namespace
}  // namespace swell
