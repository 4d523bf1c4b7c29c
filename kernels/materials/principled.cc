// glTF's metallic-roughness surface: metal or dielectric over diffuse or thin glass, under sheen
// and a clear coat. Khronos, glTF 2.0 specification, appendix B, and KHR_materials_ior, _specular,
// _transmission, _clearcoat, _sheen, _anisotropy. Both sides look the same; what is transmitted
// goes on without refraction. A coat may have a normal of its own. The base under a dielectric's
// reflection gets what neither the facet nor the flat surface reflects: the specification's factor,
// of the facet alone, would make light at grazing angles.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/principled.cc"
#include <hwy/foreach_target.h>

#include "kernels/microfacet-inl.h"
#include "kernels/shade-inl.h"
#include "kernels/sheen-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Principled {
  Rgb base, normal_reflectance, sheen_color;
  F32 metallic, specular_weight, transmission, coat_weight, sheen_most;
  Microfacets facets, coat_facets;
  Sheen sheen;
  bool smooth, coat_smooth, has_sheen, turned, coat_tilted;
  Vec3 direction;              // of anisotropy, along u and v
  F32 rotation;                // of it, turns
  Vec3 coat_map, coat_normal;  // along u, v and the smooth normal; in the frame of directions

  Principled(const Params& p, const PathSettings& /*settings*/)
      : base(BroadcastRgb(p)),
        sheen_color(BroadcastRgb(p + 13)),
        metallic(Set(p[3])),
        specular_weight(Set(p[6])),
        transmission(Set(p[10])),
        coat_weight(Set(p[11])),
        sheen_most(MaxComponent(sheen_color)),
        facets(AlongU(Alpha(Set(p[4])), Set(p[21])), Alpha(Set(p[4]))),
        coat_facets(Alpha(Set(p[12]))),
        sheen(Set(p[16])),
        smooth(IsSmooth(p[4]) && p[21] == 0.0f),
        coat_smooth(IsSmooth(p[12])),
        has_sheen(HasSheen(p)),
        turned(p[22] != 1.0f || p[23] != 0.5f || p[25] != 0.0f),
        coat_tilted(HasCoatNormal(p)),
        direction(FromMap(p + 22)),
        rotation(hn::Mul(Set(p[25]), Set(0.5f * kInvPi))),
        coat_map(FromMap(p + 26)),
        coat_normal(coat_tilted ? UpperOrUp(coat_map) : coat_map) {
    const F32 one = Set(1.0f), ior = Set(p[5]);
    const F32 root = hn::Div(hn::Sub(one, ior), hn::Add(one, ior));
    const Rgb f0 = Scale(hn::Mul(root, root), BroadcastRgb(p + 7));
    normal_reflectance = {hn::Min(f0.r, one), hn::Min(f0.g, one), hn::Min(f0.b, one)};
  }

  static bool IsOpaque(const Params& p) { return p[10].column == nullptr && p[10] == 0.0f; }
  static bool IsSpecular(const float* p) {
    const bool no_diffuse = p[3] == 1.0f || p[10] == 1.0f;
    const bool no_gloss = IsSmooth(p[4]) && p[21] == 0.0f && (p[11] == 0.0f || IsSmooth(p[12]));
    return no_diffuse && no_gloss && !HasSheen(p);
  }

  static bool NeedsTangent(const float* p) { return p[21] > 0.0f || HasCoatNormal(p); }

  HWY_INLINE Frame Turn(const Frame& frame, F32 side, const Frame& smooth_frame) {
    Frame own = frame;
    if (turned) {
      F32 sin, cos;
      SinCosTurns(hn::Sub(rotation, hn::Floor(rotation)), &sin, &cos);
      const F32 x = hn::MulSub(cos, direction.x, hn::Mul(sin, direction.y));
      const F32 y = hn::Mul(side, hn::MulAdd(sin, direction.x, hn::Mul(cos, direction.y)));
      const Mask usable = hn::Gt(hn::MulAdd(x, x, hn::Mul(y, y)), Set(1e-6f));
      const Vec3 along = MulAdd(x, frame.x, Scale(y, frame.y));
      own.x = Normalize(IfThenElse(usable, along, frame.x));
      own.y = Cross(frame.z, own.x);
    }
    if (coat_tilted) {
      const Frame by_map = {smooth_frame.x, Scale(side, smooth_frame.y), smooth_frame.z};
      coat_normal = UpperOrUp(ToLocal(own, ToWorld(by_map, coat_map)));
    }
    return own;
  }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo_side, const Vec3& wi_side) const {
    const F32 zero = hn::Zero(D());
    const Mask below = hn::Lt(wo_side.z, zero);
    const Vec3 wo = FlipZ(below, wo_side), wi = FlipZ(below, wi_side);
    const Mask through = hn::Lt(wi.z, zero);
    const Vec3 light = FlipZ(through, wi);
    const CoatView coat_view = SeeCoat(wo);
    const Lobes lobes = Probabilities(wo.z, coat_view.wo.z);
    const Vec3 m = Normalize(Add(wo, light));
    const Shares shares = SharesAt(wo.z, light.z, Dot(wo, m), coat_view.wo.z);

    const F32 visible = hn::Mul(Set(0.25f), facets.VisibleDensity(wo, m));
    const F32 glint = smooth ? zero : hn::Mul(visible, facets.Shadowing(wo, light));
    const F32 lambert = hn::Mul(light.z, Set(kInvPi));
    Rgb back = Add(Scale(glint, shares.gloss), Scale(lambert, shares.diffuse));
    F32 back_pdf =
        hn::MulAdd(lobes.diffuse, lambert, smooth ? zero : hn::Mul(lobes.gloss, visible));
    if (has_sheen) back = Add(back, Scale(sheen.Evaluate(wo, light), shares.sheen));
    if (!coat_smooth) {
      const Vec3 coat_light = coat_tilted ? ToLocal(coat_view.frame, light) : light;
      const Vec3 coat_m = coat_tilted ? ToLocal(coat_view.frame, m) : m;
      F32 density = hn::Mul(Set(0.25f), coat_facets.VisibleDensity(coat_view.wo, coat_m));
      if (coat_tilted) density = hn::IfThenElseZero(hn::Gt(coat_light.z, zero), density);
      const F32 lit = hn::Mul(density, coat_facets.Shadowing(coat_view.wo, coat_light));
      const F32 coat = hn::Mul(shares.coat, lit);
      back = Add(back, {coat, coat, coat});
      back_pdf = hn::MulAdd(lobes.coat, density, back_pdf);
    }
    const Rgb on = Scale(glint, shares.glass);
    const F32 on_pdf = smooth ? zero : hn::Mul(lobes.glass, visible);
    const Mask valid = hn::And(HasSide(wo), HasSide(wi));
    return {IfThenElseZero(valid, IfThenElse(through, on, back)),
            hn::IfThenElseZero(valid, hn::IfThenElse(through, on_pdf, back_pdf))};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo_side, F32 u0, F32 u1, F32 u2) const {
    const F32 one = Set(1.0f);
    const Mask below = hn::Lt(wo_side.z, hn::Zero(D()));
    const Vec3 wo = FlipZ(below, wo_side);
    const CoatView coat_view = SeeCoat(wo);
    const Lobes lobes = Probabilities(wo.z, coat_view.wo.z);
    // One of coat, gloss, glass and diffuse, in this order.
    const F32 gloss_end = hn::Add(lobes.coat, lobes.gloss);
    const F32 glass_end = hn::Add(gloss_end, lobes.glass);
    const Mask coat = hn::Lt(u2, lobes.coat);
    const Mask gloss = AndNot(coat, hn::Lt(u2, gloss_end));
    const Mask diffuse = hn::Ge(u2, glass_end);
    const Mask glass = AndNot(diffuse, hn::Ge(u2, gloss_end));

    const Vec3 mirror = MirrorDirection(wo);
    const Vec3 glint = smooth ? mirror : ReflectAbout(facets.SampleVisible(wo, u0, u1), wo);
    const Vec3 coat_glint = CoatGlint(coat_view, u0, u1);
    const Vec3 reflected =
        IfThenElse(coat, coat_glint, IfThenElse(diffuse, CosineHemisphere(u0, u1), glint));
    const Vec3 wi = FlipZ(below, FlipZ(glass, reflected));
    const BsdfValue value = Evaluate(wo_side, wi);
    const Rgb weight = Scale(hn::Div(one, value.pdf), value.value);
    // Facets may send light below the surface, or below the coat's.
    const F32 zero = hn::Zero(D());
    Mask above = hn::Gt(reflected.z, zero);
    if (coat_tilted) {
      const Mask over_coat = hn::Gt(Dot(coat_view.frame.z, reflected), zero);
      above = hn::And(above, hn::Or(over_coat, hn::Not(coat)));
    }
    const Mask drawn = hn::And(above, hn::Gt(value.pdf, zero));
    const BsdfSample spread = ScatterIf(drawn, {wi, weight, value.pdf, one});
    if (!smooth && !coat_smooth) return spread;

    const Mask none = hn::Lt(one, one);
    const Mask smooth_base = smooth ? hn::Or(gloss, glass) : none;
    const Mask certain = hn::Or(smooth_base, coat_smooth ? coat : none);
    const Shares shares = SharesAt(wo.z, wo.z, wo.z, coat_view.wo.z);
    const Rgb through = Scale(hn::Div(one, lobes.glass), shares.glass);
    const Rgb back = Scale(hn::Div(one, lobes.gloss), shares.gloss);
    const F32 off_coat = hn::Div(shares.coat, lobes.coat);
    const Rgb exact =
        IfThenElse(coat, Rgb{off_coat, off_coat, off_coat}, IfThenElse(glass, through, back));
    const Mask sharp = hn::And(certain, hn::And(HasSide(wo), above));
    return {IfThenElse(sharp, wi, spread.wi), IfThenElse(sharp, exact, spread.weight),
            hn::IfThenElse(sharp, Set(kSpecularPdf), spread.pdf), one};
  }

 private:
  static HWY_INLINE F32 Alpha(F32 roughness) { return hn::Mul(roughness, roughness); }
  // KHR_materials_anisotropy: from alpha towards 1 by the squared strength.
  static HWY_INLINE F32 AlongU(F32 alpha, F32 strength) {
    return hn::MulAdd(hn::Mul(strength, strength), hn::Sub(Set(1.0f), alpha), alpha);
  }
  static bool IsSmooth(float roughness) { return roughness * roughness < kLeastAlpha; }
  static bool HasSheen(const float* p) { return p[13] > 0.0f || p[14] > 0.0f || p[15] > 0.0f; }
  static bool HasCoatNormal(const float* p) {
    return p[26] != 0.5f || p[27] != 0.5f || p[28] != 0.5f;
  }

  // A direction of any length, by the colours of a map.
  static HWY_INLINE Vec3 FromMap(const Params& p) {
    const F32 one = Set(1.0f), two = Set(2.0f);
    return {hn::MulSub(two, Set(p[0]), one), hn::MulSub(two, Set(p[1]), one),
            hn::MulSub(two, Set(p[2]), one)};
  }
  // Of unit length; up where it is below the surface.
  static HWY_INLINE Vec3 UpperOrUp(const Vec3& n) {
    const F32 zero = hn::Zero(D());
    const Mask above = hn::Gt(n.z, Set(1e-4f));
    return Normalize(IfThenElse(above, n, Vec3{zero, zero, Set(1.0f)}));
  }

  // The coat as seen from wo, above the surface: its frame, and wo in it. Where its normal leans
  // away from wo it has that of the surface.
  struct CoatView {
    Frame frame;
    Vec3 wo;
  };
  HWY_INLINE CoatView SeeCoat(const Vec3& wo) const {
    const F32 zero = hn::Zero(D()), one = Set(1.0f);
    const Frame own = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    if (!coat_tilted) return {own, wo};
    const Mask faces = hn::Gt(Dot(coat_normal, wo), zero);
    const Frame frame = MakeFrame(IfThenElse(faces, coat_normal, own.z));
    return {frame, ToLocal(frame, wo)};
  }
  HWY_INLINE Vec3 CoatGlint(const CoatView& view, F32 u0, F32 u1) const {
    const Vec3 glint = coat_smooth
                           ? MirrorDirection(view.wo)
                           : ReflectAbout(coat_facets.SampleVisible(view.wo, u0, u1), view.wo);
    return coat_tilted ? ToWorld(view.frame, glint) : glint;
  }

  // What each lobe counts, for an angle at the facet.
  struct Shares {
    Rgb gloss, diffuse, glass, sheen;
    F32 coat;
  };
  // With which each lobe is drawn; their sum is 1.
  struct Lobes {
    F32 coat, gloss, glass, diffuse;
  };

  static HWY_INLINE F32 FifthPower(F32 cosine) {
    const F32 x = hn::Max(hn::Sub(Set(1.0f), cosine), hn::Zero(D()));
    const F32 x2 = hn::Mul(x, x);
    return hn::Mul(hn::Mul(x2, x2), x);
  }
  // f0 + (1 - f0) fifth (Schlick 1994).
  static HWY_INLINE Rgb Schlick(const Rgb& f0, F32 fifth) {
    const F32 rest = hn::Sub(Set(1.0f), fifth);
    return Add(Scale(rest, f0), {fifth, fifth, fifth});
  }
  HWY_INLINE F32 CoatShare(F32 cos_o) const {
    return hn::Mul(coat_weight, hn::MulAdd(Set(0.96f), FifthPower(cos_o), Set(0.04f)));
  }

  HWY_INLINE Shares SharesAt(F32 cos_o, F32 cos_i, F32 cos_m, F32 coat_cos_o) const {
    const F32 one = Set(1.0f);
    const F32 fifth = FifthPower(cos_m);
    const F32 flattest = FifthPower(hn::Min(cos_m, hn::Min(cos_o, cos_i)));
    const Rgb dielectric = Schlick(normal_reflectance, fifth);
    const F32 taken = MaxComponent(Schlick(normal_reflectance, flattest));
    const F32 coat = CoatShare(coat_cos_o);
    F32 under = hn::Sub(one, coat);
    const Rgb sheen_share = Scale(under, sheen_color);
    if (has_sheen) {
      const F32 most = hn::Max(sheen.Albedo(cos_o), sheen.Albedo(cos_i));
      under = hn::Mul(under, hn::Max(hn::Zero(D()), hn::NegMulAdd(sheen_most, most, one)));
    }
    const F32 plastic = hn::Mul(under, hn::Sub(one, metallic));
    const F32 body = hn::Mul(plastic, hn::NegMulAdd(specular_weight, taken, one));
    const Rgb gloss = Add(Scale(hn::Mul(under, metallic), Schlick(base, fifth)),
                          Scale(hn::Mul(plastic, specular_weight), dielectric));
    return {gloss, Scale(hn::Mul(body, hn::Sub(one, transmission)), base),
            Scale(hn::Mul(body, transmission), base), sheen_share, coat};
  }

  HWY_INLINE Lobes Probabilities(F32 cos_o, F32 coat_cos_o) const {
    const F32 one = Set(1.0f), zero = hn::Zero(D());
    const Shares shares = SharesAt(cos_o, cos_o, cos_o, coat_cos_o);
    const F32 glass = MaxComponent(shares.glass);
    F32 diffuse = MaxComponent(shares.diffuse);
    if (has_sheen) diffuse = hn::Add(diffuse, hn::Mul(Set(0.5f), sheen_most));
    // Facets reflect more than the flat surface at some angles: no less than a fifth.
    const F32 body = hn::Add(diffuse, glass);
    const F32 flat = MaxComponent(shares.gloss);
    const F32 gloss = hn::Max(flat, hn::Mul(Set(0.25f), body));
    const F32 sum = hn::Max(hn::Add(hn::Add(shares.coat, gloss), body), Set(1e-20f));
    const F32 scale = hn::Div(one, sum);
    const F32 coat = hn::Mul(shares.coat, scale), shiny = hn::Mul(gloss, scale);
    const F32 clear = hn::Mul(glass, scale);
    const F32 rest = hn::Sub(one, hn::Add(coat, hn::Add(shiny, clear)));
    return {coat, shiny, clear, hn::IfThenElse(hn::Gt(diffuse, zero), rest, zero)};
  }
};

SWELL_MATERIAL_KERNELS(Principled)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/principled_params.h"

SWELL_EXPORT_MATERIAL(Principled, "principled", swell::kPrincipledParams,
                      "glTF's metallic-roughness surface with coat, sheen and thin glass",
                      /*reciprocal=*/false);
#endif
