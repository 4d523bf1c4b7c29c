// Nothing -> the number of float lanes of the target in use.
#include "kernels/lane_count.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lane_count.cc"
#include <hwy/foreach_target.h>

#include "kernels/lanes-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

uint32_t LaneCount() { return static_cast<uint32_t>(hn::Lanes(D())); }

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(LaneCount);
uint32_t LaneCount() { return HWY_DYNAMIC_DISPATCH(LaneCount)(); }
}  // namespace swell::SWELL_WIDTH
#endif
