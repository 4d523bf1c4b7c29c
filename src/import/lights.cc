// Lights with pbrt-v4's units: a colour, its "scale", and a target (power, illuminance) that scales
// a light of luminance 1.
#include "src/import/lights.h"

#include <cmath>

#include "src/import/spectrum.h"
#include "src/base/suggest.h"

namespace swell {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kMaxScale = 1e30f;

LightRecord MakeLight(LightType type, const Rgb3& color, float scale) {
  LightRecord light{};
  light.type = type;
  for (size_t c = 0; c < 3; ++c) light.radiance[c] = color[c] * scale;
  light.prim = kNone;
  light.sphere = kNone;
  return light;
}

float ReadScale(Parameters& parameters) {
  return parameters.FloatWithin("scale", 1.0f, 0.0f, kMaxScale);
}

// pbrt takes a target of 0 or less for none.
float ReadTarget(Parameters& parameters, std::string_view name, float per_unit) {
  const float target = parameters.Float(name, -1.0f);
  return target > 0.0f ? target / per_unit : 1.0f;
}

LightRecord ReadInfinite(Parameters& parameters) {
  Rgb3 color{1.0f, 1.0f, 1.0f};
  const Parameter* file = parameters.Any("filename");
  if (file != nullptr) {
    parameters.Warn(file->place,
                    "environment maps are not supported; a constant white sky of radiance "
                    "\"scale\" replaces the image");
  } else {
    color = ReadLightColor(parameters, "L");
  }
  parameters.Ignore({"portal"});
  const float scale = ReadScale(parameters) * ReadTarget(parameters, "illuminance", kPi);
  return MakeLight(kInfiniteLight, color, scale);
}

LightRecord ReadPoint(Parameters& parameters, const Transform& to_world) {
  const Rgb3 color = ReadLightColor(parameters, "I");
  const float scale = ReadScale(parameters) * ReadTarget(parameters, "power", 4.0f * kPi);
  LightRecord light = MakeLight(kPointLight, color, scale);
  const auto from = parameters.Point3("from", {0.0f, 0.0f, 0.0f});
  const Point p = MapPoint(to_world, {from[0], from[1], from[2]});
  for (size_t c = 0; c < 3; ++c) light.p[c] = static_cast<float>(p[c]);
  return light;
}

LightRecord ReadDistant(Parameters& parameters, const Transform& to_world) {
  const Rgb3 color = ReadLightColor(parameters, "L");
  const float scale = ReadScale(parameters) * ReadTarget(parameters, "illuminance", 1.0f);
  LightRecord light = MakeLight(kDistantLight, color, scale);
  const auto from = parameters.Point3("from", {0.0f, 0.0f, 0.0f});
  const auto to = parameters.Point3("to", {0.0f, 0.0f, 1.0f});
  const auto towards = Normalized(MapVector(
      to_world, {double(from[0]) - to[0], double(from[1]) - to[1], double(from[2]) - to[2]}));
  if (!towards) {
    parameters.Fail(parameters.place(), "\"from\" and \"to\" are the same point");
    return light;
  }
  for (size_t c = 0; c < 3; ++c) light.p[c] = static_cast<float>((*towards)[c]);
  return light;
}

}  // namespace

void ReadLightSource(Parameters& parameters, const std::string& type, const Transform& to_world,
                     Scene* scene) {
  if (type == "spot" || type == "goniometric" || type == "projection") {
    return parameters.Warn(parameters.place(),
                           "light " + Quote(type) + " is not supported and is left out");
  }
  LightRecord light{};
  if (type == "infinite") {
    light = ReadInfinite(parameters);
  } else if (type == "point") {
    light = ReadPoint(parameters, to_world);
  } else if (type == "distant") {
    light = ReadDistant(parameters, to_world);
  } else {
    const std::vector<std::string_view> known = {"infinite", "point", "distant"};
    return parameters.Fail(parameters.place(), "unknown light " + Quote(type) +
                                                   DidYouMean(type, known) +
                                                   " (known: " + ListOf(known) + ")");
  }
  for (float value : light.radiance) {
    if (!std::isfinite(value))
      parameters.Fail(parameters.place(), "the light is infinitely bright");
  }
  for (float value : light.p) {
    if (!std::isfinite(value))
      parameters.Fail(parameters.place(), "the light is not finitely near");
  }
  parameters.ReportUnknown();
  scene->lights.push_back(light);
}

Emission ReadAreaLight(Parameters& parameters, const std::string& type) {
  Emission emission;
  if (type != "diffuse") {
    parameters.Fail(parameters.place(), "unknown area light " + Quote(type) +
                                            DidYouMean(type, {"diffuse"}) + " (known: diffuse)");
    return emission;
  }
  if (const Parameter* file = parameters.Any("filename")) {
    parameters.Warn(file->place, "emission by an image is not supported; it is uniform");
  }
  const Rgb3 color = ReadLightColor(parameters, "L");
  const float scale = ReadScale(parameters);
  emission.emits = true;
  emission.two_sided = parameters.Bool("twosided", false);
  emission.power = parameters.Float("power", -1.0f);
  for (size_t c = 0; c < 3; ++c) {
    emission.radiance[c] = color[c] * scale;
    if (!std::isfinite(emission.radiance[c])) {
      parameters.Fail(parameters.place(), "the light is infinitely bright");
    }
  }
  parameters.ReportUnknown();
  return emission;
}

}  // namespace swell
