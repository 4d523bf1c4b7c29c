// Lanes of lights that are triangles, in memory: their maths is compiled once, not into every
// material.
#if defined(SWELL_KERNELS_TRIANGLE_LIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRIANGLE_LIGHTS_INL_H_
#undef SWELL_KERNELS_TRIANGLE_LIGHTS_INL_H_
#else
#define SWELL_KERNELS_TRIANGLE_LIGHTS_INL_H_
#endif

#include "kernels/lanes-inl.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Lanes of other lights are given too; what they get does not matter.
struct alignas(64) TriangleLightLanes {
  static constexpr size_t kRows = hn::MaxLanes(D());
  float from[3][kRows];   // the point that is lit
  uint32_t light[kRows];  // row of LightsView::records
  float u0[kRows], u1[kRows];
  float wi[3][kRows];  // written by SampleTriangleLights, as in LightSample
  float end[3][kRows];
  float pdf[kRows];    // solid angle
  float angle[kRows];  // written by FindTriangleAngles: the solid angle; 0: sampled by area
};

HWY_INLINE void StoreTriangleQuery(const Vec3& from, U32 light, TriangleLightLanes& lanes) {
  StoreLanes(from, lanes.from);
  hn::Store(light, DU(), lanes.light);
}

// Defined in triangle_lights.cc.
void SampleTriangleLights(const LightsView& lights, TriangleLightLanes& lanes);
void FindTriangleAngles(const LightsView& lights, TriangleLightLanes& lanes);

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRIANGLE_LIGHTS_INL_H_
