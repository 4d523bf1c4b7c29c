// The statistical tests' own tools: known quantiles, and wrong densities that must be noticed.
#include "tests/materials/statistics.h"

#include <doctest/doctest.h>

#include <cmath>

namespace swell::test {

TEST_SUITE_BEGIN("unit");

TEST_CASE("ChiSquareTail: the 5 % and 0.1 % points of printed tables") {
  CHECK(ChiSquareTail(3.841, 1) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(ChiSquareTail(18.307, 10) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(ChiSquareTail(124.342, 100) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(ChiSquareTail(29.588, 10) == doctest::Approx(0.001).epsilon(1e-3));
  CHECK(ChiSquareTail(77.929, 100) == doctest::Approx(0.95).epsilon(1e-3));
}

TEST_CASE("SidakThreshold: all tests hold together with the probability asked for") {
  CHECK(std::pow(1.0 - SidakThreshold(0.01, 500), 500) == doctest::Approx(0.99));
}

TEST_CASE("SphereBins: integrates a constant, a cosine and a singular ring") {
  const Direction pole = FromAngles(0.6, 2.0);
  const SphereBins bins(pole, {1.0 - 0.8 * 0.8, 1e-9});
  const auto integrate = [&](auto f) {
    double sum = 0.0;
    for (const double part : bins.Integrate([&](const Directions&d, size_t count) {
           std::vector<float> values(count);
           for (size_t i = 0; i < count; ++i) values[i] = static_cast<float>(f(d.Get(i)));
           return values;
         })) {
      sum += part;
    }
    return sum;
  };
  CHECK(integrate([](const Direction&) { return 1.0; }) ==
        doctest::Approx(4.0 * M_PI).epsilon(1e-6));
  CHECK(integrate([](const Direction& d) { return std::fmax(d.z, 0.0); }) ==
        doctest::Approx(M_PI).epsilon(1e-4));
  // 1 / sqrt(c - 0.8) over the cone c > 0.8 is 2 pi 2 sqrt(0.2).
  CHECK(integrate([&](const Direction& d) {
          const double inside = Dot(d, pole) - 0.8;
          return inside > 0.0 ? 1.0 / std::sqrt(inside) : 0.0;
        }) == doctest::Approx(4.0 * M_PI * std::sqrt(0.2)).epsilon(1e-3));
}

TEST_CASE("ChiSquarePValue: notices samples of another density") {
  constexpr size_t kCount = 60000;
  const MaterialInfo& diffuse = FindMaterial("diffuse");
  const Direction view = FromAngles(0.6, 2.0);
  const Samples samples =
      Sample(diffuse, SupportedVariants()[0], Defaults(diffuse), DiffuseSampling::kDisk,
             Repeat(view, kCount), RandomUniforms(kCount, 1), kCount);
  const SphereBins bins({-view.x, -view.y, view.z}, {});
  std::vector<double> observed(bins.count(), 0.0);
  for (size_t i = 0; i < kCount; ++i) observed[bins.Find(samples.wi.Get(i))] += 1.0;
  // cos^power, of which power 1 is the truth.
  const auto p_value = [&](double power) {
    std::vector<double> expected = bins.Integrate([&](const Directions& d, size_t count) {
      std::vector<float> values(count);
      for (size_t i = 0; i < count; ++i) {
        const double density =
            (power + 1.0) / (2.0 * M_PI) * std::pow(std::fmax(d.z[i], 0.0), power);
        values[i] = static_cast<float>(density);
      }
      return values;
    });
    for (double& e : expected) e *= kCount;
    return ChiSquarePValue(observed, expected);
  };
  CHECK(p_value(1.0) > 1e-3);
  CHECK(p_value(1.1) < 1e-6);
  CHECK(p_value(0.9) < 1e-6);
}

TEST_SUITE_END();

}  // namespace swell::test
