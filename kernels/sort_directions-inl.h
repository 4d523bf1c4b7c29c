// Directions of rays in, their rows grouped by octant out; where neighbours differ anyway, within
// an octant by where they point.
#if defined(SWELL_KERNELS_SORT_DIRECTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SORT_DIRECTIONS_INL_H_
#undef SWELL_KERNELS_SORT_DIRECTIONS_INL_H_
#else
#define SWELL_KERNELS_SORT_DIRECTIONS_INL_H_
#endif

#include "kernels/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Rows that are grouped at a time: as many as a wave has by default.
inline constexpr size_t kMostSorted = 4096;

// Of an octant: four for each dominant axis. Finer ones, 48, were within 3 % (AVX-512).
inline constexpr uint32_t kDirectionCells = 12;

// Rows, octant after octant, each in its order, and where each octant ends.
struct SortedRows {
  uint32_t row[kMostSorted + kRowPadding];
  uint32_t end[8];
};

// Directions farther from each other than this, as vectors of length one, are not coherent:
// 0.2 to 0.5 were alike on later shadow rays of the Cornell box, 0.7 lost a seventh; 0.2 also sorts
// its first shadow rays, and loses 5 % there (AVX-512).
inline constexpr float kFarDirections = 0.4f;

// Whether directions are near those a vector of rows later, on the mean. If any is NaN, they are
// not.
HWY_INLINE bool AreCoherent(const Vec3Fields<In>& dir, size_t first, size_t count) {
  const size_t lanes = hn::Lanes(D());
  const auto sum_of = [](const Vec3& v) HWY_ATTR { return hn::Add(v.x, hn::Add(v.y, v.z)); };
  F32 apart = hn::Zero(D()), size = hn::Zero(D());  // in the 1-norm
  for (size_t i = 0; i + 2 * lanes <= count; i += lanes) {
    const Vec3 one = Load(dir, first + i), other = Load(dir, first + i + lanes);
    apart = hn::Add(apart, sum_of(Abs(Sub(one, other))));
    size = hn::Add(size, sum_of(Abs(one)));
  }
  const F32 limit = hn::Mul(Set(kFarDirections), hn::SumOfLanes(D(), size));
  return hn::GetLane(hn::SumOfLanes(D(), apart)) <= hn::GetLane(limit);
}

// Calls visit(row, octants, alike) for vectors of rows from `first` on; alike: all are of the
// octant of the first lane.
template <class Visit>
HWY_INLINE void ForEachOctants(const Vec3Fields<In>& dir, size_t first, size_t count,
                               const Visit& visit) {
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    const U32 octants = OctantOf(Load(dir, first + i));
    const bool alike = i + hn::Lanes(D()) <= count &&
                       hn::AllTrue(DU(), hn::Eq(octants, SetU(hn::GetLane(octants))));
    visit(i, octants, alike);
  }
}

HWY_INLINE void SortOctants(const Vec3Fields<In>& dir, size_t first, size_t count,
                            SortedRows& sorted) {
  const auto of_octant = [&](U32 octants, uint32_t octant, size_t i) HWY_ATTR {
    return hn::And(FirstLanes(count - i), ToFloatMask(hn::Eq(octants, SetU(octant))));
  };
  uint32_t start[9] = {0};
  ForEachOctants(dir, first, count, [&](size_t i, U32 octants, bool alike) HWY_ATTR {
    if (alike) {
      start[hn::GetLane(octants) + 1] += static_cast<uint32_t>(hn::Lanes(D()));
      return;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      start[octant + 1] += static_cast<uint32_t>(hn::CountTrue(D(), of_octant(octants, octant, i)));
    }
  });
  for (uint32_t octant = 1; octant < 8; ++octant) start[octant] += start[octant - 1];
  ForEachOctants(dir, first, count, [&](size_t i, U32 octants, bool alike) HWY_ATTR {
    const U32 rows = CountFrom(static_cast<uint32_t>(first + i));
    if (alike) {
      uint32_t& to = start[hn::GetLane(octants)];
      Store(rows, sorted.row, to);
      to += static_cast<uint32_t>(hn::Lanes(D()));
      return;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
      const MaskU mask = ToUintMask(of_octant(octants, octant, i));
      start[octant] += static_cast<uint32_t>(
          hn::CompressBlendedStore(rows, mask, DU(), sorted.row + start[octant]));
    }
  });
  for (uint32_t octant = 0; octant < 8; ++octant) sorted.end[octant] = start[octant];
}

// Octant, dominant axis, and on which side of cuts through the axis' part of the octant: a path
// through its four quarters, each about as large as the others.
HWY_INLINE U32 DirectionCellOf(const Vec3& dir) {
  const Vec3 size = Abs(dir);
  const DominantAxis<Mask> axis = DominantAxisOf(dir);
  const DominantAxis<MaskU> axis_u = {ToUintMask(axis.is_x), ToUintMask(axis.is_y)};
  const F32 cut = hn::Mul(Permute(axis, size.x, size.y, size.z), Set(0.45f));
  const Mask far_x = hn::Gt(Permute(axis, size.y, size.z, size.x), cut);
  const Mask far_y = hn::Gt(Permute(axis, size.z, size.x, size.y), cut);
  const auto bit_of = [](Mask mask, uint32_t bit)
                          HWY_ATTR { return hn::IfThenElseZero(ToUintMask(mask), SetU(bit)); };
  const U32 quarter = hn::Or(bit_of(far_x, 2), bit_of(hn::Xor(far_x, far_y), 1));
  const U32 octant = hn::Mul(OctantOf(dir), SetU(kDirectionCells));
  return hn::Add(octant, hn::Add(Permute(axis_u, SetU(0), SetU(4), SetU(8)), quarter));
}

HWY_INLINE void SortCells(const Vec3Fields<In>& dir, size_t first, size_t count,
                          SortedRows& sorted) {
  const hn::Rebind<uint8_t, DU> d8;
  uint8_t cell[kMostSorted + kRowPadding];
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    hn::StoreU(hn::TruncateTo(d8, DirectionCellOf(Load(dir, first + i))), d8, cell + i);
  }
  uint32_t start[8 * kDirectionCells + 1] = {0};
  for (size_t i = 0; i < count; ++i) ++start[cell[i] + 1];
  for (uint32_t c = 1; c < 8 * kDirectionCells; ++c) start[c] += start[c - 1];
  for (size_t i = 0; i < count; ++i) {
    sorted.row[start[cell[i]]++] = static_cast<uint32_t>(first + i);
  }
  for (uint32_t octant = 0; octant < 8; ++octant) {
    sorted.end[octant] = start[kDirectionCells * (octant + 1) - 1];
  }
}

// Sorts rows [first, first + count) and fills up the last vector with the last row. kCells: also
// within the octants, unless neighbours are coherent. count: 1 to kMostSorted.
template <bool kCells>
HWY_INLINE void SortDirections(const Vec3Fields<In>& dir, size_t first, size_t count,
                               SortedRows& sorted) {
  if (kCells && !AreCoherent(dir, first, count)) {
    SortCells(dir, first, count, sorted);
  } else {
    SortOctants(dir, first, count, sorted);
  }
  Store(SetU(sorted.row[count - 1]), sorted.row, count);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SORT_DIRECTIONS_INL_H_
