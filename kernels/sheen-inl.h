// glTF's sheen (KHR_materials_sheen): fibres that stand up from a surface, and what they leave of
// the light to it.
#if defined(SWELL_KERNELS_SHEEN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SHEEN_INL_H_
#undef SWELL_KERNELS_SHEEN_INL_H_
#else
#define SWELL_KERNELS_SHEEN_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "kernels/bsdf-inl.h"
#include "kernels/sampling-inl.h"
#include "kernels/sheen_albedo.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF". All directions lie above.
struct Sheen {
  F32 alpha;
  F32 row;  // of kSheenAlbedo

  explicit HWY_INLINE Sheen(F32 roughness) {
    const F32 least = hn::Max(roughness, Set(0.07f));
    alpha = hn::Mul(least, least);
    row = TablePlace(roughness);
  }

  // f |cos(wi)| of colour 1, held back where the model would scatter more than there is.
  HWY_INLINE F32 Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 one = Set(1.0f);
    const Vec3 half = Normalize(Add(wo, wi));
    const F32 sin2 = hn::Max(hn::NegMulAdd(half.z, half.z, one), Set(1e-12f));
    const F32 exponent = hn::Div(Set(0.5f), alpha);
    const F32 power = hn::Exp(D(), hn::Mul(exponent, hn::Log(D(), sin2)));
    const F32 density =
        hn::Mul(hn::Mul(hn::MulAdd(Set(2.0f), exponent, Set(2.0f)), power), Set(0.5f * kInvPi));
    const F32 hidden = hn::Add(one, hn::Add(Lambda(wo.z), Lambda(wi.z)));
    const F32 f_cos = hn::Div(density, hn::Mul(hidden, hn::Mul(Set(4.0f), wo.z)));
    return hn::Div(f_cos, hn::Max(one, hn::Max(Albedo(wo.z), Albedo(wi.z))));
  }

  // Scattered share at a cosine, between the entries of the table.
  HWY_INLINE F32 Albedo(F32 cosine) const {
    const F32 column = TablePlace(hn::Sqrt(cosine));
    const F32 x = hn::Floor(column), y = hn::Floor(row);
    const U32 at =
        hn::BitCast(DU(), hn::ConvertTo(DI(), hn::MulAdd(y, Set(float{kSheenSteps}), x)));
    const F32 right = hn::Sub(column, x), down = hn::Sub(row, y);
    const auto mix = [&](const float* base) HWY_ATTR {
      const F32 left = Gather(base, at);
      return hn::MulAdd(right, hn::Sub(Gather(base + 1, at), left), left);
    };
    const F32 above = mix(kSheenAlbedo);
    return hn::MulAdd(down, hn::Sub(mix(kSheenAlbedo + kSheenSteps), above), above);
  }

 private:
  // Place between the middles of the table's parts, up to the last but one.
  static HWY_INLINE F32 TablePlace(F32 v) {
    const F32 place = hn::MulSub(v, Set(float{kSheenSteps}), Set(0.5f));
    return hn::Max(hn::Zero(D()), hn::Min(place, Set(kSheenSteps - 1.0001f)));
  }

  HWY_INLINE F32 Curve(F32 x) const {
    const F32 rest = hn::Sub(Set(1.0f), alpha);
    const F32 t = hn::Mul(rest, rest);
    const auto between = [&](float rough, float smooth)
                             HWY_ATTR { return hn::MulAdd(t, Set(smooth - rough), Set(rough)); };
    const F32 safe = hn::Max(x, Set(1e-12f));
    const F32 power = hn::Exp(D(), hn::Mul(between(0.19823f, 0.16801f), hn::Log(D(), safe)));
    const F32 hyperbola = hn::Div(between(21.5473f, 25.3245f),
                                  hn::MulAdd(between(3.82987f, 3.32435f), power, Set(1.0f)));
    return hn::Add(hyperbola,
                   hn::MulAdd(between(-1.97760f, -1.27393f), x, between(-4.32054f, -4.85967f)));
  }
  HWY_INLINE F32 Lambda(F32 cosine) const {
    const Mask low = hn::Lt(cosine, Set(0.5f));
    const F32 x = hn::IfThenElse(low, cosine, hn::Sub(Set(1.0f), cosine));
    const F32 curve = Curve(x), middle = hn::Mul(Set(2.0f), Curve(Set(0.5f)));
    return hn::Exp(D(), hn::IfThenElse(low, curve, hn::Sub(middle, curve)));
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SHEEN_INL_H_
