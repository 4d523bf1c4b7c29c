// Calls the lookup of image textures for every vector of a column.
#include "bench/textures/filter_columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/textures/filter_columns.cc"
#include <hwy/foreach_target.h>

#include "kernels/filter-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void FilterColumns(const FilterColumnsArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const Rgb value = FilterImage(*args.image, args.wrap, args.filter, Load(args.s, i),
                                  Load(args.t, i), Load(args.width, i));
    Store(value.r, args.rgb[0], i);
    Store(value.g, args.rgb[1], i);
    Store(value.b, args.rgb[2], i);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(FilterColumns);
void FilterColumns(const FilterColumnsArgs& args) { HWY_DYNAMIC_DISPATCH(FilterColumns)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
