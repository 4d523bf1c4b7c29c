// The counters of stages: sharing out over bounces, and adding workers up.
#include "src/stats/stats.h"

#include <doctest/doctest.h>

namespace swell {
namespace {

TEST_CASE("StageStats: shares over bounces add up to the whole to the last unit") {
  StageStats stats(0);
  BounceCounts bounces{};
  bounces[0] = 3;
  bounces[1] = 1;
  bounces[5] = 3;
  stats.Record(Stage::kIntersect, bounces, {1, 7, 100, 128, 1001, 17, 5});
  const StageRow total = stats.total(Stage::kIntersect);
  CHECK(total.rows == 7);
  CHECK(total.lanes_active == 100);
  CHECK(total.lanes_issued == 128);
  CHECK(total.nanoseconds == 1001);
  CHECK(total.bytes_read == 17);
  CHECK(total.bytes_written == 5);
  CHECK(stats.row(Stage::kIntersect, 0).rows == 3);
  CHECK(stats.row(Stage::kIntersect, 1).rows == 1);
  CHECK(stats.row(Stage::kIntersect, 2).rows == 0);
  CHECK(stats.row(Stage::kIntersect, 5).rows == 3);
}

TEST_CASE("StageStats: a call without rows leaves no trace") {
  StageStats stats(0);
  stats.Record(Stage::kSort, BounceCounts{}, {1, 0, 0, 0, 50, 0, 0});
  CHECK(stats.total(Stage::kSort).calls == 0);
  CHECK(stats.total(Stage::kSort).nanoseconds == 0);
}

TEST_CASE("StageStats: merging adds stages, materials and totals") {
  BounceCounts bounces{};
  bounces[2] = 4;
  StageStats a(2), b(2);
  a.RecordShade(1, bounces, {1, 4, 4, 8, 10, 0, 0});
  b.RecordShade(1, bounces, {1, 4, 4, 8, 20, 0, 0});
  a.paths = 5;
  b.paths = 6;
  b.non_finite_samples = 1;
  a.Merge(b);
  CHECK(a.shade_row(1, 2).rows == 8);
  CHECK(a.shade_row(1, 2).nanoseconds == 30);
  CHECK(a.shade_row(0, 2).rows == 0);
  CHECK(a.total(Stage::kShade).rows == 8);
  CHECK(a.paths == 11);
  CHECK(a.non_finite_samples == 1);
}

}  // namespace
}  // namespace swell
