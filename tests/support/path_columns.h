// Ended paths for tests of the film: columns that own their memory.
#ifndef SWELL_TESTS_SUPPORT_PATH_COLUMNS_H_
#define SWELL_TESTS_SUPPORT_PATH_COLUMNS_H_

#include <cstdint>
#include <numeric>
#include <vector>

#include "kernels/records.h"

namespace swell::test {

struct PathColumns {
  std::vector<uint32_t> pixel, sample;
  std::vector<float> r, g, b;

  void Append(uint32_t x, uint32_t y, float red, float green, float blue) {
    pixel.push_back(x | y << 16);
    sample.push_back(static_cast<uint32_t>(sample.size()));
    r.push_back(red);
    g.push_back(green);
    b.push_back(blue);
  }
  size_t size() const { return pixel.size(); }
  PathsIn In() const { return {pixel.data(), sample.data(), {r.data(), g.data(), b.data()}}; }
  std::vector<uint32_t> AllRows() const {
    std::vector<uint32_t> rows(size());
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
  }
};

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_PATH_COLUMNS_H_
