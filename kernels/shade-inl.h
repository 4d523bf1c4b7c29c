// The loop that all materials share: hits of one material -> shadow rays and continued paths.
#if defined(SWELL_KERNELS_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SHADE_INL_H_
#undef SWELL_KERNELS_SHADE_INL_H_
#else
#define SWELL_KERNELS_SHADE_INL_H_
#endif

#include "kernels/bsdf-inl.h"
#include "kernels/bsdf_query-inl.h"
#include "kernels/hit_surface-inl.h"
#include "kernels/lights-inl.h"
#include "kernels/rng-inl.h"
#include "kernels/tangent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// One vector of rows to shade.
struct ShadeRow {
  Vec3 dir;
  Rgb throughput;
  F32 eta_scale;
  U32 path, bounce;
  Surface surface;
  Frame frame;
  Vec3 wo;   // local
  U32 side;  // code of the normal on the side that scatters; see ReceivingSide
};

// Whether a material has directions of its own in the surface; see bsdf-inl.h.
template <class M> inline constexpr bool kTurnsFrames = requires(M& m, const Frame& frame) {
  m.Turn(frame, hn::Zero(D()), frame);
};

// What light sampling and the next hit must know of a surface that scatters light to nowhere but
// the side of wo: its normal there. As `side` of SampleLight.
HWY_INLINE U32 ReceivingSide(const Vec3& ns, const Vec3& wo) {
  const Mask behind = hn::Lt(wo.z, hn::Zero(D()));
  return EncodeNormal(IfThenElse(behind, Neg(ns), ns));
}

// With `along_u` the frame's x axis is the tangent, or where the material turns it; else any
// direction in the surface.
template <class M>
HWY_INLINE ShadeRow LoadShadeRow(const ShadeArgs& args, M& material, const RowLanes& row, size_t i,
                                 bool along_u) {
  const Vec3 org = row.Of(args.rays.org);
  const Vec3 dir = row.Of(args.rays.dir);
  const F32 t = row.Of(args.hits.t);
  const U32 prim = row.Of(args.hits.prim);
  const F32 u = row.Of(args.hits.u);
  const F32 v = row.Of(args.hits.v);

  ShadeRow r;
  r.dir = dir;
  r.throughput = row.Of(args.rays.throughput);
  r.eta_scale = row.Of(args.rays.eta_scale);
  r.path = row.Of(args.rays.path);
  r.bounce = hn::And(row.Of(args.rays.state), SetU(kBounceMask));
  // Scenes without instances do not pay for the column.
  const U32 instance = args.scene->instance_count == 0 ? SetU(kNone) : row.Of(args.hits.instance);
  r.surface = HitSurface(*args.scene, org, dir, t, instance, prim, u, v);
  const Vec3 smooth = r.surface.ns;
  if (args.normals.x != nullptr) r.surface.ns = Load(args.normals, i);
  if (along_u) {
    const UvAxes axes = HitAxes(*args.scene, r.surface.p, instance, prim);
    const Tangent tangent = HitTangent(*args.scene, smooth, axes, instance, prim, u, v);
    r.frame = MakeFrameAlong(r.surface.ns, tangent.along);
    if constexpr (kTurnsFrames<M>) {
      r.frame = material.Turn(r.frame, tangent.side, MakeFrameAlong(smooth, tangent.along));
    }
  } else {
    r.frame = MakeFrame(r.surface.ns);
  }
  r.wo = ToLocal(r.frame, Neg(dir));
  return r;
}

// Light sampling with multiple importance sampling: appends the shadow rays that could matter.
template <class M>
HWY_INLINE size_t AppendShadowRays(const ShadeArgs& args, const M& material, const ShadeRow& r,
                                   Mask active, Vec2 u, F32 u_select, U32 seed,
                                   size_t shadow_count) {
  const F32 zero = hn::Zero(D());
  const LightSample light = SampleLight(*args.scene, r.surface.p, r.side, u_select, u.x, u.y);
  const BsdfValue bsdf = EvaluateBsdf(material, r.wo, ToLocal(r.frame, light.wi), seed);
  const F32 weight = hn::IfThenElse(light.is_delta, Set(1.0f), PowerHeuristic(light.pdf, bsdf.pdf));
  const Rgb radiance =
      Scale(hn::Div(weight, light.pdf), Mul(r.throughput, Mul(bsdf.value, light.radiance)));
  const F32 brightest =
      hn::Max(hn::Abs(radiance.r), hn::Max(hn::Abs(radiance.g), hn::Abs(radiance.b)));
  const Mask matters = hn::And(active, hn::And(hn::Gt(light.pdf, zero), hn::Gt(brightest, zero)));
  if (hn::AllFalse(D(), matters)) return shadow_count;

  const Vec3 org = OffsetOrigin(r.surface.p, r.surface.error, r.surface.n, light.wi);
  const Vec3 dir = IfThenElse(light.at_infinity, light.wi, Sub(light.end, org));
  const F32 t_max = hn::IfThenElse(light.at_infinity, hn::Inf(D()), Set(1.0f));
  const ShadowRaysOut& out = args.shadow_rays;
  const auto append = [&](F32 v, float* column)
                          HWY_ATTR { hn::CompressStore(v, matters, D(), column + shadow_count); };
  append(org.x, out.org.x);
  append(org.y, out.org.y);
  append(org.z, out.org.z);
  append(dir.x, out.dir.x);
  append(dir.y, out.dir.y);
  append(dir.z, out.dir.z);
  append(t_max, out.t_max);
  append(radiance.r, out.radiance.r);
  append(radiance.g, out.radiance.g);
  append(radiance.b, out.radiance.b);
  return shadow_count +
         hn::CompressStore(r.path, ToUintMask(matters), DU(), out.path + shadow_count);
}

// Draws the next direction, plays roulette and writes the continued or ended path to row i of
// `next`.
template <class M>
HWY_INLINE void ContinuePaths(const ShadeArgs& args, const M& material, const ShadeRow& r,
                              const Sampler& sampler, U32 first_pair, F32 u_component, U32 seed,
                              size_t i) {
  const F32 zero = hn::Zero(D());
  const F32 one = Set(1.0f);
  const Vec2 u = sampler.Pair(hn::Add(first_pair, SetU(kPairScatter)));
  const BsdfSample sample = SampleBsdf(material, r.wo, u.x, u.y, u_component, seed);
  Rgb throughput = Mul(r.throughput, sample.weight);
  const F32 eta_scale = hn::Mul(r.eta_scale, sample.eta_scale);
  const F32 brightest =
      hn::Max(hn::Abs(throughput.r), hn::Max(hn::Abs(throughput.g), hn::Abs(throughput.b)));
  Mask alive = hn::And(hn::Gt(brightest, zero), hn::Gt(sample.pdf, zero));
  const U32 bounce = hn::Add(r.bounce, SetU(1));
  const Mask gamble = ToFloatMask(hn::Gt(bounce, SetU(args.settings.roulette_start)));
  if (!hn::AllFalse(D(), gamble)) {
    const F32 u_roulette = sampler.Pair(hn::Add(first_pair, SetU(kPairRoulette))).x;
    const F32 survive = hn::IfThenElse(gamble, hn::Min(one, hn::Mul(brightest, eta_scale)), one);
    alive = hn::And(alive, hn::Lt(u_roulette, survive));
    throughput = Scale(hn::Div(one, survive), throughput);
  }
  const Vec3 wi = ToWorld(r.frame, sample.wi);
  const Mask specular = hn::Eq(sample.pdf, Set(kSpecularPdf));
  const U32 flags = hn::IfThenElseZero(ToUintMask(specular), SetU(kSpecularRay));
  const U32 going = hn::Or(hn::Or(bounce, flags), hn::ShiftLeft<kNormalCodeShift>(r.side));
  const U32 state = hn::IfThenElse(ToUintMask(alive), going, hn::Or(bounce, SetU(kEndedRay)));

  const RaysOut& next = args.next;
  Store(OffsetOrigin(r.surface.p, r.surface.error, r.surface.n, wi), next.org, i);
  Store(wi, next.dir, i);
  Store(r.path, next.path, i);
  Store(throughput, next.throughput, i);
  Store(sample.pdf, next.bsdf_pdf, i);
  Store(eta_scale, next.eta_scale, i);
  Store(state, next.state, i);
}

template <class M> size_t ShadeRows(const ShadeArgs& args) {
  M material(Params(args.params), args.settings);
  const bool along_u = NeedsTangent<M>(args.params);
  const bool sample_lights = !M::IsSpecular(args.params) && args.scene->lights.count != 0;
  const bool has_side =
      args.scene->lights.tree.nodes != nullptr && IsOpaque<M>(Params(args.params, args.columns, 0));
  size_t shadow_count = args.shadow_count;
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const Mask active = FirstLanes(args.count - i);
    const U32 row = hn::IfThenElse(ToUintMask(active), Load(args.rows, i), SetU(args.rows[i]));
    if (args.columns != nullptr) {
      material = M(Params(args.params, args.columns, i), args.settings);
    }
    ShadeRow r = LoadShadeRow(args, material, RowLanes(row, args.rows[i]), i, along_u);
    r.side = has_side ? ReceivingSide(r.surface.ns, r.wo) : SetU(kNoNormalCode);

    const Sampler sampler(Gather(args.paths.pixel, r.path), Gather(args.paths.sample, r.path),
                          args.settings.seed, args.settings.sampler);
    const U32 first_pair =
        hn::Add(hn::Mul(r.bounce, SetU(kPairsPerBounce)), SetU(kPairFirstBounce));
    const U32 seed = sampler.Seed(first_pair);
    const Vec2 choices = sampler.Pair(hn::Add(first_pair, SetU(kPairChoices)));
    if (sample_lights) {
      const Vec2 u = sampler.Pair(hn::Add(first_pair, SetU(kPairLightPoint)));
      shadow_count = AppendShadowRays(args, material, r, active, u, choices.y, seed, shadow_count);
    }
    ContinuePaths(args, material, r, sampler, first_pair, choices.x, seed, i);
  }
  return shadow_count;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SHADE_INL_H_
