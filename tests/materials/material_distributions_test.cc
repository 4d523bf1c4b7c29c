// Distributions and energy that single materials promise: lossless ones, and the four ways of
// diffuse.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/materials/material_support.h"
#include "tests/materials/statistics.h"

namespace swell::test {

TEST_SUITE_BEGIN("statistical");

TEST_CASE("materials: lossless ones scatter all power") {
  constexpr size_t kCount = 4096;
  struct Lossless {
    const char* material;
    const char* param;
    float value;
    double least_cosine;  // of the view: what falls below the surface is absorbed
  };
  const Lossless subjects[] = {
      {"diffuse", "reflectance", 1.0f, 0.0}, {"mirror", "reflectance", 1.0f, 0.0},
      {"dielectric", "eta", 1.5f, 0.0},      {"dielectric", "eta", 0.4f, 0.0},
      {"dielectric", "fresnel", 1.0f, 0.0},  {"fuzzymirror", "fuzz", 0.3f, 0.5},
  };
  for (const Lossless& subject : subjects) {
    const MaterialInfo& info = FindMaterial(subject.material);
    Params params = Defaults(info);
    SetParam(info, subject.param, subject.value, &params);
    for (const Variant& variant : SupportedVariants()) {
      for (const Direction& view : ViewDirections()) {
        if (std::fabs(view.z) < subject.least_cosine) continue;
        for (const DiffuseSampling sampling : Samplings(info)) {
          const Samples s = Sample(info, variant, params, sampling, Repeat(view, kCount),
                                   RandomUniforms(kCount, 31), kCount);
          // No sampling error: every sample carries all of it.
          double worst = 0.0;
          for (size_t i = 0; i < kCount; ++i) {
            const double power = double{s.weight[0][i]} * s.eta_scale[i];
            worst = std::fmax(worst, std::fabs(power - 1.0));
          }
          INFO(subject.material, ", cos ", view.z, " ", variant.name);
          CHECK(worst < 1e-6);
        }
      }
    }
  }
}

TEST_CASE("diffuse: the four ways of drawing agree in distribution") {
  constexpr size_t kCount = 200000, kBands = 16, kSectors = 16;
  const MaterialInfo& info = FindMaterial("diffuse");
  const Directions wo = Repeat({0, 0, 1}, kCount);
  std::vector<double> p_values;
  for (const Variant& variant : SupportedVariants()) {
    std::vector<std::vector<double>> histograms;
    for (const DiffuseSampling sampling : Samplings(info)) {
      const uint64_t seed = 40 + static_cast<uint64_t>(sampling);
      const Samples s =
          Sample(info, variant, Defaults(info), sampling, wo, RandomUniforms(kCount, seed), kCount);
      std::vector<double> histogram(kBands * kSectors, 0.0);
      for (size_t i = 0; i < kCount; ++i) {
        // cos^2 and the azimuth of a cosine distribution are uniform: all bins expect the same.
        const double band = double{s.wi.z[i]} * s.wi.z[i] * kBands;
        const double turn = std::atan2(s.wi.y[i], s.wi.x[i]) / (2.0 * M_PI) + 0.5;
        const size_t row = std::min(static_cast<size_t>(band), kBands - 1);
        const size_t column = std::min(static_cast<size_t>(turn * kSectors), kSectors - 1);
        histogram[row * kSectors + column] += 1.0;
      }
      const std::vector<double> expected(kBands * kSectors, double{kCount} / (kBands * kSectors));
      p_values.push_back(ChiSquarePValue(histogram, expected));
      histograms.push_back(histogram);
    }
    for (size_t a = 0; a < histograms.size(); ++a) {
      for (size_t b = 0; b < a; ++b) {
        double sum = 0.0;  // two samples of the same size
        for (size_t i = 0; i < kBands * kSectors; ++i) {
          const double difference = histograms[a][i] - histograms[b][i];
          sum += difference * difference / (histograms[a][i] + histograms[b][i]);
        }
        p_values.push_back(ChiSquareTail(sum, kBands * kSectors - 1));
      }
    }
  }
  for (const double p : p_values) CHECK(p > SidakThreshold(0.01, p_values.size()));
}

TEST_SUITE_END();

}  // namespace swell::test
