// Lambertian reflection on the side of wo: f = reflectance / pi, drawn by cosine in one of four
// ways.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/diffuse.cc"
#include <hwy/foreach_target.h>

#include "kernels/sampling-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Diffuse {
  Rgb reflectance;
  DiffuseSampling sampling;

  Diffuse(const Params& params, const PathSettings& settings)
      : reflectance(BroadcastRgb(params)), sampling(settings.diffuse_sampling) {}

  static constexpr bool kOpaque = true;
  static bool IsSpecular(const float* /*params*/) { return false; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 cosine = hn::IfThenElseZero(SameHemisphere(wo, wi), AbsCosTheta(wi));
    const F32 pdf = hn::Mul(cosine, Set(kInvPi));
    return {Scale(pdf, reflectance), pdf};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2) const {
    Vec3 wi = Draw(u0, u1, u2);
    const F32 pdf = hn::Mul(wi.z, Set(kInvPi));
    wi.z = hn::CopySign(wi.z, wo.z);
    return ScatterIf(HasSide(wo), {wi, reflectance, pdf, Set(1.0f)});
  }

 private:
  // The choice is uniform over the run: no lane diverges here.
  HWY_INLINE Vec3 Draw(F32 u0, F32 u1, F32 u2) const {
    switch (sampling) {
      case DiffuseSampling::kNormalPlusSphere:
        return CosineFromSphere(UniformSphere(u0, u1));
      case DiffuseSampling::kNormalPlusRejectedSphere:
        return CosineFromSphere(RejectedSphere(u0, u1, u2));
      case DiffuseSampling::kNormalPlusGaussian:
        return CosineFromSphere(GaussianSphere(u0, u1, u2));
      case DiffuseSampling::kDisk:
        break;
    }
    return CosineHemisphere(u0, u1);
  }
};

SWELL_MATERIAL_KERNELS(Diffuse)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kDiffuseParams[] = {
    {"reflectance",
     ParamType::kRgb,
     {0.5f, 0.5f, 0.5f},
     0.0f,
     1.0f,
     "share of light scattered back (albedo)",
     nullptr,
     0},
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Diffuse, "diffuse", kDiffuseParams,
                      "Lambertian reflection: the same radiance in every direction",
                      /*reciprocal=*/true);
#endif
