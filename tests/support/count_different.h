// Two lists of hits in, how many differ out.
#ifndef SWELL_TESTS_SUPPORT_COUNT_DIFFERENT_H_
#define SWELL_TESTS_SUPPORT_COUNT_DIFFERENT_H_

#include <doctest/doctest.h>

#include <vector>

#include "tests/support/bvh_scenes.h"

namespace swell::test {

// To the bit. The first that differs is described.
inline size_t CountDifferent(const std::vector<HitFields<Row>>& got,
                             const std::vector<HitFields<Row>>& expected) {
  REQUIRE(got.size() == expected.size());
  size_t different = 0;
  for (size_t i = 0; i < got.size(); ++i) {
    if (SameHit(got[i], expected[i])) continue;
    if (different++ == 0) {
      MESSAGE("row ", i, ": got ", Describe(got[i]), ", expected ", Describe(expected[i]));
    }
  }
  return different;
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_COUNT_DIFFERENT_H_
