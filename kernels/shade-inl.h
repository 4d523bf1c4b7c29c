// Stands in for the shared shading loop until that is merged: appends nothing.
#if defined(SWELL_KERNELS_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SHADE_INL_H_
#undef SWELL_KERNELS_SHADE_INL_H_
#else
#define SWELL_KERNELS_SHADE_INL_H_
#endif

#include "kernels/bsdf_query-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

template <class M> size_t ShadeRows(const ShadeArgs& args) { return args.shadow_count; }

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SHADE_INL_H_
