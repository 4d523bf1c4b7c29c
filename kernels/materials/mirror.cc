// Perfect mirror with a tint: all light goes to the mirror direction.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/mirror.cc"
#include <hwy/foreach_target.h>

#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Mirror {
  Rgb reflectance;

  Mirror(const float* params, const PathSettings& /*settings*/)
      : reflectance(BroadcastRgb(params)) {}

  static bool IsSpecular(const float* /*params*/) { return true; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
    const F32 zero = hn::Zero(D());
    return {{zero, zero, zero}, zero};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 /*u0*/, F32 /*u1*/, F32 /*u2*/) const {
    return ScatterIf(HasSide(wo), {MirrorDirection(wo), reflectance, Set(kSpecularPdf), Set(1.0f)});
  }
};

SWELL_MATERIAL_KERNELS(Mirror)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kMirrorParams[] = {
    {"reflectance",
     ParamType::kRgb,
     {1.0f, 1.0f, 1.0f},
     0.0f,
     1.0f,
     "tint of the mirror image",
     nullptr,
     0},
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Mirror, "mirror", kMirrorParams,
                      "perfect mirror with a tint, from both sides",
                      /*reciprocal=*/true);
#endif
