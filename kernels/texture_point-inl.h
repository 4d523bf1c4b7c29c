// Hits -> the points that textures are evaluated at, with the width of the pixel there.
#if defined(SWELL_KERNELS_TEXTURE_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TEXTURE_POINT_INL_H_
#undef SWELL_KERNELS_TEXTURE_POINT_INL_H_
#else
#define SWELL_KERNELS_TEXTURE_POINT_INL_H_
#endif

#include "kernels/surface_uv-inl.h"
#include "kernels/textures-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

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

HWY_INLINE TexturePoint MakeTexturePoint(const PixelFootprint& pixel, const Surface& surface,
                                         const SurfaceUv& uv) {
  return {surface.p, surface.ns, uv.u, uv.v, FootprintWidth(pixel, surface.p, surface.n),
          uv.du,     uv.dv};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TEXTURE_POINT_INL_H_
