// Spectra as colours: colour matching, black bodies, standard illuminants, files of samples.
#include "src/import/spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

#include "src/base/suggest.h"
#include "src/import/tokens.h"

namespace swell {
namespace {

using Xyz = std::array<double, 3>;
using Spectrum = std::function<double(double nm)>;

constexpr double kFirstNm = 360.0, kLastNm = 830.0;

double Lobe(double nm, double peak, double below, double above) {
  const double t = (nm - peak) * (nm < peak ? below : above);
  return std::exp(-0.5 * t * t);
}

// CIE 1931 2 degree observer. Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE
// XYZ Color Matching Functions", JCGT 2(2), 2013, equation 4.
Xyz ColorMatching(double nm) {
  return {0.362 * Lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * Lobe(nm, 599.8, 0.0264, 0.0323) -
              0.065 * Lobe(nm, 501.1, 0.0490, 0.0382),
          0.821 * Lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * Lobe(nm, 530.9, 0.0613, 0.0322),
          1.217 * Lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * Lobe(nm, 459.0, 0.0385, 0.0725)};
}

// IEC 61966-2-1 (sRGB primaries, white D65).
Xyz LinearSrgb(const Xyz& c) {
  return {3.2404542 * c[0] - 1.5371385 * c[1] - 0.4985314 * c[2],
          -0.9692660 * c[0] + 1.8760108 * c[1] + 0.0415560 * c[2],
          0.0556434 * c[0] - 0.2040259 * c[1] + 1.0572252 * c[2]};
}

Xyz Integrate(const Spectrum& spectrum) {
  Xyz sum{};
  for (double nm = kFirstNm; nm <= kLastNm; nm += 1.0) {
    const Xyz matching = ColorMatching(nm);
    const double value = spectrum(nm);
    for (size_t c = 0; c < 3; ++c) sum[c] += matching[c] * value;
  }
  return sum;
}

// Colours outside of sRGB are moved to its edge.
Rgb3 Clamped(const Xyz& rgb) {
  Rgb3 color{};
  for (size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(std::max(rgb[c], 0.0));
  return color;
}

Rgb3 AtLuminanceOne(const Xyz& xyz) {
  return Clamped(LinearSrgb({xyz[0] / xyz[1], 1.0, xyz[2] / xyz[1]}));
}

// Planck's law, relative.
double Planck(double nm, double kelvin) {
  const double metres = nm * 1e-9;
  constexpr double kHcOverK = 1.438776877e-2;  // h c / k [m K], CODATA 2018
  return std::pow(nm / 560.0, -5.0) / std::expm1(kHcOverK / (metres * kelvin)) *
         std::expm1(kHcOverK / (560e-9 * kelvin));
}

// CIE 15:2004, tables T.3 and T.8: chromaticities of the standard illuminants, 2 degree observer.
struct Illuminant {
  std::string_view name;
  double x, y;
};
constexpr Illuminant kIlluminants[] = {
    {"stdillum-A", 0.44758, 0.40745},   {"stdillum-D50", 0.34567, 0.35851},
    {"stdillum-D65", 0.31272, 0.32903}, {"stdillum-F1", 0.3131, 0.3371},
    {"stdillum-F2", 0.3721, 0.3751},    {"stdillum-F3", 0.4091, 0.3941},
    {"stdillum-F4", 0.4402, 0.4031},    {"stdillum-F5", 0.3138, 0.3452},
    {"stdillum-F6", 0.3779, 0.3882},    {"stdillum-F7", 0.3129, 0.3292},
    {"stdillum-F8", 0.3458, 0.3586},    {"stdillum-F9", 0.3741, 0.3727},
    {"stdillum-F10", 0.3458, 0.3588},   {"stdillum-F11", 0.3805, 0.3769},
    {"stdillum-F12", 0.4370, 0.4042},   {"illum-acesD60", 0.32168, 0.33767},  // SMPTE ST 2065-1
};

// Samples of a spectrum: wavelength, value, wavelength, value...; linear between, 0 outside.
struct Samples {
  std::vector<float> pairs;

  double operator()(double nm) const {
    const size_t count = pairs.size() / 2;
    if (count == 0 || nm < pairs[0] || nm > pairs[2 * count - 2]) return 0.0;
    size_t i = 0;
    while (i + 2 < count && pairs[2 * (i + 1)] <= nm) ++i;
    if (count == 1) return pairs[1];
    const double t = (nm - pairs[2 * i]) / (pairs[2 * i + 2] - pairs[2 * i]);
    return (1.0 - t) * pairs[2 * i + 1] + t * pairs[2 * i + 3];
  }
};

bool CheckSamples(Parameters& parameters, const Samples& samples, Place place) {
  const std::vector<float>& pairs = samples.pairs;
  if (pairs.empty() || pairs.size() % 2 != 0) {
    parameters.Fail(place, "a spectrum is pairs of wavelength [nm] and value, not " +
                               std::to_string(pairs.size()) + " numbers");
    return false;
  }
  for (size_t i = 0; i < pairs.size(); i += 2) {
    if (i > 0 && !(pairs[i] > pairs[i - 2])) {
      parameters.Fail(place, "wavelengths of a spectrum must rise from pair to pair");
      return false;
    }
    if (pairs[i + 1] < 0.0f) {
      parameters.Fail(place, "values of a spectrum must not be negative");
      return false;
    }
  }
  return true;
}

Samples ReadSpectrumFile(Parameters& parameters, const std::string& name, Place place) {
  Samples samples;
  const std::string path = parameters.ResolveFile(name, place);
  if (parameters.failed()) return samples;
  TokenStream tokens(parameters.diagnostics());
  tokens.Open(path, place);
  while (!parameters.failed() && tokens.Peek().kind != TokenKind::kEnd) {
    samples.pairs.push_back(ParseFloat(tokens.Next(), parameters.diagnostics()));
  }
  return samples;
}

// pbrt's names that stand for no light and no share of one, but for something of a material or a
// sensor.
bool IsOtherSpectrum(std::string_view name) {
  for (std::string_view start : {"metal-", "glass-", "canon_", "nikon_", "sony_", "sigma_"}) {
    if (name.substr(0, start.size()) == start) return true;
  }
  return false;
}

// The samples behind a "spectrum" parameter that is no named illuminant.
Samples ReadSamples(Parameters& parameters, const Parameter& parameter) {
  Samples samples;
  if (parameter.strings.size() == 1 && parameter.floats.empty()) {
    const std::string& name = parameter.strings[0];
    if (name.find('.') == std::string::npos && !parameters.HasFile(name)) {
      std::vector<std::string_view> names;
      for (const Illuminant& illuminant : kIlluminants) names.push_back(illuminant.name);
      parameters.Fail(
          parameter.place,
          parameter.Title() + ": " +
              (IsOtherSpectrum(name)
                   ? Quote(name) + " is no spectrum of light; known here are"
                   : "unknown spectrum " + Quote(name) + DidYouMean(name, names) + " (known:") +
              " " + ListOf(names) +
              (IsOtherSpectrum(name) ? "" : ", files of samples, numbers in [ ])"));
      return samples;
    }
    samples = ReadSpectrumFile(parameters, name, parameter.place);
  } else {
    samples.pairs = parameter.floats;
  }
  if (!parameters.failed()) CheckSamples(parameters, samples, parameter.place);
  return samples;
}

const Illuminant* FindIlluminant(const Parameter& parameter) {
  if (parameter.strings.size() != 1) return nullptr;
  for (const Illuminant& illuminant : kIlluminants) {
    if (illuminant.name == parameter.strings[0]) return &illuminant;
  }
  return nullptr;
}

Rgb3 ReadRgb(Parameters& parameters, const Parameter& parameter) {
  if (parameter.floats.size() != 3) {
    parameters.Fail(parameter.place, parameter.Title() + " needs 3 values, not " +
                                         std::to_string(parameter.floats.size()));
    return {};
  }
  for (float value : parameter.floats) {
    if (value < 0.0f) parameters.Fail(parameter.place, parameter.Title() + " must not be negative");
  }
  return {parameter.floats[0], parameter.floats[1], parameter.floats[2]};
}

Rgb3 ReadBlackbody(Parameters& parameters, const Parameter& parameter) {
  constexpr float kMinKelvin = 500.0f;  // colder bodies do not shine
  if (parameter.floats.size() != 1 || parameter.floats[0] < kMinKelvin) {
    parameters.Fail(parameter.place, parameter.Title() + " needs one temperature of at least " +
                                         std::to_string(static_cast<int>(kMinKelvin)) + " K");
    return {};
  }
  return BlackbodyColor(parameter.floats[0]);
}

}  // namespace

Rgb3 BlackbodyColor(double kelvin) {
  return AtLuminanceOne(Integrate([kelvin](double nm) { return Planck(nm, kelvin); }));
}

Rgb3 ReadLightColor(Parameters& parameters, std::string_view name) {
  constexpr Rgb3 kWhite{1.0f, 1.0f, 1.0f};
  Parameter* parameter = parameters.Any(name);
  if (parameter == nullptr) return kWhite;
  if (parameter->type == "rgb") return ReadRgb(parameters, *parameter);
  if (parameter->type == "blackbody") {
    return ReadBlackbody(parameters, *parameter);
  }
  if (parameter->type != "spectrum") {
    parameters.FailType(*parameter, "rgb");
    return kWhite;
  }
  if (const Illuminant* illuminant = FindIlluminant(*parameter)) {
    const double x = illuminant->x, y = illuminant->y;
    return AtLuminanceOne({x / y, 1.0, (1.0 - x - y) / y});
  }
  const Samples samples = ReadSamples(parameters, *parameter);
  if (parameters.failed()) return kWhite;
  const Xyz xyz = Integrate(samples);
  if (!(xyz[1] > 0.0)) return {0.0f, 0.0f, 0.0f};
  return AtLuminanceOne(xyz);
}

Rgb3 ReadWeightColor(Parameters& parameters, Parameter& parameter) {
  if (parameter.type == "rgb") return ReadRgb(parameters, parameter);
  if (parameter.type == "blackbody") return ReadBlackbody(parameters, parameter);
  if (parameter.type != "spectrum") {
    parameters.FailType(parameter, "rgb");
    return {};
  }
  const Samples samples = ReadSamples(parameters, parameter);
  if (parameters.failed()) return {};
  const Xyz value = LinearSrgb(Integrate(samples));
  const Xyz one = LinearSrgb(Integrate([](double) { return 1.0; }));
  return Clamped({value[0] / one[0], value[1] / one[1], value[2] / one[2]});
}

}  // namespace swell
