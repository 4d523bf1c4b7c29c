// What a scene file asks of the render, with pbrt-v4's names and defaults.
#include "src/import/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "src/base/suggest.h"
#include "src/import/pbrt_v3.h"

namespace swell {
namespace {

using Names = std::vector<std::string_view>;

constexpr int32_t kIntMax = std::numeric_limits<int32_t>::max();

bool Contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void FailUnknown(Parameters& parameters, std::string_view what, const std::string& type,
                 const Names& names) {
  parameters.Fail(parameters.place(), "unknown " + std::string(what) + " " + Quote(type) +
                                          KnownWords(type, names) + UpgradeHint(type));
}

// Four numbers as min max min max.
bool ReadWindow(Parameters& parameters, std::string_view name, std::array<float, 4>* window) {
  const Parameter* parameter = parameters.Floats(name, {"float"}, 1, 4);
  if (parameter == nullptr) return false;
  std::copy(parameter->floats.begin(), parameter->floats.end(), window->begin());
  return true;
}

void ReadFieldOfView(Parameters& parameters, Camera* camera) {
  camera->fov_degrees = parameters.Float("fov", camera->fov_degrees);
  if (!parameters.failed() && !(camera->fov_degrees > 0.0f && camera->fov_degrees < 180.0f)) {
    parameters.Fail(parameters.Any("fov")->place,
                    "'fov' must lie between 0 and 180 degrees, without these");
  }
}

// A perspective view from the same place, where there is no camera of the type.
void ReplaceCamera(Parameters& parameters, const std::string& type, Camera* camera) {
  constexpr float kSphericalFov = 90.0f, kRealisticFov = 40.0f;  // degrees
  camera->fov_degrees = type == "spherical" ? kSphericalFov : kRealisticFov;
  camera->focal_distance = parameters.PositiveFloat("focusdistance", camera->focal_distance);
  parameters.Warn(parameters.place(), "camera " + Quote(type) +
                                          " is not supported; a perspective camera of " +
                                          std::to_string(static_cast<int>(camera->fov_degrees)) +
                                          " degrees replaces it");
  parameters.Accept({"mapping", "lensfile", "aperturediameter", "aperture"});
}

}  // namespace

void ReadCamera(Parameters& parameters, const std::string& type, const Transform& world_to_camera,
                Camera* camera, float* shutter) {
  const Names known = {"perspective", "orthographic", "spherical", "realistic"};
  if (!Contains(known, type)) return FailUnknown(parameters, "camera", type, known);
  *camera = Camera{};
  if (type == "orthographic") {
    camera->type = CameraType::kOrthographic;
  } else if (type == "perspective") {
    ReadFieldOfView(parameters, camera);
  } else {
    ReplaceCamera(parameters, type, camera);
  }
  camera->lens_radius = parameters.FloatWithin("lensradius", 0.0f, 0.0f, 1e30f);
  camera->focal_distance = parameters.PositiveFloat("focaldistance", camera->focal_distance);
  if (parameters.Any("frameaspectratio") != nullptr) {
    camera->frame_aspect_ratio = parameters.PositiveFloat("frameaspectratio", 1.0f);
  }
  if (ReadWindow(parameters, "screenwindow", &camera->screen_window)) {
    const std::array<float, 4>& w = camera->screen_window;
    if (w[0] == w[1] || w[2] == w[3]) {
      return parameters.Fail(parameters.Any("screenwindow")->place,
                             "'screenwindow' has no area; give x0 x1 y0 y1");
    }
  }
  const float open = parameters.Float("shutteropen", 0.0f);
  const float close = parameters.Float("shutterclose", 1.0f);
  *shutter = std::abs(close - open);
  if (!parameters.failed() && *shutter == 0.0f) {
    return parameters.Fail(parameters.place(), "the shutter opens and closes at the same time");
  }
  const auto camera_to_world = Inverse(world_to_camera);
  if (!camera_to_world) {
    return parameters.Fail(parameters.place(), "the transform is singular; use non-zero scales");
  }
  camera->camera_to_world = ToAffine(*camera_to_world);
  parameters.ReportUnknown();
}

void ReadFilm(Parameters& parameters, const std::string& type, RenderRequest* request) {
  if (type == "gbuffer" || type == "spectral") {
    parameters.Warn(parameters.place(), "film " + Quote(type) + " is rendered as 'rgb'");
    parameters.Accept({"coordinatesystem", "nbuckets", "lambdamin", "lambdamax"});
  } else if (type != "rgb") {
    return FailUnknown(parameters, "film", type, {"rgb"});
  }
  const auto width = parameters.IntWithin("xresolution", 1280, 1, kMaxResolution);
  const auto height = parameters.IntWithin("yresolution", 720, 1, kMaxResolution);
  if (parameters.failed()) return;
  request->width = static_cast<uint32_t>(width);
  request->height = static_cast<uint32_t>(height);
  request->filename = parameters.String("filename", "");

  const Parameter* bounds = parameters.Ints("pixelbounds");
  if (bounds != nullptr && bounds->integers.size() != 4) {
    return parameters.Fail(bounds->place, "'pixelbounds' needs 4 values: x0 x1 y0 y1");
  }
  if (bounds != nullptr) {
    // pbrt's crop window begins and ends at the next whole pixel; half a pixel back is exact.
    const float size[4] = {static_cast<float>(width), static_cast<float>(width),
                           static_cast<float>(height), static_cast<float>(height)};
    for (size_t i = 0; i < 4; ++i) {
      const float edge = (static_cast<float>(bounds->integers[i]) - 0.5f) / size[i];
      request->crop_window[i] = std::clamp(edge, 0.0f, 1.0f);
    }
  }
  std::array<float, 4> crop{};
  if (ReadWindow(parameters, "cropwindow", &crop)) {
    for (float& edge : crop) edge = std::clamp(edge, 0.0f, 1.0f);
    request->crop_window = {std::min(crop[0], crop[1]), std::max(crop[0], crop[1]),
                            std::min(crop[2], crop[3]), std::max(crop[2], crop[3])};
  }
  const std::array<float, 4>& c = request->crop_window;
  const auto empty = [](float a, float b, int32_t n) {
    return std::ceil(a * static_cast<float>(n)) >= std::ceil(b * static_cast<float>(n));
  };
  if (!parameters.failed() && (empty(c[0], c[1], width) || empty(c[2], c[3], height))) {
    return parameters.Fail(parameters.place(), "the crop window holds no pixel; give x0 x1 y0 y1");
  }
  request->max_component = parameters.FloatWithin("maxcomponentvalue", 0.0f, 0.0f, 3e38f);
  const float iso = parameters.PositiveFloat("iso", 100.0f);
  request->image_scale = iso / 100.0f * parameters.PositiveFloat("exposuretime", 1.0f);
  if (parameters.String("sensor", "cie1931") != "cie1931") {
    parameters.Warn(parameters.Any("sensor")->place,
                    "sensors are not supported; the film is "
                    "'cie1931'");
  }
  parameters.Ignore({"whitebalance"});
  parameters.Accept({"savefp16", "diagonal"});
  parameters.ReportUnknown();
}

void ReadSampler(Parameters& parameters, const std::string& type, RenderRequest* request) {
  // pbrt-v4's that swell has not, and what comes next to them.
  const std::pair<std::string_view, SamplerKind> others[] = {{"paddedsobol", SamplerKind::kSobol},
                                                             {"pmj02bn", SamplerKind::kSobol}};
  Names known;
  bool found = false;
  for (uint32_t kind = 0; kind < std::size(kSamplers); ++kind) {
    known.push_back(kSamplers[kind].name);
    if (type != kSamplers[kind].name) continue;
    found = true;
    request->sampler = static_cast<SamplerKind>(kind);
  }
  for (const auto& [name, kind] : others) {
    known.push_back(name);
    if (type != name) continue;
    found = true;
    request->sampler = kind;
    const char* used = kSamplers[static_cast<size_t>(kind)].name;
    parameters.Warn(parameters.place(), "swell samples with " + Quote(used) + " instead");
  }
  if (!found) return FailUnknown(parameters, "sampler", type, known);
  if (type == "stratified") {
    constexpr int32_t kMaxSide = 65535;
    const int32_t x = parameters.IntWithin("xsamples", 4, 1, kMaxSide);
    const int32_t y = parameters.IntWithin("ysamples", 4, 1, kMaxSide);
    request->samples_per_pixel = static_cast<uint32_t>(x) * static_cast<uint32_t>(y);
    if (!parameters.Bool("jitter", true)) {
      parameters.Warn(parameters.Any("jitter")->place, "swell's strata are jittered");
    }
  } else {
    request->samples_per_pixel =
        static_cast<uint32_t>(parameters.IntWithin("pixelsamples", 16, 1, kIntMax));
    parameters.Accept({"randomization"});
  }
  if (parameters.Any("seed") != nullptr) {
    request->seed = static_cast<uint32_t>(parameters.Int("seed", 0));
  }
  parameters.ReportUnknown();
}

void ReadPixelFilter(Parameters& parameters, const std::string& type, Filter* filter) {
  // Radius and the two further parameters of each filter, as in pbrt-v4.
  struct Defaults {
    std::string_view name;
    FilterType type;
    float radius, a, b;
  };
  constexpr Defaults kFilters[] = {{"box", FilterType::kBox, 0.5f, 0.0f, 0.0f},
                                   {"triangle", FilterType::kTriangle, 2.0f, 0.0f, 0.0f},
                                   {"gaussian", FilterType::kGaussian, 1.5f, 0.5f, 0.0f},
                                   {"mitchell", FilterType::kMitchell, 2.0f, 1 / 3.0f, 1 / 3.0f},
                                   {"sinc", FilterType::kSinc, 4.0f, 3.0f, 0.0f}};
  constexpr float kMaxRadius = 64.0f;  // pixels
  const auto* found = std::find_if(std::begin(kFilters), std::end(kFilters),
                                   [&](const Defaults& f) { return f.name == type; });
  if (found == std::end(kFilters)) {
    Names names;
    for (const Defaults& f : kFilters) names.push_back(f.name);
    return FailUnknown(parameters, "filter", type, names);
  }
  *filter = {found->type, found->radius, found->radius, found->a, found->b};
  filter->radius_x = parameters.PositiveFloat("xradius", filter->radius_x);
  filter->radius_y = parameters.PositiveFloat("yradius", filter->radius_y);
  if (!parameters.failed() && std::max(filter->radius_x, filter->radius_y) > kMaxRadius) {
    return parameters.Fail(parameters.place(), "the filter's radius is above 64 pixels");
  }
  if (filter->type == FilterType::kGaussian) {
    filter->a = parameters.PositiveFloat("sigma", filter->a);
  } else if (filter->type == FilterType::kSinc) {
    filter->a = parameters.PositiveFloat("tau", filter->a);
  } else if (filter->type == FilterType::kMitchell) {
    filter->a = parameters.Float("B", filter->a);
    filter->b = parameters.Float("C", filter->b);
  }
  parameters.ReportUnknown();
}

namespace {

// pbrt-v4's names; a scene that asks for what there is not is lit all the same.
void ReadLightSampler(Parameters& parameters, RenderRequest* request) {
  const std::string name = parameters.String("lightsampler", "");
  if (parameters.failed() || name.empty()) return;
  const Names known(std::begin(kLightSamplerNames), std::end(kLightSamplerNames));
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) {
    request->light_sampler = static_cast<LightSampler>(found - known.begin());
    return;
  }
  request->light_sampler = LightSampler::kAuto;
  const std::string problem =
      name == "exhaustive" ? "light sampler 'exhaustive' is not supported"
                           : "unknown light sampler " + Quote(name) + DidYouMean(name, known);
  parameters.Warn(parameters.Any("lightsampler")->place, problem + "; 'auto' is used");
}

}  // namespace

void ReadIntegrator(Parameters& parameters, const std::string& type, RenderRequest* request) {
  const Names known = {"path", "volpath", "simplepath",       "simplevolpath", "lightpath", "bdpt",
                       "mlt",  "sppm",    "ambientocclusion", "function",      "randomwalk"};
  const Names same_picture = {"path", "volpath", "simplepath", "simplevolpath", "lightpath",
                              "bdpt", "mlt",     "sppm",       "randomwalk"};
  if (!Contains(known, type)) return FailUnknown(parameters, "integrator", type, known);
  if (!Contains(same_picture, type)) {
    return parameters.Fail(parameters.place(),
                           "integrator " + Quote(type) + " is not supported; use 'path'");
  }
  if (type == "volpath" || type == "simplevolpath") {
    parameters.Warn(parameters.place(), "rendered as 'path': media absorb, but do not scatter");
  } else if (type != "path" && type != "simplepath") {
    parameters.Warn(parameters.place(), "rendered as 'path', which converges to the same picture");
  }
  request->max_depth = static_cast<uint32_t>(parameters.IntWithin("maxdepth", 5, 0, 65535));
  if (parameters.Bool("regularize", false)) parameters.Ignore({"regularize"});
  ReadLightSampler(parameters, request);
  parameters.Accept({"samplelights", "samplebsdf", "bootstrapsamples", "chains",
                     "mutationsperpixel", "largestepprobability", "sigma", "photonsperiteration",
                     "radius", "seed", "visualizestrategies", "visualizeweights"});
  parameters.ReportUnknown();
}

}  // namespace swell
