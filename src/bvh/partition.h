// References in, the same in two groups out: moved in place, or cut at a plane into new memory.
#ifndef SWELL_BVH_PARTITION_H_
#define SWELL_BVH_PARTITION_H_

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src/bvh/bvh.h"
#include "src/bvh/find_split.h"

namespace swell {

// Moves the rows for which goes_left holds to the front, in parallel where it pays: every chunk in
// itself, then the rows beyond the middle for those before it. The order depends on the rows only.
template <class GoesLeft>
uint32_t Partition(Reference* refs, uint32_t count, const GoesLeft& goes_left) {
  constexpr size_t kChunk = 16384;
  if (count < 2 * kChunk) {
    return static_cast<uint32_t>(std::partition(refs, refs + count, goes_left) - refs);
  }
  struct Rows {
    size_t first, last, before;  // before: wrong rows of earlier chunks
  };
  const size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<size_t> middles(chunks);
  tbb::parallel_for(size_t{0}, chunks, [&](size_t i) {
    Reference* begin = refs + i * kChunk;
    Reference* end = refs + std::min<size_t>(count, (i + 1) * kChunk);
    middles[i] = static_cast<size_t>(std::partition(begin, end, goes_left) - refs);
  });
  size_t middle = 0;
  for (size_t i = 0; i < chunks; ++i) middle += middles[i] - i * kChunk;
  // Rows on the wrong side of the middle, which are as many on either side.
  std::vector<Rows> low, high;
  size_t low_count = 0, high_count = 0;
  for (size_t i = 0; i < chunks; ++i) {
    const size_t begin = i * kChunk, end = std::min<size_t>(count, begin + kChunk);
    const size_t low_end = std::min(end, middle), high_begin = std::max(begin, middle);
    if (middles[i] < low_end) {
      low.push_back({middles[i], low_end, low_count});
      low_count += low_end - middles[i];
    }
    if (high_begin < middles[i]) {
      high.push_back({high_begin, middles[i], high_count});
      high_count += middles[i] - high_begin;
    }
  }
  tbb::parallel_for(size_t{0}, low.size(), [&](size_t i) {
    size_t other = static_cast<size_t>(
        std::upper_bound(high.begin(), high.end(), low[i].before,
                         [](size_t before, const Rows& rows) { return before < rows.before; }) -
        high.begin() - 1);
    size_t at = high[other].first + (low[i].before - high[other].before);
    for (size_t row = low[i].first; row < low[i].last; ++row) {
      if (at == high[other].last) at = high[++other].first;
      std::swap(refs[row], refs[at++]);
    }
  });
  return static_cast<uint32_t>(middle);
}

struct CutResult {
  PageArray<Reference> refs;  // their memory
  std::span<Reference> left, right;
};

// Parts references at a plane. One that reaches over it is cut in two, or goes to one side as a
// whole where that is cheaper.
CutResult CutReferences(const Scene& scene, std::span<const Reference> refs,
                        const SpatialSplit& split);

}  // namespace swell

#endif  // SWELL_BVH_PARTITION_H_
