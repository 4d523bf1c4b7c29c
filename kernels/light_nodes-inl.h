// Rows of a light tree's siblings, one for each lane -> their nodes as lanes.
#if defined(SWELL_KERNELS_LIGHT_NODES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LIGHT_NODES_INL_H_
#undef SWELL_KERNELS_LIGHT_NODES_INL_H_
#else
#define SWELL_KERNELS_LIGHT_NODES_INL_H_
#endif

#include <cstddef>

#include "kernels/lanes-inl.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct NodeLanes {
  Vec3 centre;
  F32 radius;
  Vec3 axis;
  F32 cos_o, sin_o, cos_e, intensity;
  U32 child;
};

// Four words that follow each other in memory.
struct FourWords {
  F32 a, b, c, d;
};

#if defined(SWELL_ONE_LANE) || HWY_TARGET == HWY_SCALAR
HWY_INLINE FourWords LoadFours(const float* base, const uint32_t* at) {
  const float* words = base + at[0];
  return {Set(words[0]), Set(words[1]), Set(words[2]), Set(words[3])};
}
#else
// Every fourth lane's words, beside each other.
template <class DT> HWY_INLINE hn::Vec<DT> LoadBlocks(DT d, const float* base, const uint32_t* at) {
  if constexpr (hn::MaxLanes(d) == 4) {
    return hn::Load(d, base + at[0]);
  } else {
    const hn::Half<DT> half;
    return hn::Combine(d, LoadBlocks(half, base, at + hn::MaxLanes(half)),
                       LoadBlocks(half, base, at));
  }
}

// base[at[lane] + 0 to 3], aligned to 16 bytes, by one load a lane. Against a gather a word, a draw
// among the lamps of lights-1000 takes 0.7 of the time (AVX-512, rows of four siblings).
HWY_INLINE FourWords LoadFours(const float* base, const uint32_t* at) {
  const D d;
  const hn::Repartition<uint64_t, D> d64;
  const F32 r0 = LoadBlocks(d, base, at), r1 = LoadBlocks(d, base, at + 1);
  const F32 r2 = LoadBlocks(d, base, at + 2), r3 = LoadBlocks(d, base, at + 3);
  const auto ab01 = hn::BitCast(d64, hn::InterleaveLower(d, r0, r1));
  const auto ab23 = hn::BitCast(d64, hn::InterleaveLower(d, r2, r3));
  const auto cd01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto cd23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveLower(d64, cd01, cd23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, cd01, cd23))};
}
#endif

class SiblingLanes {
 public:
  // `first` of each lane's row.
  SiblingLanes(const LightNode* nodes, U32 first) : words_(reinterpret_cast<const float*>(nodes)) {
    hn::Store(hn::Mul(first, SetU(sizeof(LightNode) / 4)), DU(), at_);
  }

  HWY_INLINE NodeLanes Get(uint32_t k) const {
    const float* node = words_ + k * (sizeof(LightNode) / 4);
    const FourWords box = LoadFours(node, at_);
    const FourWords cone = LoadFours(node + 4, at_);
    const FourWords rest = LoadFours(node + 8, at_);
    return {{box.a, box.b, box.c}, box.d, {cone.a, cone.b, cone.c}, cone.d, rest.a, rest.b, rest.c,
            Bits(rest.d)};
  }

 private:
  const float* words_;
  alignas(64) uint32_t at_[hn::MaxLanes(DU())];
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LIGHT_NODES_INL_H_
