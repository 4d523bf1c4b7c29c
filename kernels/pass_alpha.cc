// Rays and hits -> the rays that the opacity of what they hit lets through.
#include "kernels/pass_alpha.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/pass_alpha.cc"
#include <hwy/foreach_target.h>

#include "kernels/texture_point-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A number in [0, 1) of a ray.
HWY_INLINE F32 HashRay(const Vec3& org, const Vec3& dir) {
  const U32 place = HashSeed(org.x, org.y, org.z);
  return HashUniform(hn::Xor(place, HashBits(HashSeed(dir.x, dir.y, dir.z))), SetU(1));
}

size_t PassAlpha(const PassAlphaArgs& args) {
  const SceneView& scene = *args.scene;
  size_t passed = 0;
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const U32 prim = Load(args.hits.prim, i);
    const F32 t = Load(args.hits.t, i);
    MaskU hit = hn::And(active, hn::Ne(prim, SetU(kNoPrim)));
    if (args.t_max != nullptr) hit = hn::And(hit, ToUintMask(hn::Lt(t, Load(args.t_max, i))));
    if (hn::AllFalse(DU(), hit)) continue;
    const U32 shape = Gather(scene.prim_shape, hn::IfThenElseZero(hit, prim));
    const U32 program = Gather(scene.textures.shape_alpha, shape);
    const MaskU holed = hn::And(hit, hn::Ne(program, SetU(kNoTexture)));
    if (hn::AllFalse(DU(), holed)) continue;

    const Vec3 org = Load(args.org, i), dir = Load(args.dir, i);
    const size_t leader = static_cast<size_t>(hn::FindKnownFirstTrue(DU(), holed));
    const U32 safe_prim = hn::IfThenElse(holed, prim, SetU(args.hits.prim[i + leader]));
    const F32 b1 = Load(args.hits.u, i), b2 = Load(args.hits.v, i);
    const U32 none = SetU(kNone);
    const U32 instance =
        scene.instance_count == 0 ? none : hn::IfThenElse(holed, Load(args.hits.instance, i), none);
    const Surface surface = HitSurface(scene, org, dir, t, instance, safe_prim, b1, b2);
    const SurfaceUv uv = HitUv(scene, surface.p, instance, safe_prim, b1, b2);
    const TexturePoint at =
        MakeTexturePoint(scene, args.pixel, surface, uv, instance, safe_prim, b1, b2);
    const F32 alpha = TextureNumber(scene.textures, program, holed, at, Set(1.0f));
    const Mask passes = hn::And(ToFloatMask(holed), hn::Ge(HashRay(org, dir), alpha));
    const Vec3 origin = OffsetOrigin(surface.p, surface.error, surface.n, dir);
    const F32 moved = hn::Div(Dot(Sub(origin, org), dir), Dot(dir, dir));

    const U32 row = CountFrom(static_cast<uint32_t>(i));
    hn::CompressStore(origin.x, passes, D(), args.origin.x + passed);
    hn::CompressStore(origin.y, passes, D(), args.origin.y + passed);
    hn::CompressStore(origin.z, passes, D(), args.origin.z + passed);
    hn::CompressStore(moved, passes, D(), args.moved + passed);
    passed += hn::CompressStore(row, ToUintMask(passes), DU(), args.through + passed);
  }
  return passed;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(PassAlpha);
size_t PassAlpha(const PassAlphaArgs& args) { return HWY_DYNAMIC_DISPATCH(PassAlpha)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
