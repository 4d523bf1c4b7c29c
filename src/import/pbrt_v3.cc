// What pbrt-v3 has and pbrt-v4 has not.
#include "src/import/pbrt_v3.h"

#include <algorithm>
#include <iterator>

namespace swell {
namespace {

// clang-format off
constexpr std::string_view kNames[] = {
    // materials
    "disney", "fourier", "glass", "kdsubsurface", "matte", "metal", "plastic", "substrate",
    "translucent", "uber",
    // film, integrators, samplers, shapes, kinds of textures
    "image", "directlighting", "whitted", "02sequence", "lowdiscrepancy", "maxmindist", "random",
    "cone", "heightfield", "hyperboloid", "nurbs", "paraboloid", "color",
    // directives of pbrt-v2 and before
    "Renderer", "SurfaceIntegrator", "VolumeIntegrator", "Volume"};
// clang-format on

}  // namespace

std::string UpgradeHint(std::string_view name) {
  if (std::find(std::begin(kNames), std::end(kNames), name) == std::end(kNames)) return "";
  return "; it is pbrt-v3's: convert the file with `pbrt --upgrade OLD.pbrt > NEW.pbrt`";
}

}  // namespace swell
