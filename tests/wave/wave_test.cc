// Sizes of waves and windows in, claims about their layout out.
#include "src/wave/wave.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace swell::test {
namespace {

TEST_CASE("Wave: windows start on whole vectors, lie apart and fit into every table") {
  for (uint32_t row_count : {1u, 16u, 64u, 1000u, 4096u}) {
    for (uint32_t window_rows : {1u, 8u, 16u, 17u, 100u, 4096u}) {
      if (window_rows > std::max(row_count, 16u)) continue;
      CAPTURE(row_count);
      CAPTURE(window_rows);
      const Wave wave(row_count, window_rows, 3);
      REQUIRE(wave.ok());
      REQUIRE(!wave.windows.empty());
      size_t end = 0;
      for (const Window& window : wave.windows) {
        CHECK(window.first % kRowPadding == 0);
        CHECK(window.first >= end);
        CHECK(window.capacity == window_rows);
        CHECK(window.free_slots == window_rows);
        CHECK(window.rays == 0);
        end = window.first + RoundUpToPadding(window.capacity);
        std::vector<uint32_t> slots(&wave.slots[window.first],
                                    &wave.slots[window.first] + window_rows);
        std::sort(slots.begin(), slots.end());
        for (uint32_t i = 0; i < window_rows; ++i) REQUIRE(slots[i] == i);
      }
      CHECK(end <= wave.rays.capacity());
      CHECK(wave.row_count() == wave.windows.size() * window_rows);
      CHECK(wave.next.capacity() == wave.rays.capacity());
      CHECK(wave.hits.capacity() == wave.rays.capacity());
      CHECK(wave.shadow_rays.capacity() == wave.rays.capacity());
      CHECK(wave.paths.capacity() == wave.rays.capacity());
      for (const auto* list : {&wave.rows, &wave.keys, &wave.slots, &wave.ended}) {
        CHECK(list->size() >= wave.rays.capacity() + kRowPadding);
      }
      CHECK((wave.histogram == std::vector<uint32_t>(5, 0)));
      // A window has at most a run for each row and for each kind.
      CHECK(wave.runs.size() >= wave.windows.size() * std::min(5u, window_rows));
    }
  }
}

TEST_CASE("Wave: memory grows with the wave and not beyond what the rows need") {
  const Wave small(1024, 1024, 3), large(4096, 4096, 3);
  CHECK(large.bytes() > 3 * small.bytes());
  CHECK(large.bytes() < 5 * small.bytes());
  const Wave packets(4096, 8, 3);  // a window of 8 rows takes 16 of every column
  CHECK(packets.row_count() * 2 == large.row_count());
}

}  // namespace
}  // namespace swell::test
