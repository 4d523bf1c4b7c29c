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
#include "src/bvh/spatial_split.h"

namespace swell {

// Rows in two groups, the left one first.
struct Parted {
  uint32_t left = 0;  // rows
  RefBounds of_left, of_right;
};

// Moves the rows for which goes_left holds to the front. Where rows go does not depend on a branch,
// which could not be foreseen.
template <class GoesLeft>
Parted PartitionInOnePass(Reference* refs, uint32_t count, const GoesLeft& goes_left) {
  RefBounds sides[2];
  uint32_t left = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const bool is_left = goes_left(refs[i]);
    const Reference ref = refs[i];
    sides[is_left ? 0 : 1].Add(ref);
    refs[i] = refs[left];
    refs[left] = ref;
    left += is_left ? 1 : 0;
  }
  return {left, sides[0], sides[1]};
}

// The same in parallel where it pays: every chunk in itself, then the rows beyond the middle for
// those before it. The order depends on the rows only.
template <class GoesLeft>
Parted Partition(Reference* refs, uint32_t count, const GoesLeft& goes_left) {
  constexpr size_t kChunk = 16384;
  if (count < 2 * kChunk) return PartitionInOnePass(refs, count, goes_left);
  struct Rows {
    size_t first, last, before;  // before: wrong rows of earlier chunks
  };
  const size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<Parted> parted(chunks);
  tbb::parallel_for(size_t{0}, chunks, [&](size_t i) {
    const size_t begin = i * kChunk, end = std::min<size_t>(count, begin + kChunk);
    parted[i] = PartitionInOnePass(refs + begin, static_cast<uint32_t>(end - begin), goes_left);
  });
  Parted all;
  for (const Parted& part : parted) {
    all.left += part.left;
    all.of_left.Add(part.of_left);
    all.of_right.Add(part.of_right);
  }
  // Rows on the wrong side of the middle, which are as many on either side.
  std::vector<Rows> low, high;
  size_t low_count = 0, high_count = 0;
  for (size_t i = 0; i < chunks; ++i) {
    const size_t begin = i * kChunk, end = std::min<size_t>(count, begin + kChunk);
    const size_t middle = begin + parted[i].left;
    const size_t low_end = std::min<size_t>(end, all.left);
    const size_t high_begin = std::max<size_t>(begin, all.left);
    if (middle < low_end) {
      low.push_back({middle, low_end, low_count});
      low_count += low_end - middle;
    }
    if (high_begin < middle) {
      high.push_back({high_begin, middle, high_count});
      high_count += middle - high_begin;
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
  return all;
}

struct CutResult {
  PageArray<Reference> refs;  // their memory
  std::span<Reference> left, right;
};

// Parts references at a plane. One that reaches over it is cut in two, or goes to one side as a
// whole where that is cheaper.
CutResult CutReferences(const Scene& scene, std::span<const Reference> refs,
                        const SpatialSplit& split, float price);

}  // namespace swell

#endif  // SWELL_BVH_PARTITION_H_
