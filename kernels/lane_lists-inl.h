// Children of the tree that wait for single lanes of a packet or a bundle in, and out again.
#if defined(SWELL_KERNELS_LANE_LISTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LANE_LISTS_INL_H_
#undef SWELL_KERNELS_LANE_LISTS_INL_H_
#else
#define SWELL_KERNELS_LANE_LISTS_INL_H_
#endif

#include "kernels/bundle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A list is filled from its end, so that what was put last, the farthest, comes first.
class LaneLists {
 public:
  static constexpr uint32_t kMost = 24;  // of one lane

  HWY_INLINE void Clear(size_t lanes) {
    for (size_t i = 0; i < lanes; ++i) size_[i] = 0;
  }
  // Bit i: something waits for lane `first` + i, of a packet's.
  HWY_INLINE uint32_t Waiting(size_t first) const {
    return MaskBits(DU(), hn::Ne(hn::Load(DU(), size_ + first), SetU(0)));
  }
  HWY_INLINE uint32_t Size(size_t lane) const { return size_[lane]; }
  HWY_INLINE bool IsFull(size_t lane) const { return size_[lane] == kMost; }
  HWY_INLINE void Put(size_t lane, uint32_t child, float enter) {
    const uint32_t at = kMost - ++size_[lane];
    child_[lane][at] = child;
    enter_[lane][at] = enter;
  }
  // Whole vectors may be read from them on.
  HWY_INLINE const uint32_t* Children(size_t lane) const {
    return child_[lane] + kMost - size_[lane];
  }
  HWY_INLINE const float* Enters(size_t lane) const { return enter_[lane] + kMost - size_[lane]; }

 private:
  alignas(64) uint32_t size_[kBundleRays];
  uint32_t child_[kBundleRays][kMost + kBvhWidth];
  float enter_[kBundleRays][kMost + kBvhWidth];
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LANE_LISTS_INL_H_
