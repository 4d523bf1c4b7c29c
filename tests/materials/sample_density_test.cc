// Samples of every material against its density: chi-square in bins around its lobes, and the mass.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "tests/materials/material_support.h"
#include "tests/materials/statistics.h"

namespace swell::test {
namespace {

Direction Mirrored(const Direction& wo) { return {-wo.x, -wo.y, wo.z}; }

// Where a material's density is known to be singular: the ring at sin = fuzz around the mirror
// direction, blurred by the rounding of directions.
Rim RimOf(const MaterialInfo& info, const Params& params) {
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (std::string(info.params[i].name) != "fuzz") continue;
    const double fuzz = params[ParamOffset(info, i)];
    return {fuzz * fuzz, 4e-7 * fuzz};
  }
  return {};
}

// Materials that document that a part of what they draw is lost below the surface.
bool Absorbs(const MaterialInfo& info) { return std::string(info.name) != "diffuse"; }

struct Fit {
  double p_value;
  double integral;      // of the pdf over the sphere
  double scattered;     // share of samples that are not void
  std::string subject;  // what was tested
};

// Mean direction of what a few samples send to the other side; straight on if nothing is.
Direction MeanBeyond(const MaterialInfo& info, const Variant& variant, const ParamSet& set,
                     DiffuseSampling sampling, const Direction& view) {
  constexpr size_t kCount = 1024;
  const Samples s = Sample(info, variant, set.params, sampling, Repeat(view, kCount),
                           RandomUniforms(kCount, 99), kCount);
  Direction sum = {0, 0, 0};
  for (size_t i = 0; i < kCount; ++i) {
    if (s.pdf[i] == 0.0f || s.wi.z[i] * view.z > 0.0) continue;
    sum = {sum.x + s.wi.x[i], sum.y + s.wi.y[i], sum.z + s.wi.z[i]};
  }
  const double length = std::sqrt(Dot(sum, sum));
  if (length == 0.0) return {-view.x, -view.y, -view.z};
  return {sum.x / length, sum.y / length, sum.z / length};
}

Fit FitSamples(const MaterialInfo& info, const Variant& variant, const ParamSet& set,
               DiffuseSampling sampling, const Direction& view, size_t count, uint64_t seed) {
  const Directions wo = Repeat(view, count);
  const Samples samples =
      Sample(info, variant, set.params, sampling, wo, RandomUniforms(count, seed), count);
  const Direction stored = wo.Get(0);  // as rounded to single precision
  const double length = std::sqrt(Dot(stored, stored));
  const Direction mirrored = Mirrored(stored);
  // The view's side is cut around the mirror direction, the other one around its lobe.
  const SphereBins near({mirrored.x / length, mirrored.y / length, mirrored.z / length},
                        RimOf(info, set.params));
  const SphereBins far(MeanBeyond(info, variant, set, sampling, view), {});

  std::vector<double> observed(near.count() + far.count(), 0.0);
  size_t scattered = 0;
  for (size_t i = 0; i < count; ++i) {
    const Direction wi = samples.wi.Get(i);
    if (samples.pdf[i] == 0.0f) continue;
    ++scattered;
    observed[wi.z * view.z > 0.0 ? near.Find(wi) : near.count() + far.Find(wi)] += 1.0;
  }
  const auto density_on = [&](double side) {
    return [&, side](const Directions& wi, size_t rows) {
      std::vector<float> pdf =
          Evaluate(info, variant, set.params, sampling, Repeat(view, rows), wi, rows).pdf;
      for (size_t i = 0; i < rows; ++i) pdf[i] = wi.z[i] * side > 0.0 ? pdf[i] : 0.0f;
      return pdf;
    };
  };
  std::vector<double> expected = near.Integrate(density_on(view.z));
  const std::vector<double> beyond = far.Integrate(density_on(-view.z));
  expected.insert(expected.end(), beyond.begin(), beyond.end());
  // The shape here; the mass, integral against scattered share, is the caller's.
  const double integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  const bool nothing = integral == 0.0 && scattered == 0;
  for (double& e : expected) e *= static_cast<double>(scattered) / integral;
  return {nothing ? 1.0 : ChiSquarePValue(observed, expected), integral,
          static_cast<double>(scattered) / static_cast<double>(count),
          Describe(info, set, sampling) + ", cos " + std::to_string(view.z) + ", " + variant.name};
}

// Tells parameter sets apart that draw differently: tints do not.
std::vector<float> Fingerprint(const MaterialInfo& info, const ParamSet& set,
                               DiffuseSampling sampling) {
  constexpr size_t kCount = 64;
  const Samples s = Sample(info, SupportedVariants()[0], set.params, sampling,
                           RandomDirections(kCount, 1), RandomUniforms(kCount, 2), kCount);
  std::vector<float> print;
  for (const std::vector<float>* column : {&s.wi.x, &s.wi.y, &s.wi.z, &s.pdf}) {
    print.insert(print.end(), column->begin(), column->end());
  }
  return print;
}

}  // namespace

TEST_SUITE_BEGIN("statistical");

TEST_CASE("materials: samples follow the density, which integrates to what is scattered") {
  constexpr size_t kCount = 60000;
  std::vector<Fit> fits;
  std::set<std::vector<float>> tested;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (info.is_specular(set.params.data()) || info.is_estimate()) return;
    if (!tested.insert(Fingerprint(info, set, sampling)).second) return;
    for (const Variant& variant : SupportedVariants()) {
      for (const Direction& view : ViewDirections()) {
        const Fit fit = FitSamples(info, variant, set, sampling, view, kCount, 17 + fits.size());
        INFO(fit.subject);
        // Five standard deviations, and what the quadrature leaves at the horizon.
        const double sigma = std::sqrt(fit.scattered * (1.0 - fit.scattered) / kCount);
        CHECK(fit.integral == doctest::Approx(fit.scattered).epsilon(5.0 * sigma + 1e-3));
        if (!Absorbs(info)) CHECK(fit.integral == doctest::Approx(1.0).epsilon(1e-3));
        fits.push_back(fit);
      }
    }
  });
  REQUIRE(fits.size() > 0);
  const double threshold = SidakThreshold(0.01, fits.size());
  for (const Fit& fit : fits) {
    INFO(fit.subject);
    CHECK(fit.p_value > threshold);
  }
}

TEST_SUITE_END();

}  // namespace swell::test
