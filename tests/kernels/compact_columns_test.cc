// Columns with dropped rows in, dense columns and the ids of the dropped out.
#include "kernels/compact_columns.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "tests/support/probe.h"

namespace swell::test {
namespace {

// The first column holds flags, the second ids.
void CheckCompact(const WordColumns& rays, uint32_t drop) {
  const size_t count = rays.count();
  std::vector<std::vector<uint32_t>> kept(9);
  std::vector<uint32_t> dropped;
  for (size_t i = 0; i < count; ++i) {
    if ((rays.Word(0, i) & drop) != 0) {
      dropped.push_back(rays.Word(1, i));
    } else {
      for (size_t c = 0; c < 9; ++c) kept[c].push_back(rays.Word(c, i));
    }
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
    WordColumns from = rays;
    WordColumns to(9, count);
    WordColumns ids(1, count);
    const std::vector<uint32_t*> from_columns = from.Pointers();
    const std::vector<uint32_t*> to_columns = to.Pointers();
    const size_t n =
        CompactColumns(width, {from_columns.data(), to_columns.data(), 9, count, from_columns[0],
                               drop, from_columns[1], ids.Pointers()[0]});
    REQUIRE(n == kept[0].size());
    for (size_t c = 0; c < 9; ++c) {
      for (size_t i = 0; i < n; ++i) REQUIRE(to.Word(c, i) == kept[c][i]);
    }
    for (size_t i = 0; i < dropped.size(); ++i) REQUIRE(ids.Word(0, i) == dropped[i]);
    for (size_t c = 0; c < 9; ++c) {  // beyond the rows and their padding nothing is written
      for (size_t i = RoundUpToPadding(count); i < RoundUpToPadding(count) + kRowPadding; ++i) {
        REQUIRE(to.Word(c, i) == kScratchWord);
        REQUIRE(ids.Word(0, i) == kScratchWord);
      }
    }
    CHECK((from.Rows() == rays.Rows()));
  });
}

TEST_CASE("CompactColumns: keeps and drops rows in their order, whatever share is dropped") {
  std::mt19937 random(1);
  for (size_t count : kRowCounts) {
    for (uint32_t percent : {0u, 1u, 50u, 99u, 100u}) {
      WordColumns rays(9, count);
      for (size_t i = 0; i < count; ++i) {
        for (size_t c = 1; c < 9; ++c) rays.Word(c, i) = uint32_t(random());
        rays.Word(0, i) =
            (uint32_t(random()) & ~kEndedRay) | (random() % 100 < percent ? kEndedRay : 0u);
      }
      CheckCompact(rays, kEndedRay);
    }
  }
}

}  // namespace
}  // namespace swell::test
