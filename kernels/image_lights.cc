// Lanes that chose a light with an image -> its direction, radiance and density.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/image_lights.cc"
#include <hwy/foreach_target.h>

#include "kernels/environment-inl.h"
#include "kernels/image_lights-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE void Keep(Mask lanes, F32 v, float* to) {
  hn::Store(hn::IfThenElse(lanes, v, hn::Load(D(), to)), D(), to);
}

void SampleOneLight(const ImageLightView& light, Mask lanes, ImageLightLanes& q) {
  const Vec3 wi = {hn::Load(D(), q.wi[0]), hn::Load(D(), q.wi[1]), hn::Load(D(), q.wi[2])};
  Rgb factor;
  if (light.rows != 0) {
    const SkySample sky = SampleSky(light, hn::Load(D(), q.u0), hn::Load(D(), q.u1));
    factor = sky.radiance;
    Keep(lanes, sky.wi.x, q.wi[0]);
    Keep(lanes, sky.wi.y, q.wi[1]);
    Keep(lanes, sky.wi.z, q.wi[2]);
    Keep(lanes, sky.pdf, q.pdf);
  } else {
    factor = EvaluateBeam(light, Neg(wi));
  }
  Keep(lanes, hn::Mul(factor.r, hn::Load(D(), q.radiance[0])), q.radiance[0]);
  Keep(lanes, hn::Mul(factor.g, hn::Load(D(), q.radiance[1])), q.radiance[1]);
  Keep(lanes, hn::Mul(factor.b, hn::Load(D(), q.radiance[2])), q.radiance[2]);
}

// Light by light: their images and tables are then the same for all lanes at work.
void SampleImageLights(const LightsView& lights, ImageLightLanes& q) {
  const U32 image = hn::Load(DU(), q.image);
  MaskU todo = hn::Ne(image, SetU(kNone));
  while (!hn::AllFalse(DU(), todo)) {
    const uint32_t which = q.image[hn::FindKnownFirstTrue(DU(), todo)];
    const MaskU same = hn::And(todo, hn::Eq(image, SetU(which)));
    SampleOneLight(lights.images[which], ToFloatMask(same), q);
    todo = hn::AndNot(same, todo);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
