// Lanes that chose a light with an image -> its direction, radiance and density.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/image_lights.cc"
#include <hwy/foreach_target.h>

#include "kernels/environment-inl.h"
#include "kernels/filter-inl.h"
#include "kernels/image_lights-inl.h"
#include "kernels/texture_point-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE void Keep(Mask lanes, F32 v, float* to) {
  hn::Store(hn::IfThenElse(lanes, v, hn::Load(D(), to)), D(), to);
}

// The part of rays from points of `lanes` that does not pass through their surfaces' holes, see
// PassAlpha. Textures are not filtered: the light is seen from anywhere.
F32 Opacity(const SceneView& scene, MaskU lanes, U32 prim, const Vec2& weights, const Vec3& point,
            const SurfaceUv& uv) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f);
  if (scene.textures.shape_alpha == nullptr) return one;
  const U32 shape = Gather(scene.prim_shape, prim);
  const U32 program = Gather(scene.textures.shape_alpha, shape);
  const MaskU holed = hn::And(lanes, hn::Ne(program, SetU(kNoTexture)));
  if (hn::AllFalse(DU(), holed)) return one;
  const Vec3 n = Normalize(Cross(uv.dpdu, uv.dpdv));
  TexturePoint at = {point,           n,   uv.u, uv.v, zero,  uv.du, uv.dv,
                     {one, one, one}, one, uv.u, uv.v, uv.du, uv.dv};
  if (scene.color_count != 0) AddVertexColor(scene, prim, weights.x, weights.y, at);
  if (scene.second_uv_offsets != nullptr) {
    AddSecondUv(scene, point, SetU(kNone), prim, weights.x, weights.y, at);
  }
  const F32 alpha = TextureNumber(scene.textures, program, holed, at, one);
  return hn::Min(hn::Max(alpha, zero), one);
}

// The image at points of the surfaces that emit it.
Rgb SurfaceImage(const SceneView& scene, const ImageLightView& light, Mask lanes,
                 const ImageLightLanes& q) {
  const MaskU used = ToUintMask(lanes);
  const uint32_t some = q.prim[hn::FindKnownFirstTrue(DU(), used)];
  const U32 prim = hn::IfThenElse(used, hn::Load(DU(), q.prim), SetU(some));
  const Vec3 point = LoadLanes(q.point);
  const Vec2 weights = WeightsAt(scene, prim, point);
  const SurfaceUv uv = MakeSurfaceUv(scene, prim, weights.x, weights.y, point);
  const MaskU holed = hn::And(used, hn::Eq(hn::Load(DU(), q.whole), SetU(0)));
  const F32 opacity = Opacity(scene, holed, prim, weights, point, uv);
  if (light.lookup.second_uvs == 0) return Scale(opacity, SurfaceTexel(light, uv.u, uv.v));
  const SurfaceUv second = MakeSurfaceUv(scene, prim, weights.x, weights.y, point, true);
  return Scale(opacity, SurfaceTexel(light, second.u, second.v));
}

void SampleOneLight(const SceneView& scene, const ImageLightView& light, Mask lanes,
                    ImageLightLanes& q) {
  Rgb factor;
  if (light.mapping == ImageMapping::kSurface) {
    factor = SurfaceImage(scene, light, lanes, q);
  } else if (light.rows != 0) {
    const SkySample sky = SampleSky(light, hn::Load(D(), q.u0), hn::Load(D(), q.u1));
    factor = sky.radiance;
    Keep(lanes, sky.wi.x, q.wi[0]);
    Keep(lanes, sky.wi.y, q.wi[1]);
    Keep(lanes, sky.wi.z, q.wi[2]);
    Keep(lanes, sky.pdf, q.pdf);
  } else {
    factor = EvaluateBeam(light, Neg(LoadLanes(q.wi)));
  }
  Keep(lanes, hn::Mul(factor.r, hn::Load(D(), q.radiance[0])), q.radiance[0]);
  Keep(lanes, hn::Mul(factor.g, hn::Load(D(), q.radiance[1])), q.radiance[1]);
  Keep(lanes, hn::Mul(factor.b, hn::Load(D(), q.radiance[2])), q.radiance[2]);
}

// Light by light: their images and tables are then the same for all lanes at work.
void SampleImageLights(const SceneView& scene, ImageLightLanes& q) {
  const U32 image = hn::Load(DU(), q.image);
  MaskU todo = hn::Ne(image, SetU(kNone));
  while (!hn::AllFalse(DU(), todo)) {
    const uint32_t which = q.image[hn::FindKnownFirstTrue(DU(), todo)];
    const MaskU same = hn::And(todo, hn::Eq(image, SetU(which)));
    SampleOneLight(scene, scene.lights.images[which], ToFloatMask(same), q);
    todo = hn::AndNot(same, todo);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
