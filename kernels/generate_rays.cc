// Pixels and a sample index -> camera rays and fresh paths.
#include "kernels/generate_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/generate_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/rng-inl.h"
#include "kernels/sampling-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct FilterSample {
  F32 offset;  // pixels from the centre
  F32 weight;
};

// Inverts the filter's distribution: bins of equal probability, linear inside.
HWY_INLINE FilterSample SampleFilter(const float* quantiles, const float* weights, F32 u) {
  const F32 at = hn::Mul(u, Set(static_cast<float>(kFilterBins)));
  const I32 bin = hn::ConvertTo(DI(), at);
  const F32 fraction = hn::Sub(at, hn::ConvertTo(D(), bin));
  const U32 index = hn::BitCast(DU(), bin);

  const F32 low = Gather(quantiles, index);
  const F32 high = Gather(quantiles + 1, index);
  return {hn::MulAdd(fraction, hn::Sub(high, low), low), Gather(weights, index)};
}

HWY_INLINE Vec3 TransformVector(const float* m, const Vec3& v) {
  const auto row = [&](int r) HWY_ATTR {
    return hn::MulAdd(Set(m[r]), v.x, hn::MulAdd(Set(m[r + 1]), v.y, hn::Mul(Set(m[r + 2]), v.z)));
  };
  return {row(0), row(4), row(8)};
}

// Stores lanes of `mask` alone: the rows after the last may be live rays of the next window.
HWY_INLINE void StoreLanes(Mask mask, F32 v, float* column, size_t row) {
  hn::BlendedStore(v, mask, D(), column + row);
}
HWY_INLINE void StoreLanes(Mask mask, U32 v, uint32_t* column, size_t row) {
  hn::BlendedStore(v, ToUintMask(mask), DU(), column + row);
}
HWY_INLINE void StoreLanes(Mask mask, const Vec3& v, const Vec3Fields<Out>& c, size_t row) {
  StoreLanes(mask, v.x, c.x, row);
  StoreLanes(mask, v.y, c.y, row);
  StoreLanes(mask, v.z, c.z, row);
}

void GenerateRays(const GenerateRaysArgs& args, const RaysOut& rays, const PathsOut& paths) {
  const CameraView& camera = args.camera;
  const float* raster = camera.raster_to_screen;
  const bool perspective = camera.type == CameraType::kPerspective;
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const Mask active = FirstLanes(args.count - i);
    const U32 pixel = hn::IfThenElseZero(ToUintMask(active), Load(args.pixels, i));
    const U32 slot = hn::IfThenElseZero(ToUintMask(active), Load(args.slots, i));

    const Sampler sampler(pixel, SetU(args.sample), args.seed, args.sampler);
    const Vec2 u = sampler.Pair(SetU(kPairFilm));
    const FilterSample fx = SampleFilter(args.filter.quantiles_x, args.filter.weight_x, u.x);
    const FilterSample fy = SampleFilter(args.filter.quantiles_y, args.filter.weight_y, u.y);
    const F32 half = Set(0.5f);
    const F32 x = hn::Add(hn::ConvertTo(D(), hn::BitCast(DI(), hn::And(pixel, SetU(0xFFFFu)))),
                          hn::Add(fx.offset, half));
    const F32 y = hn::Add(hn::ConvertTo(D(), hn::BitCast(DI(), hn::ShiftRight<16>(pixel))),
                          hn::Add(fy.offset, half));
    const F32 zero = hn::Zero(D());
    const F32 one = Set(1.0f);
    const Vec3 screen{hn::MulAdd(x, Set(raster[0]), Set(raster[1])),
                      hn::MulAdd(y, Set(raster[2]), Set(raster[3])), one};
    Vec3 org = perspective ? Vec3{zero, zero, zero} : Vec3{screen.x, screen.y, zero};
    Vec3 dir = perspective ? screen : Vec3{zero, zero, one};
    if (camera.lens_radius > 0.0f) {  // the plane in focus is z = focal_distance
      const Vec3 focus = MulAdd(Set(camera.focal_distance), dir, org);
      const Vec2 u_lens = sampler.Pair(SetU(kPairLens));
      const DiskPoint lens = ConcentricDisk(u_lens.x, u_lens.y);
      org.x = hn::MulAdd(Set(camera.lens_radius), lens.x, org.x);
      org.y = hn::MulAdd(Set(camera.lens_radius), lens.y, org.y);
      dir = Sub(focus, org);
    }
    const float* m = camera.camera_to_world;
    const Vec3 offset{Set(m[3]), Set(m[7]), Set(m[11])};
    const F32 weight = hn::Mul(fx.weight, fy.weight);

    StoreLanes(active, Add(TransformVector(m, org), offset), rays.org, i);
    StoreLanes(active, Normalize(TransformVector(m, dir)), rays.dir, i);
    StoreLanes(active, slot, rays.path, i);
    StoreLanes(active, weight, rays.throughput.r, i);
    StoreLanes(active, weight, rays.throughput.g, i);
    StoreLanes(active, weight, rays.throughput.b, i);
    StoreLanes(active, one, rays.bsdf_pdf, i);
    StoreLanes(active, one, rays.eta_scale, i);
    StoreLanes(active, SetU(kSpecularRay), rays.state, i);
    Scatter(active, pixel, paths.pixel, slot);
    Scatter(active, SetU(args.sample), paths.sample, slot);
    Scatter(active, zero, paths.radiance.r, slot);
    Scatter(active, zero, paths.radiance.g, slot);
    Scatter(active, zero, paths.radiance.b, slot);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(GenerateRays);
void GenerateRays(const GenerateRaysArgs& args, const RaysOut& rays, const PathsOut& paths) {
  HWY_DYNAMIC_DISPATCH(GenerateRays)(args, rays, paths);
}
}  // namespace swell::SWELL_WIDTH
#endif
