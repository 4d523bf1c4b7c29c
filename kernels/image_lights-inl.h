// Lanes of lights that are images, in memory: SampleImageLights is compiled once, not into every
// material.
#if defined(SWELL_KERNELS_IMAGE_LIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_IMAGE_LIGHTS_INL_H_
#undef SWELL_KERNELS_IMAGE_LIGHTS_INL_H_
#else
#define SWELL_KERNELS_IMAGE_LIGHTS_INL_H_
#endif

#include "kernels/lanes-inl.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct alignas(64) ImageLightLanes {
  static constexpr size_t kRows = hn::MaxLanes(D());
  uint32_t image[kRows];       // row of LightsView::images; kNone: leave the lane alone
  uint32_t prim[kRows];        // surfaces that emit
  uint32_t whole[kRows];       // 1: whatever their opacity
  float point[3][kRows];       // on them
  float u0[kRows], u1[kRows];  // infinite lights: random numbers
  float wi[3][kRows];          // towards the light; written for infinite lights
  float radiance[3][kRows];    // multiplied by the image
  float pdf[kRows];            // written for infinite lights
};

// Defined in image_lights.cc.
void SampleImageLights(const SceneView& scene, ImageLightLanes& lanes);

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_IMAGE_LIGHTS_INL_H_
