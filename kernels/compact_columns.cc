// Columns with dropped rows between live ones -> dense columns, by compress-store.
#include "kernels/compact_columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/compact_columns.cc"
#include <hwy/foreach_target.h>

#include "kernels/lanes-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

size_t CompactColumns(const CompactArgs& args) {
  const DU du;
  size_t kept = 0;
  size_t dropped = 0;
  for (size_t i = 0; i < args.count; i += hn::Lanes(du)) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const MaskU drop = hn::And(active, hn::TestBit(Load(args.flags, i), SetU(args.drop)));
    const MaskU keep = hn::AndNot(drop, active);

    for (size_t c = 0; c < args.columns; ++c) {
      hn::CompressStore(Load(args.from[c], i), keep, du, args.to[c] + kept);
    }
    dropped += hn::CompressStore(Load(args.ids, i), drop, du, args.dropped_ids + dropped);
    kept += hn::CountTrue(du, keep);
  }
  return kept;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(CompactColumns);
size_t CompactColumns(const CompactArgs& args) {
  return HWY_DYNAMIC_DISPATCH(CompactColumns)(args);
}
}  // namespace swell::SWELL_WIDTH
#endif
