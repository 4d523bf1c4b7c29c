// Directions of rays in, their rows grouped by octant out.
#if defined(SWELL_KERNELS_SORT_OCTANTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SORT_OCTANTS_INL_H_
#undef SWELL_KERNELS_SORT_OCTANTS_INL_H_
#else
#define SWELL_KERNELS_SORT_OCTANTS_INL_H_
#endif

#include "kernels/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Rows that are grouped at a time: as many as a wave has by default.
inline constexpr size_t kMostSorted = 4096;

// Rows, octant after octant, each in its order, and where each octant ends.
struct SortedRows {
  uint32_t row[kMostSorted + kRowPadding];
  uint32_t end[8];
};

// Sorts rows [first, first + count) and fills up the last vector with the last row. count: 1 to
// kMostSorted.
HWY_INLINE void SortOctants(const Vec3Fields<In>& dir, size_t first, size_t count,
                            SortedRows& sorted) {
  const size_t lanes = hn::Lanes(D());
  const auto of_octant = [&](U32 octants, uint32_t octant, size_t i) HWY_ATTR {
    return hn::And(FirstLanes(count - i), ToFloatMask(hn::Eq(octants, SetU(octant))));
  };
  // Of coherent rays most vectors are of one octant as a whole.
  const auto are_alike = [&](U32 octants, uint32_t octant, size_t i) HWY_ATTR {
    return i + lanes <= count && hn::AllTrue(DU(), hn::Eq(octants, SetU(octant)));
  };
  uint32_t start[9] = {0};
  for (size_t i = 0; i < count; i += lanes) {
    const U32 octants = OctantOf(Load(dir, first + i));
    const uint32_t some = hn::GetLane(octants);
    if (are_alike(octants, some, i)) {
      start[some + 1] += static_cast<uint32_t>(lanes);
      continue;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      start[octant + 1] += static_cast<uint32_t>(hn::CountTrue(D(), of_octant(octants, octant, i)));
    }
  }
  for (uint32_t octant = 1; octant < 8; ++octant) start[octant] += start[octant - 1];
  for (size_t i = 0; i < count; i += lanes) {
    const U32 octants = OctantOf(Load(dir, first + i));
    const U32 rows = CountFrom(static_cast<uint32_t>(first + i));
    const uint32_t some = hn::GetLane(octants);
    if (are_alike(octants, some, i)) {
      Store(rows, sorted.row, start[some]);
      start[some] += static_cast<uint32_t>(lanes);
      continue;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      const MaskU mask = ToUintMask(of_octant(octants, octant, i));
      start[octant] += static_cast<uint32_t>(
          hn::CompressBlendedStore(rows, mask, DU(), sorted.row + start[octant]));
    }
  }
  Store(SetU(sorted.row[count - 1]), sorted.row, count);
  for (uint32_t octant = 0; octant < 8; ++octant) sorted.end[octant] = start[octant];
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SORT_OCTANTS_INL_H_
