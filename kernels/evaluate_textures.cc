// Rows of one material -> columns of the parameters that vary.
#include "kernels/evaluate_textures.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/evaluate_textures.cc"
#include <hwy/foreach_target.h>

#include "kernels/tangent-inl.h"
#include "kernels/texture_point-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct TexturedHit {
  Surface surface;
  SurfaceUv uv;
  TexturePoint at;
  U32 instance, prim;
  F32 b1, b2;
};

HWY_INLINE TexturedHit LoadHit(const EvaluateTexturesArgs& args, U32 row) {
  const Vec3 org = Gather(args.rays.org, row);
  const Vec3 dir = Gather(args.rays.dir, row);
  const F32 t = Gather(args.hits.t, row);
  const U32 prim = Gather(args.hits.prim, row);
  const F32 b1 = Gather(args.hits.u, row);
  const F32 b2 = Gather(args.hits.v, row);

  const U32 instance =
      args.scene->instance_count == 0 ? SetU(kNone) : Gather(args.hits.instance, row);

  const Surface surface = HitSurface(*args.scene, org, dir, t, instance, prim, b1, b2);
  const SurfaceUv uv = HitUv(*args.scene, surface.p, instance, prim, b1, b2);
  const TexturePoint at =
      MakeTexturePoint(*args.scene, args.pixel, surface, uv, instance, prim, b1, b2);
  return {surface, uv, at, instance, prim, b1, b2};
}

HWY_INLINE Vec3 Flattened(const Vec3& v, const Vec3& n) { return MulAdd(hn::Neg(Dot(v, n)), n, v); }

// `normal`, on the side of the geometric one, where it is one.
HWY_INLINE Vec3 NormalOr(const Surface& surface, const Vec3& normal) {
  const F32 length2 = Dot(normal, normal);
  const Mask usable = hn::Gt(length2, Set(1e-30f));
  const Vec3 unit = Normalize(IfThenElse(usable, normal, surface.ns));
  const Mask behind = hn::Lt(Dot(unit, surface.n), hn::Zero(D()));
  return IfThenElse(behind, Neg(unit), unit);
}

// Height differences along u and v tilt the normal (Blinn 1978, "Simulation of Wrinkled Surfaces").
HWY_NOINLINE Vec3 BumpedNormal(const EvaluateTexturesArgs& args, const TextureProgram& program,
                               const TexturedHit& hit) {
  const TexturesView& textures = args.scene->textures;
  Rgb values[kMaxTextureSteps];
  const auto height = [&](const TexturePoint& at) HWY_ATTR {
    EvaluateProgram(textures, program, at, values);
    return values[program.step_count - 1].r;
  };
  const auto step = [&](F32 change) HWY_ATTR {
    const F32 half_pixel = hn::Mul(Set(0.5f), hn::Mul(change, hit.at.width));
    return hn::Max(half_pixel, Set(5e-4f));
  };
  const Vec3 ns = hit.surface.ns;
  const Vec3 dpdu = Flattened(hit.uv.dpdu, ns), dpdv = Flattened(hit.uv.dpdv, ns);
  const F32 du = step(hit.uv.du), dv = step(hit.uv.dv);
  TexturePoint along_u = hit.at, along_v = hit.at;
  along_u.p = MulAdd(du, dpdu, hit.at.p);
  along_u.u = hn::Add(hit.at.u, du);
  along_v.p = MulAdd(dv, dpdv, hit.at.p);
  along_v.v = hn::Add(hit.at.v, dv);

  const F32 here = height(hit.at);
  const F32 rise_u = hn::Div(hn::Sub(height(along_u), here), du);
  const F32 rise_v = hn::Div(hn::Sub(height(along_v), here), dv);
  return NormalOr(hit.surface, Cross(MulAdd(rise_u, ns, dpdu), MulAdd(rise_v, ns, dpdv)));
}

// The map's colours are the normal in the frame of the tangent, its part across, and the normal.
// The map is not filtered: what lies between its texels is.
HWY_NOINLINE Vec3 MappedNormal(const SceneView& scene, const TextureProgram& program,
                               const TexturedHit& hit) {
  const F32 one = Set(1.0f), two = Set(2.0f);
  const TextureStep& step = scene.textures.steps[program.normal_map];
  TexturePoint sharp = hit.at;
  sharp.width = hn::Zero(D());
  const Rgb texel = ImageStep(step, scene.textures.images[step.image], sharp);
  const Vec3 ns = hit.surface.ns;
  const Tangent tangent =
      HitTangent(scene, ns, {hit.uv.dpdu, hit.uv.dpdv}, hit.instance, hit.prim, hit.b1, hit.b2);
  const Vec3 flat = Flattened(tangent.along, ns);
  const Mask usable = hn::Gt(Dot(flat, flat), hn::Zero(D()));
  const Vec3 x = Normalize(IfThenElse(usable, flat, MakeFrame(ns).x));
  const Vec3 local = {hn::MulSub(two, texel.r, one), hn::MulSub(two, texel.g, one),
                      hn::MulSub(two, texel.b, one)};
  Vec3 y = Cross(ns, x);
  if (program.normal_map_follows_v) y = Scale(tangent.side, y);
  return NormalOr(hit.surface, ToWorld({x, y, ns}, local));
}

HWY_INLINE void StoreWithin(F32 value, const TextureOutput& output, float* column, size_t i) {
  Store(hn::Min(hn::Max(value, Set(output.min)), Set(output.max)), column, i);
}

void EvaluateTextures(const EvaluateTexturesArgs& args) {
  const TexturesView& textures = args.scene->textures;
  const TextureProgram& program = textures.programs[args.program];
  Rgb values[kMaxTextureSteps];
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const U32 row = hn::IfThenElse(active, Load(args.rows, i), SetU(args.rows[i]));
    const TexturedHit hit = LoadHit(args, row);
    EvaluateProgram(textures, program, hit.at, values);
    for (uint32_t k = 0; k < program.output_count; ++k) {
      const TextureOutput& output = textures.outputs[program.first_output + k];
      const Rgb& value = values[output.step];
      float* const* columns = args.columns + output.word;
      StoreWithin(value.r, output, columns[0], i);
      if (output.count == 1) continue;
      StoreWithin(value.g, output, columns[1], i);
      StoreWithin(value.b, output, columns[2], i);
    }
    if (program.bump != kNoTexture) {
      Store(BumpedNormal(args, textures.programs[program.bump], hit), args.normals, i);
    } else if (program.normal_map != kNoTexture) {
      Store(MappedNormal(*args.scene, program, hit), args.normals, i);
    }
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(EvaluateTextures);
void EvaluateTextures(const EvaluateTexturesArgs& args) {
  HWY_DYNAMIC_DISPATCH(EvaluateTextures)(args);
}
}  // namespace swell::SWELL_WIDTH
#endif
