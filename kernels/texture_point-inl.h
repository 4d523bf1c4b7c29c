// Hits -> the points that textures are evaluated at, with the width of the pixel there.
#if defined(SWELL_KERNELS_TEXTURE_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TEXTURE_POINT_INL_H_
#undef SWELL_KERNELS_TEXTURE_POINT_INL_H_
#else
#define SWELL_KERNELS_TEXTURE_POINT_INL_H_
#endif

#include "kernels/hit_surface-inl.h"
#include "kernels/surface_uv-inl.h"
#include "kernels/textures-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Texture coordinates of a hit whose primitive is instanced or not (`instance` is kNone), and their
// derivatives in world space. hit_point is in the world.
HWY_INLINE SurfaceUv HitUv(const SceneView& scene, const Vec3& hit_point, U32 instance, U32 prim,
                           F32 b1, F32 b2, bool second = false) {
  const MaskU is_placed = hn::Ne(instance, SetU(kNone));
  if (hn::AllFalse(DU(), is_placed)) return MakeSurfaceUv(scene, prim, b1, b2, hit_point, second);
  const InstanceLanes lanes(scene, hn::IfThenElseZero(is_placed, instance));
  const Mask placed = ToFloatMask(is_placed);
  const Vec3 in_object = Mul(lanes.to_object, Sub(hit_point, lanes.centre));
  SurfaceUv s =
      MakeSurfaceUv(scene, prim, b1, b2, IfThenElse(placed, in_object, hit_point), second);
  const auto place = [&](Vec3& derivative, F32& change) HWY_ATTR {
    const Vec3 there = IfThenElse(placed, Mul(lanes.to_world, derivative), derivative);
    const F32 before = Dot(derivative, derivative), after = Dot(there, there);
    const Mask stretched = hn::And(placed, hn::Gt(after, hn::Zero(D())));
    const F32 ratio = hn::Sqrt(hn::Div(before, hn::IfThenElse(stretched, after, Set(1.0f))));
    change = hn::IfThenElse(stretched, hn::Mul(change, ratio), change);
    derivative = there;
  };
  place(s.dpdu, s.du);
  place(s.dpdv, s.dv);
  return s;
}

// Width of the part of the surface that a pixel of the camera would see, were it seen straight
// from there (pbrt-v4 does likewise after bounces); along the surface's slope, up to a limit.
HWY_INLINE F32 FootprintWidth(const PixelFootprint& pixel, const Vec3& p, const Vec3& n) {
  if (pixel.parallel) return Set(pixel.spread);
  const Vec3 to = Sub(p, BroadcastVec3(pixel.camera));
  const F32 distance2 = hn::Max(Dot(to, to), Set(1e-30f));
  const F32 distance = hn::Sqrt(distance2);
  const F32 cosine = hn::Div(hn::Abs(Dot(to, n)), distance);
  return hn::Div(hn::Mul(distance, Set(pixel.spread)), hn::Max(cosine, Set(0.05f)));
}

// Gives `at` the colour of the vertices of `prim`, a triangle or not.
inline HWY_NOINLINE void AddVertexColor(const SceneView& scene, U32 prim, F32 b1, F32 b2,
                                        TexturePoint& at) {
  const MaskU triangle = hn::Lt(prim, SetU(scene.triangle_count));
  const U32 safe = hn::IfThenElseZero(triangle, prim);
  const U32 first = hn::Add(hn::Add(safe, safe), safe);
  const F32 weights[3] = {hn::Sub(hn::Sub(Set(1.0f), b1), b2), b1, b2};
  F32 sums[4] = {hn::Zero(D()), hn::Zero(D()), hn::Zero(D()), hn::Zero(D())};
  MaskU colored = triangle;
  for (size_t k = 0; k < 3; ++k) {
    const U32 vertex = Gather(scene.indices + k, first);
    colored = hn::And(colored, hn::Lt(vertex, SetU(scene.color_count)));
    const U32 word = hn::ShiftLeft<2>(hn::IfThenElseZero(colored, vertex));
    for (size_t c = 0; c < 4; ++c) {
      sums[c] = hn::MulAdd(weights[k], Gather(scene.colors + c, word), sums[c]);
    }
  }
  const Mask mask = ToFloatMask(colored);
  at.color = IfThenElse(mask, Rgb{sums[0], sums[1], sums[2]}, at.color);
  at.opacity = hn::IfThenElse(mask, sums[3], at.opacity);
}

// Gives `at` the second coordinates of a hit. point is in the world.
inline HWY_NOINLINE void AddSecondUv(const SceneView& scene, const Vec3& point, U32 instance,
                                     U32 prim, F32 b1, F32 b2, TexturePoint& at) {
  const SurfaceUv uv = HitUv(scene, point, instance, prim, b1, b2, true);
  at.u2 = uv.u;
  at.v2 = uv.v;
  at.du2 = uv.du;
  at.dv2 = uv.dv;
}

// `instance`, `prim`, b1 and b2 as the hit tells.
HWY_INLINE TexturePoint MakeTexturePoint(const SceneView& scene, const PixelFootprint& pixel,
                                         const Surface& surface, const SurfaceUv& uv, U32 instance,
                                         U32 prim, F32 b1, F32 b2) {
  const F32 one = Set(1.0f), width = FootprintWidth(pixel, surface.p, surface.n);
  TexturePoint at = {surface.p,       surface.ns, uv.u, uv.v, width, uv.du, uv.dv,
                     {one, one, one}, one,        uv.u, uv.v, uv.du, uv.dv};
  if (scene.color_count != 0) AddVertexColor(scene, prim, b1, b2, at);
  if (scene.second_uv_offsets != nullptr) {
    AddSecondUv(scene, surface.p, instance, prim, b1, b2, at);
  }
  return at;
}

// The number that each lane's own program gives, at the lanes of `wanted`; `other` elsewhere.
inline HWY_NOINLINE F32 TextureNumber(const TexturesView& textures, U32 program, MaskU wanted,
                                      const TexturePoint& at, F32 other) {
  alignas(64) uint32_t programs[hn::MaxLanes(DU())];
  hn::Store(program, DU(), programs);
  Rgb values[kMaxTextureSteps];
  F32 number = other;
  MaskU todo = wanted;
  while (!hn::AllFalse(DU(), todo)) {
    const uint32_t which = programs[hn::FindKnownFirstTrue(DU(), todo)];
    const MaskU same = hn::And(todo, hn::Eq(program, SetU(which)));
    EvaluateProgram(textures, textures.programs[which], at, values);
    const F32 value = values[textures.programs[which].step_count - 1].r;
    number = hn::IfThenElse(ToFloatMask(same), value, number);
    todo = hn::AndNot(same, todo);
  }
  return number;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TEXTURE_POINT_INL_H_
