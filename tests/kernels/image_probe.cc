// Columns of coordinates and directions -> columns of what images and skies are there.
#include "tests/kernels/image_probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/kernels/image_probe.cc"
#include <hwy/foreach_target.h>

#include "kernels/environment-inl.h"
#include "tests/kernels/probe_row-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void ProbeSphereMaps(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const Vec2 square = SphereToEqualArea(row.Vector(0));
    const Vec2 rectangle = SphereToLatLong(row.Vector(0));
    row.Put(0, square.x);
    row.Put(1, square.y);
    row.Put(2, EqualAreaToSphere(square.x, square.y));
    row.Put(5, rectangle.x);
    row.Put(6, rectangle.y);
  }
}

void ProbeTexel(const ProbeArgs& args) {
  const ImageView& image = args.scene->lights.images[0].image;
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    row.Put(0, FetchTexel(image, image.levels[args.seed], row.Index(0), row.Index(1)));
  }
}

void ProbeSky(const ProbeArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const ProbeRow row{args, i};
    const SkyLanes sky = EvaluateSky(args.scene->lights.images[0], row.Vector(0));
    row.Put(0, sky.radiance);
    row.Put(3, sky.pdf);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#define SWELL_DISPATCH_PROBE(Name) \
  HWY_EXPORT(Name);                \
  void Name(const ProbeArgs& args) { HWY_DYNAMIC_DISPATCH(Name)(args); }
namespace swell::SWELL_WIDTH {
SWELL_DISPATCH_PROBE(ProbeSphereMaps)
SWELL_DISPATCH_PROBE(ProbeTexel)
SWELL_DISPATCH_PROBE(ProbeSky)
}  // namespace swell::SWELL_WIDTH
#endif
