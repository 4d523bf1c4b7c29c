// Lights with pbrt-v4's units: a colour, its "scale", and a target (power, illuminance) that scales
// a light of luminance 1.
#include "src/import/lights.h"

#include <cmath>

#include "src/import/image_lights.h"
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
  light.image = kNone;
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

LightRecord ReadInfinite(Parameters& parameters, const Transform& to_world, Scene* scene) {
  Rgb3 color{1.0f, 1.0f, 1.0f};
  const Parameter* file = parameters.Any("filename");
  if (file == nullptr) {
    color = ReadLightColor(parameters, "L");
  } else if (const Parameter* both = parameters.Any("L")) {
    parameters.Fail(both->place, "\"L\" and \"filename\" are both given; remove one of the two");
  }
  parameters.Ignore({"portal"});
  const float scale = ReadScale(parameters);
  if (file == nullptr) {
    return MakeLight(kInfiniteLight, color, scale * ReadTarget(parameters, "illuminance", kPi));
  }
  LightRecord light = MakeLight(kImageInfiniteLight, color, scale);
  ReadSkyImage(parameters, *file, to_world, &light, scene);
  return light;
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

// Sets p and the axis n; pbrt normalises both ways, so a scaled space keeps the cone's angle.
void AimSpot(Parameters& parameters, const Transform& to_world, LightRecord* light) {
  const auto from = parameters.Point3("from", {0.0f, 0.0f, 0.0f});
  const auto to = parameters.Point3("to", {0.0f, 0.0f, 1.0f});
  const Point p = MapPoint(to_world, {from[0], from[1], from[2]});
  const auto axis = Normalized(MapVector(
      to_world, {double(to[0]) - from[0], double(to[1]) - from[1], double(to[2]) - from[2]}));
  if (!axis) return parameters.Fail(parameters.place(), "\"from\" and \"to\" are the same point");
  for (size_t c = 0; c < 3; ++c) {
    light->p[c] = static_cast<float>(p[c]);
    light->n[c] = static_cast<float>((*axis)[c]);
  }
}

LightRecord ReadSpot(Parameters& parameters, const Transform& to_world) {
  const Rgb3 color = ReadLightColor(parameters, "I");
  const float cone = parameters.FloatWithin("coneangle", 30.0f, 0.0f, 180.0f);
  const float delta = parameters.FloatWithin("conedeltaangle", 5.0f, 0.0f, 180.0f);
  if (!parameters.failed() && delta > cone) {
    parameters.Fail(parameters.place(), "\"conedeltaangle\" is above \"coneangle\"");
  }
  const double dark = std::cos(cone * double{kPi} / 180.0);
  const double full = std::cos((cone - delta) * double{kPi} / 180.0);
  // The cubic between the two cosines has the mean 1/2.
  const double emitted = 2.0 * double{kPi} * ((1.0 - full) + (full - dark) / 2.0);
  const float scale =
      ReadScale(parameters) * ReadTarget(parameters, "power", static_cast<float>(emitted));
  LightRecord light = MakeLight(kSpotLight, color, scale);
  light.e1[0] = static_cast<float>(full);
  light.e1[1] = static_cast<float>(dark);
  AimSpot(parameters, to_world, &light);
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
  LightRecord light{};
  if (type == "infinite") {
    light = ReadInfinite(parameters, to_world, scene);
  } else if (type == "point") {
    light = ReadPoint(parameters, to_world);
  } else if (type == "distant") {
    light = ReadDistant(parameters, to_world);
  } else if (type == "spot") {
    light = ReadSpot(parameters, to_world);
  } else if (type == "goniometric") {
    light = MakeLight(kGoniometricLight, ReadLightColor(parameters, "I"), ReadScale(parameters));
    ReadGoniometric(parameters, to_world, &light, scene);
  } else if (type == "projection") {
    light = MakeLight(kProjectionLight, {1.0f, 1.0f, 1.0f}, ReadScale(parameters));
    ReadProjection(parameters, to_world, &light, scene);
  } else {
    const std::vector<std::string_view> known = {"infinite", "point",       "distant",
                                                 "spot",     "goniometric", "projection"};
    return parameters.Fail(parameters.place(),
                           "unknown light " + Quote(type) + KnownWords(type, known));
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

Emission ReadAreaLight(Parameters& parameters, const std::string& type, Scene* scene) {
  Emission emission;
  if (type != "diffuse") {
    parameters.Fail(parameters.place(), "unknown area light " + Quote(type) +
                                            DidYouMean(type, {"diffuse"}) + " (known: diffuse)");
    return emission;
  }
  const Parameter* file = parameters.Any("filename");
  const Rgb3 color = ReadLightColor(parameters, "L");
  float scale = ReadScale(parameters);
  emission.emits = true;
  emission.two_sided = parameters.Bool("twosided", false);
  emission.power = parameters.Float("power", -1.0f);
  if (file != nullptr) {
    if (const Parameter* both = parameters.Any("L")) {
      parameters.Fail(both->place, "\"L\" and \"filename\" are both given; remove one of the two");
      return emission;
    }
    double luminance = 1.0;
    emission.image = ReadSurfaceImage(parameters, *file, scene, &luminance);
    // As pbrt, which counts the image's mean for a target but not how it lies on the shape.
    if (emission.power > 0.0f && luminance > 0.0) scale /= static_cast<float>(luminance);
  }
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
