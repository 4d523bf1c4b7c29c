// Camera and pixel filter of a scene file -> the views that generate_rays reads.
#include "src/scene/views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swell {
namespace {

// The filter along one axis at `x` pixels from the centre; `radius` is half its width.
double EvaluateFilter(const Filter& filter, double radius, double x) {
  const double distance = std::abs(x);
  if (distance > radius) return 0.0;
  switch (filter.type) {
    case FilterType::kBox:
      return 1.0;
    case FilterType::kTriangle:
      return radius - distance;
    case FilterType::kGaussian: {
      const double scale = -0.5 / (double{filter.a} * filter.a);
      return std::max(0.0, std::exp(scale * x * x) - std::exp(scale * radius * radius));
    }
    case FilterType::kMitchell: {  // Mitchell and Netravali 1988, over [-2, 2]
      const double b = filter.a, c = filter.b, t = 2.0 * distance / radius;
      if (t > 1.0) {
        return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t +
                (8 * b + 24 * c)) /
               6.0;
      }
      return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) /
             6.0;
    }
    case FilterType::kSinc: {  // Lanczos: sinc(x) sinc(x / tau)
      const auto sinc = [](double v) {
        const double a = std::numbers::pi * v;
        return std::abs(a) < 1e-8 ? 1.0 : std::sin(a) / a;
      };
      return sinc(x) * sinc(x / filter.a);
    }
  }
  return 0.0;
}

// Offsets at equal steps of the probability |f| / integral(|f|), and f over that density in each
// step.
void MakeAxis(const Filter& filter, float radius, std::vector<float>& quantiles,
              std::vector<float>& weights) {
  constexpr int kSteps = 1 << 16;
  const double step = 2.0 * radius / kSteps;
  std::vector<double> absolute(kSteps + 1), plain(kSteps + 1);
  for (int i = 0; i < kSteps; ++i) {
    const double f = EvaluateFilter(filter, radius, -radius + (i + 0.5) * step);
    absolute[i + 1] = absolute[i] + std::abs(f);
    plain[i + 1] = plain[i] + f;
  }
  const double total = absolute[kSteps];
  const double sum = plain[kSteps];
  quantiles.resize(kFilterBins + 1);
  weights.resize(kFilterBins);
  const auto at = [](const std::vector<double>& cumulative, double position) {
    const int i = std::min(static_cast<int>(position), kSteps - 1);
    return cumulative[i] + (position - i) * (cumulative[i + 1] - cumulative[i]);
  };
  double previous = 0.0;
  int i = 0;
  for (uint32_t bin = 0; bin <= kFilterBins; ++bin) {
    const double target = total * bin / kFilterBins;
    while (i < kSteps && absolute[i + 1] < target) ++i;
    const double rise = i < kSteps ? absolute[i + 1] - absolute[i] : 0.0;
    const double position = bin == 0 ? 0.0
                            : bin == kFilterBins
                                ? kSteps
                                : i + (rise > 0.0 ? (target - absolute[i]) / rise : 0.0);
    quantiles[bin] = static_cast<float>(-radius + position * step);
    if (bin > 0) {
      const double share = total / kFilterBins;
      weights[bin - 1] =
          static_cast<float>((at(plain, position) - at(plain, previous)) / share * (total / sum));
    }
    previous = position;
  }
}

}  // namespace

CameraView MakeCameraView(const Camera& camera, uint32_t width, uint32_t height) {
  const float aspect = camera.frame_aspect_ratio > 0.0f
                           ? camera.frame_aspect_ratio
                           : static_cast<float>(width) / static_cast<float>(height);
  std::array<float, 4> window = camera.screen_window;
  if (window == std::array<float, 4>{}) {  // the shorter side spans [-1, 1]
    window = aspect > 1.0f ? std::array<float, 4>{-aspect, aspect, -1.0f, 1.0f}
                           : std::array<float, 4>{-1.0f, 1.0f, -1.0f / aspect, 1.0f / aspect};
  }
  const double to_plane = camera.type == CameraType::kPerspective
                              ? std::tan(camera.fov_degrees * std::numbers::pi / 360.0)
                              : 1.0;
  CameraView view{};
  view.type = camera.type;
  view.raster_to_screen[0] = static_cast<float>((window[1] - window[0]) * to_plane / width);
  view.raster_to_screen[1] = static_cast<float>(window[0] * to_plane);
  view.raster_to_screen[2] = static_cast<float>((window[2] - window[3]) * to_plane / height);
  view.raster_to_screen[3] = static_cast<float>(window[3] * to_plane);
  std::copy(camera.camera_to_world.begin(), camera.camera_to_world.end(), view.camera_to_world);
  view.lens_radius = camera.lens_radius;
  view.focal_distance = camera.focal_distance;
  return view;
}

PixelFootprint MakePixelFootprint(const CameraView& camera) {
  constexpr float kShare = 0.125f;
  const float* m = camera.camera_to_world;
  const double stretch = std::hypot(m[0], m[4], m[8]);
  PixelFootprint pixel{};
  for (int i = 0; i < 3; ++i) pixel.camera[i] = m[4 * i + 3];
  pixel.parallel = camera.type == CameraType::kOrthographic;
  pixel.spread = kShare * std::abs(camera.raster_to_screen[0]);
  if (pixel.parallel) pixel.spread *= static_cast<float>(stretch);
  return pixel;
}

FilterTables MakeFilterTables(const Filter& filter) {
  FilterTables tables;
  MakeAxis(filter, filter.radius_x, tables.quantiles_x, tables.weight_x);
  MakeAxis(filter, filter.radius_y, tables.quantiles_y, tables.weight_y);
  return tables;
}

}  // namespace swell
