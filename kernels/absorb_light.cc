// Light and the media that it went through -> the light that is left, by Beer's law.
#include "kernels/absorb_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/absorb_light.cc"
#include <hwy/foreach_target.h>

#include <hwy/contrib/math/math-inl.h>

#include "kernels/lanes-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Nothing is absorbed where the coefficient is 0, however far light goes.
HWY_INLINE F32 Transmittance(F32 coefficient, F32 distance) {
  const Mask absorbs = hn::Gt(coefficient, hn::Zero(D()));
  const F32 depth = hn::Mul(coefficient, distance);
  return hn::Exp(D(), hn::Neg(hn::IfThenElseZero(absorbs, depth)));
}

void AbsorbLight(const AbsorbLightArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const U32 row = args.path == nullptr ? CountFrom(static_cast<uint32_t>(i)) : Load(args.path, i);
    const U32 medium = Gather(args.medium, hn::IfThenElseZero(active, row));
    const Mask within = ToFloatMask(hn::And(active, hn::Ne(medium, SetU(kVacuum))));
    if (hn::AllFalse(D(), within)) continue;

    F32 distance = Load(args.distance, i);
    if (args.nearest != nullptr) distance = hn::Min(distance, Load(args.nearest, i));
    if (args.dir.x != nullptr) {
      const Vec3 dir = Load(args.dir, i);
      distance = hn::Mul(distance, hn::Sqrt(Dot(dir, dir)));
    }
    distance = hn::IfThenElseZero(within, distance);
    const U32 at = hn::IfThenElseZero(ToUintMask(within), medium);
    const U32 word = hn::Add(hn::Add(at, at), at);
    const auto absorb = [&](size_t channel, float* light) HWY_ATTR {
      const F32 left = Transmittance(Gather(args.absorption + channel, word), distance);
      const F32 before = Load(light, i);
      Store(hn::IfThenElse(within, hn::Mul(before, left), before), light, i);
    };
    absorb(0, args.light.r);
    absorb(1, args.light.g);
    absorb(2, args.light.b);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(AbsorbLight);
void AbsorbLight(const AbsorbLightArgs& args) { HWY_DYNAMIC_DISPATCH(AbsorbLight)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
