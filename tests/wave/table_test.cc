// Capacities in, claims about the layout of a table's columns out.
#include "src/wave/table.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>

#include "kernels/records.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

TEST_CASE(
    "Table: columns are aligned to a cache line, zero, and do not overlap with their padding") {
  for (size_t count : kRowCounts) {
    Table<RayFields> table(count);
    REQUIRE(table.ok());
    CHECK(table.capacity() >= count);
    CHECK(table.capacity() % kRowPadding == 0);
    const auto columns = table.Words();
    CHECK(columns.size() == 13);
    for (size_t c = 0; c < columns.size(); ++c) {
      CHECK(reinterpret_cast<uintptr_t>(columns[c]) % 64 == 0);
      for (size_t i = 0; i < table.capacity() + kRowPadding; ++i) {
        REQUIRE(columns[c][i] == 0);
        columns[c][i] = uint32_t(c);
      }
    }
    for (size_t c = 0; c < columns.size(); ++c) {
      const size_t rows = table.capacity() + kRowPadding;
      CHECK(std::accumulate(columns[c], columns[c] + rows, uint64_t{0}) == c * rows);
    }
    CHECK(table.bytes() >= (table.capacity() + kRowPadding) * columns.size() * 4);
  }
}

TEST_CASE("Table: columns by name and by number are the same, from any row on") {
  Table<ShadowRayFields> table(100);
  const ShadowRaysOut out = table.Columns(7);
  const ShadowRaysIn in = table.ReadColumns(7);
  const auto words = table.Words(7);
  CHECK(static_cast<void*>(out.org.x) == words[0]);
  CHECK(static_cast<void*>(out.dir.x) == words[3]);
  CHECK(static_cast<void*>(out.t_max) == words[6]);
  CHECK(static_cast<void*>(out.radiance.b) == words[9]);
  CHECK(static_cast<void*>(out.path) == words[10]);
  CHECK(in.t_max == out.t_max);
  CHECK(words[6] == table.Words()[6] + 7);
  CHECK(Table<ShadowRayFields>::kRowBytes == 44);
}

}  // namespace
}  // namespace swell::test
