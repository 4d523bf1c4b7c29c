// Rays and their hits -> emitted light onto paths.
#include "kernels/shade_emission.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade_emission.cc"
#include <hwy/foreach_target.h>

#include "kernels/filter-inl.h"
#include "kernels/lights-inl.h"
#include "kernels/surface_uv-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// What the lights' images are at the hits, 1 where a light has none. Image by image.
HWY_NOINLINE Rgb EmissionImages(const SceneView& scene, const LightLanes& light, MaskU emits,
                                U32 prim, F32 b1, F32 b2, const Vec3& point) {
  const F32 one = Set(1.0f);
  Rgb factor = {one, one, one};
  MaskU todo = hn::And(emits, ToUintMask(light.pictured()));
  const SurfaceUv first = MakeSurfaceUv(scene, prim, b1, b2, point);
  const U32 image = light.Word(offsetof(LightRecord, image));
  while (!hn::AllFalse(DU(), todo)) {
    alignas(64) uint32_t images[hn::MaxLanes(DU())];
    hn::Store(image, DU(), images);
    const uint32_t which = images[hn::FindKnownFirstTrue(DU(), todo)];
    const MaskU same = hn::And(todo, hn::Eq(image, SetU(which)));
    const ImageLightView& view = scene.lights.images[which];
    const bool second = view.lookup.second_uvs != 0;
    const SurfaceUv uv = second ? MakeSurfaceUv(scene, prim, b1, b2, point, second) : first;
    const Rgb texel = SurfaceTexel(view, uv.u, uv.v);
    factor = IfThenElse(ToFloatMask(same), texel, factor);
    todo = hn::AndNot(same, todo);
  }
  return factor;
}

void ShadeEmission(const SceneView& scene, const RaysIn& rays, const HitsIn& hits, size_t count,
                   const RgbFields<Out>& radiance) {
  const F32 zero = hn::Zero(D());
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(count - i));
    const U32 prim = Load(hits.prim, i);
    const MaskU hit = hn::And(active, hn::Ne(prim, SetU(kNoPrim)));
    if (hn::AllFalse(DU(), hit)) continue;
    const ShapeLanes any_shape(scene, hn::IfThenElseZero(hit, prim));
    const U32 first_light = any_shape.Word(offsetof(ShapeRecord, first_light));
    const MaskU emits = hn::And(hit, hn::Ne(first_light, SetU(kNone)));
    if (hn::AllFalse(DU(), emits)) continue;

    const Vec3 org = Load(rays.org, i);
    const Vec3 dir = Load(rays.dir, i);
    const F32 t = Load(hits.t, i);
    const U32 state = Load(rays.state, i);
    const U32 path = Load(rays.path, i);
    // Lanes that do not emit look at the primitive of the first that does.
    const size_t leader = static_cast<size_t>(hn::FindKnownFirstTrue(DU(), emits));
    const U32 safe_prim = hn::IfThenElse(emits, prim, SetU(hits.prim[i + leader]));

    const ShapeLanes shape(scene, safe_prim);
    const Surface surface =
        MakeSurface(scene, org, dir, t, safe_prim, Load(hits.u, i), Load(hits.v, i));
    const U32 index = hn::Add(shape.Word(offsetof(ShapeRecord, first_light)),
                              hn::Sub(safe_prim, shape.Word(offsetof(ShapeRecord, first_prim))));
    const LightLanes light(scene.lights, index);
    const F32 cos = hn::Neg(Dot(surface.n, dir));
    const Mask shines = hn::And(ToFloatMask(emits), hn::Or(hn::Gt(cos, zero), light.two_sided()));
    const F32 pdf = LightPdf(scene.lights, index, org, hn::ShiftRight<kNormalCodeShift>(state), t,
                             cos, surface.area_scale);
    const Mask specular = ToFloatMask(hn::TestBit(state, SetU(kSpecularRay)));
    const F32 weight =
        hn::IfThenElse(specular, Set(1.0f), PowerHeuristic(Load(rays.bsdf_pdf, i), pdf));
    Rgb emitted = light.radiance();
    if (scene.lights.any_pictured) {
      emitted = Mul(emitted, EmissionImages(scene, light, emits, safe_prim, Load(hits.u, i),
                                            Load(hits.v, i), surface.p));
    }
    const Rgb gained = Scale(weight, Mul(Load(rays.throughput, i), emitted));

    AddToPaths(shines, gained, radiance, path);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(ShadeEmission);
void ShadeEmission(const SceneView& scene, const RaysIn& rays, const HitsIn& hits, size_t count,
                   const RgbFields<Out>& radiance) {
  HWY_DYNAMIC_DISPATCH(ShadeEmission)(scene, rays, hits, count, radiance);
}
}  // namespace swell::SWELL_WIDTH
#endif
