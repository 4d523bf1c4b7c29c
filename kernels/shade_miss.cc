// Rays without a hit -> background radiance onto paths.
#include "kernels/shade_miss.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade_miss.cc"
#include <hwy/foreach_target.h>

#include "kernels/lights-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void ShadeMiss(const SceneView& scene, const RaysIn& rays, const uint32_t* rows, size_t count,
               const RgbFields<Out>& radiance) {
  const Rgb background = BroadcastRgb(scene.lights.infinite_radiance);
  const F32 light_pdf = Set(scene.lights.infinite_select_pdf * kInvFourPi);
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    const Mask active = FirstLanes(count - i);
    const U32 row = hn::IfThenElseZero(ToUintMask(active), Load(rows, i));
    const U32 state = Gather(rays.state, row);
    const U32 path = Gather(rays.path, row);
    const Rgb throughput = Gather(rays.throughput, row);
    const F32 bsdf_pdf = Gather(rays.bsdf_pdf, row);

    const Mask specular = ToFloatMask(hn::TestBit(state, SetU(kSpecularRay)));
    const F32 weight = hn::IfThenElse(specular, Set(1.0f), PowerHeuristic(bsdf_pdf, light_pdf));

    AddToPaths(active, Scale(weight, Mul(throughput, background)), radiance, path);
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
