// Media with pbrt-v4's parameters and defaults.
#include "src/import/media.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/suggest.h"
#include "src/import/spectrum.h"

namespace swell {
namespace {

constexpr float kMaxScale = 1e30f;

void LeaveOut(Parameters& parameters, std::string_view why) {
  parameters.Warn(parameters.place(),
                  std::string(why) + ", which is not supported; the medium is left out");
  parameters.Accept({"sigma_a",
                     "sigma_s",
                     "scale",
                     "g",
                     "Le",
                     "Lescale",
                     "preset",
                     "density",
                     "nx",
                     "ny",
                     "nz",
                     "p0",
                     "p1",
                     "filename",
                     "temperature",
                     "temperaturescale",
                     "temperatureoffset",
                     "LeScale",
                     "wispiness",
                     "frequency",
                     "temperaturecutoff"});
  parameters.ReportUnknown();
}

bool IsBlack(const Rgb3& color) {
  return std::all_of(color.begin(), color.end(), [](float value) { return value == 0.0f; });
}

}  // namespace

Rgb3 ReadMedium(Parameters& parameters) {
  const std::vector<std::string_view> known = {"homogeneous", "uniformgrid", "rgbgrid", "cloud",
                                               "nanovdb"};
  const std::string type = parameters.String("type", "");
  if (parameters.failed()) return {};
  if (type.empty()) {
    parameters.Fail(parameters.place(), "\"string type\" is missing");
    return {};
  }
  if (std::find(known.begin(), known.end(), type) == known.end()) {
    parameters.Fail(parameters.place(), "unknown medium " + Quote(type) + KnownWords(type, known));
    return {};
  }
  if (type != "homogeneous") {
    LeaveOut(parameters, "type " + Quote(type) + " varies from place to place");
    return {};
  }
  const float scale = parameters.FloatWithin("scale", 1.0f, 0.0f, kMaxScale);
  Parameter* absorbed = parameters.Any("sigma_a");
  Parameter* scattered = parameters.Any("sigma_s");
  Parameter* emitted = parameters.Any("Le");
  // Without sigma_s it is pbrt's default, which scatters; the presets are of skin, milk and so on.
  const bool preset = !parameters.String("preset", "").empty();
  const bool scatters =
      preset || scattered == nullptr || !IsBlack(ReadWeightColor(parameters, *scattered));
  const bool glows = emitted != nullptr && !IsBlack(ReadWeightColor(parameters, *emitted));
  if (parameters.failed()) return {};
  if ((scatters && scale > 0.0f) || glows) {
    LeaveOut(parameters, scatters ? "it scatters light" : "it emits light");
    return {};
  }
  Rgb3 absorption{0.0011f, 0.0024f, 0.014f};  // pbrt's default
  if (absorbed != nullptr) absorption = ReadWeightColor(parameters, *absorbed);
  for (float& channel : absorption) {
    channel *= scale;
    if (!std::isfinite(channel)) {
      parameters.Fail(parameters.place(), "its absorption is infinite");
    }
  }
  parameters.Accept({"g", "Lescale"});
  parameters.ReportUnknown();
  return absorption;
}

}  // namespace swell
