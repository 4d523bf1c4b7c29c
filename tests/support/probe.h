// Columns of words by value, for kernels over plain columns, and the check that law 1 asks for.
#ifndef SWELL_TESTS_SUPPORT_PROBE_H_
#define SWELL_TESTS_SUPPORT_PROBE_H_

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernels/lane_probe.h"
#include "tests/reference/vector.h"
#include "tests/support/for_each_target.h"

namespace swell::test {

inline constexpr uint32_t kScratchWord = 0xDEADBEEFu;

// `columns` columns of `count` rows and the padding, which holds kScratchWord.
class WordColumns {
 public:
  WordColumns(size_t columns, size_t count)
      : count_(count),
        cells_(columns,
               std::vector<uint32_t>(RoundUpToPadding(count) + kRowPadding, kScratchWord)) {}

  size_t count() const { return count_; }
  uint32_t& Word(size_t column, size_t row) { return cells_[column][row]; }
  uint32_t Word(size_t column, size_t row) const { return cells_[column][row]; }
  float Float(size_t column, size_t row) const { return std::bit_cast<float>(Word(column, row)); }
  void Set(size_t column, size_t row, float value) {
    Word(column, row) = std::bit_cast<uint32_t>(value);
  }
  std::vector<uint32_t*> Pointers() {
    std::vector<uint32_t*> pointers;
    for (auto& column : cells_) pointers.push_back(column.data());
    return pointers;
  }
  // Rows [0, count) of all columns, for comparisons.
  std::vector<uint32_t> Rows() const {
    std::vector<uint32_t> words;
    for (const auto& column : cells_)
      words.insert(words.end(), column.begin(), column.begin() + static_cast<ptrdiff_t>(count_));
    return words;
  }

 private:
  size_t count_;
  std::vector<std::vector<uint32_t>> cells_;
};

// The vector of a row, in three columns from `first` on.
inline reference::Vector At(const WordColumns& columns, size_t first, size_t row) {
  return {columns.Float(first, row), columns.Float(first + 1, row), columns.Float(first + 2, row)};
}
inline void Put(WordColumns& columns, size_t first, size_t row, const reference::Vector& v) {
  columns.Set(first, row, float(v.x));
  columns.Set(first + 1, row, float(v.y));
  columns.Set(first + 2, row, float(v.z));
}

// Runs a probe over all rows of `in`.
template <class Probe>
WordColumns RunProbe(const Probe& probe, Width width, WordColumns in, size_t out_columns,
                     const SceneView* scene = nullptr, uint32_t seed = 0) {
  WordColumns out(out_columns, in.count());
  const std::vector<uint32_t*> from = in.Pointers();
  const std::vector<uint32_t*> to = out.Pointers();
  probe(width, ProbeArgs{from.data(), to.data(), in.count(), scene, seed});
  return out;
}

// Results of run(width), vectors of words, must agree to the bit where there is fused
// multiply-add.
template <class Run> void CheckSameBits(const Run& run) {
  std::vector<uint32_t> expected;
  bool first = true;
  ForEachTarget([&](const char* target, Width width) {
    const std::vector<uint32_t> words = run(width);
    if (!HasFma(target)) return;
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    if (first) expected = words;
    first = false;
    CHECK((words == expected));
  });
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_PROBE_H_
