// Rays without a hit -> background radiance onto paths.
#include "kernels/shade_miss.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade_miss.cc"
#include <hwy/foreach_target.h>

#include "kernels/environment-inl.h"
#include "kernels/lights-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// What one light at infinity sends along -dir, and the density with which it is drawn.
HWY_INLINE SkyLanes Sky(const LightsView& lights, const LightRecord& light, const Vec3& dir) {
  SkyLanes sky{BroadcastRgb(light.radiance), Set(kInvFourPi)};
  if (light.type == kImageInfiniteLight) {
    const SkyLanes seen = EvaluateSky(lights.images[light.image], dir);
    sky = {Mul(sky.radiance, seen.radiance), seen.pdf};
  }
  const float select_pdf =
      lights.tree.nodes != nullptr ? lights.tree.distant_pdf : light.select_pdf;
  sky.pdf = hn::Mul(sky.pdf, Set(select_pdf));
  return sky;
}

void ShadeMiss(const SceneView& scene, const RaysIn& rays, const uint32_t* rows, size_t count,
               const RgbFields<Out>& radiance) {
  const LightsView& lights = scene.lights;
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    const Mask active = FirstLanes(count - i);
    const U32 row = hn::IfThenElse(ToUintMask(active), Load(rows, i), SetU(rows[i]));
    const U32 state = Gather(rays.state, row);
    const U32 path = Gather(rays.path, row);
    const Vec3 dir = Gather(rays.dir, row);
    const Rgb throughput = Gather(rays.throughput, row);
    const F32 bsdf_pdf = Gather(rays.bsdf_pdf, row);

    const Mask specular = ToFloatMask(hn::TestBit(state, SetU(kSpecularRay)));
    Rgb sum = {hn::Zero(D()), hn::Zero(D()), hn::Zero(D())};
    for (uint32_t k = 0; k < lights.infinite_count; ++k) {
      const SkyLanes sky = Sky(lights, lights.records[lights.infinite[k]], dir);
      const F32 weight = hn::IfThenElse(specular, Set(1.0f), PowerHeuristic(bsdf_pdf, sky.pdf));
      sum = Add(sum, Scale(weight, sky.radiance));
    }

    AddToPaths(active, Mul(throughput, sum), radiance, path);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(ShadeMiss);
void ShadeMiss(const SceneView& scene, const RaysIn& rays, const uint32_t* rows, size_t count,
               const RgbFields<Out>& radiance) {
  HWY_DYNAMIC_DISPATCH(ShadeMiss)(scene, rays, rows, count, radiance);
}
}  // namespace swell::SWELL_WIDTH
#endif
