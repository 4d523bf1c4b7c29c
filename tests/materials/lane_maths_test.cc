// sin, cos and the Fresnel formulas of the kernels against double precision, on every target.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "tests/materials/lane_maths_probe.h"
#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

double Square(double x) { return x * x; }

// The textbook forms, by angles; they share no algebra with the kernels.
double ReferenceDielectric(double cos_i, double eta) {
  const double sin_t = std::sqrt(1.0 - cos_i * cos_i) / eta;
  if (sin_t >= 1.0) return 1.0;
  if (cos_i > 1.0 - 1e-12) return Square((eta - 1.0) / (eta + 1.0));
  const double i = std::acos(cos_i), t = std::asin(sin_t);
  return 0.5 *
         (Square(std::sin(i - t) / std::sin(i + t)) + Square(std::tan(i - t) / std::tan(i + t)));
}
double ReferenceConductor(double cos_i, double eta, double k) {
  const std::complex<double> index(eta, k);
  const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (index * index));
  const std::complex<double> parallel = (index * cos_i - cos_t) / (index * cos_i + cos_t);
  const std::complex<double> perpendicular = (cos_i - index * cos_t) / (cos_i + index * cos_t);
  return 0.5 * (std::norm(parallel) + std::norm(perpendicular));
}
double ReferenceSchlick(double cos_i, double eta) {
  const double normal = Square((eta - 1.0) / (eta + 1.0));
  return normal + (1.0 - normal) * std::pow(1.0 - cos_i, 5.0);
}

struct Table {
  std::vector<float> in[3], out;
  void Add(double a, double b = 0.0, double c = 0.0) {
    in[0].push_back(static_cast<float>(a));
    in[1].push_back(static_cast<float>(b));
    in[2].push_back(static_cast<float>(c));
  }
  size_t size() const { return in[0].size(); }
};
// A copy with the function's values in `out`.
Table Run(Table table, const Variant& variant, LaneFunction function) {
  const size_t count = table.size();
  const float* columns[3];
  for (int c = 0; c < 3; ++c) {
    table.in[c].resize(RoundUpToPadding(count), 1.0f);
    columns[c] = table.in[c].data();
  }
  table.out.resize(RoundUpToPadding(count));
  {
    const TargetScope scope(variant);
    ProbeLaneFunction(variant.width, function, columns, table.out.data(), count);
  }
  for (int c = 0; c < 3; ++c) table.in[c].resize(count);
  return table;
}
double Probe(const Variant& variant, LaneFunction function, double a, double b, double c = 0.0) {
  Table table;
  table.Add(a, b, c);
  return Run(table, variant, function).out[0];
}

constexpr double kIndices[] = {1.00029, 1.31, 1.333, 1.5, 2.417, 1 / 1.333, 1 / 1.5, 1 / 2.417};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("SinCosTurns: errs by less than 2e-7 over the whole turn") {
    Table table;
    for (int i = 0; i <= 1 << 19; ++i) table.Add(std::ldexp(i, -19));
    for (const Variant& variant : SupportedVariants()) {
      const Table sine = Run(table, variant, LaneFunction::kSinTurns);
      const Table cosine = Run(table, variant, LaneFunction::kCosTurns);
      double worst = 0.0;
      for (size_t i = 0; i < table.size(); ++i) {
        const double angle = 2.0 * M_PI * table.in[0][i];
        worst = std::fmax(worst, std::fabs(sine.out[i] - std::sin(angle)));
        worst = std::fmax(worst, std::fabs(cosine.out[i] - std::cos(angle)));
      }
      INFO(variant.name);
      CHECK(worst < 2e-7);
    }
  }

  TEST_CASE(
      "RefractedCosine: Snell's law, 0 from the critical angle on, and eta 1 keeps the bits") {
    for (const Variant& variant : SupportedVariants()) {
      INFO(variant.name);
      for (const double eta : kIndices) {
        for (double degrees = 0.0; degrees < 90.0; degrees += 1.0) {
          const double angle = degrees * M_PI / 180.0;
          const double sin_t = std::sin(angle) / eta;
          const double cos_t = Probe(variant, LaneFunction::kRefractedCosine, std::cos(angle), eta);
          if (sin_t > 1.0) CHECK(cos_t == 0.0);
          if (sin_t < 0.999)
            CHECK(cos_t == doctest::Approx(std::cos(std::asin(sin_t))).epsilon(1e-5));
        }
      }
      for (double cosine = 1.0; cosine > 1e-6; cosine *= 0.7) {
        CHECK(Probe(variant, LaneFunction::kRefractedCosine, cosine, 1.0) ==
              static_cast<double>(static_cast<float>(cosine)));
      }
      // Glass to air: the critical angle is asin(1 / 1.5) = 41.81 degrees.
      const double critical = std::asin(1.0 / 1.5);
      CHECK(Probe(variant, LaneFunction::kRefractedCosine, std::cos(critical + 1e-3), 1 / 1.5) ==
            0.0);
      CHECK(Probe(variant, LaneFunction::kRefractedCosine, std::cos(critical - 1e-3), 1 / 1.5) >
            0.0);
    }
  }

  TEST_CASE("FresnelDielectric: the textbook equations at all angles") {
    for (const Variant& variant : SupportedVariants()) {
      Table table;
      for (const double eta : kIndices) {
        for (int i = 1; i <= 1000; ++i) table.Add(i * 1e-3, eta);
      }
      const Table f = Run(table, variant, LaneFunction::kFresnelDielectric);
      const Table cos_t = Run(table, variant, LaneFunction::kRefractedCosine);
      INFO(variant.name);
      for (size_t i = 0; i < f.size(); ++i) {
        const double expected = ReferenceDielectric(f.in[0][i], f.in[1][i]);
        // The rounding of cos_t^2 moves cos_t by this over cos_t: near the critical angle a lot.
        const double slack = 1e-6 + std::fmin(2e-7 / std::fmax(cos_t.out[i], 1e-9f), 2e-3);
        CHECK(std::fabs(f.out[i] - expected) < slack);
      }
    }
  }

  TEST_CASE(
      "FresnelDielectric: normal incidence, Brewster's angle, total reflection, equal media") {
    for (const Variant& variant : SupportedVariants()) {
      INFO(variant.name);
      const auto fresnel = [&](double cos_i, double eta) {
        return Probe(variant, LaneFunction::kFresnelDielectric, cos_i, eta);
      };
      for (const double eta : kIndices) {
        CHECK(std::fabs(fresnel(1.0, eta) - Square((eta - 1.0) / (eta + 1.0))) < 1e-7);
        // At Brewster's angle only the perpendicular polarisation is reflected, and
        // r = cos^2 - sin^2 of it.
        const double brewster = std::atan(eta);
        const double perpendicular = Square(std::cos(2.0 * brewster));
        CHECK(std::fabs(fresnel(std::cos(brewster), eta) - 0.5 * perpendicular) < 1e-6);
        if (eta < 1.0) CHECK(fresnel(0.99 * std::sqrt(1.0 - eta * eta), eta) == 1.0);
      }
      for (const double cosine : {1.0, 0.5, 0.01, 1e-4}) CHECK(fresnel(cosine, 1.0) == 0.0);
    }
  }

  TEST_CASE("FresnelSchlick: its formula; at index 1.5 it errs by at most 0.0358") {
    for (const Variant& variant : SupportedVariants()) {
      INFO(variant.name);
      double worst = 0.0, worst_inside = 0.0;
      Table outside, inside;
      for (int i = 1; i <= 4000; ++i) outside.Add(i / 4000.0, 1.5), inside.Add(i / 4000.0, 1 / 1.5);
      outside = Run(outside, variant, LaneFunction::kFresnelSchlick);
      inside = Run(inside, variant, LaneFunction::kFresnelSchlick);
      for (size_t i = 0; i < outside.size(); ++i) {
        const double cosine = outside.in[0][i];
        CHECK(outside.out[i] == doctest::Approx(ReferenceSchlick(cosine, 1.5)).epsilon(1e-5));
        worst = std::fmax(worst, std::fabs(outside.out[i] - ReferenceDielectric(cosine, 1.5)));
        worst_inside = std::fmax(worst_inside,
                                 std::fabs(inside.out[i] - ReferenceDielectric(cosine, 1 / 1.5)));
      }
      CHECK((worst > 0.0356 && worst < 0.0358));  // at 85 degrees from the rarer side
      CHECK((worst_inside > 0.0356 && worst_inside < 0.0358));
    }
  }

  TEST_CASE("FresnelConductor: complex arithmetic's values, and the formula at normal incidence") {
    const double metals[][2] = {{0.2753, 3.3726}, {0.0469, 2.8028}, {1.4303, 7.5081},
                                {1.2469, 2.4562}, {1.5, 0.0},       {0.5, 0.1},
                                {1.0, 2.0},       {60.0, 80.0}};
    for (const Variant& variant : SupportedVariants()) {
      INFO(variant.name);
      for (const auto& [eta, k] : metals) {
        const double normal = (Square(eta - 1.0) + k * k) / (Square(eta + 1.0) + k * k);
        CHECK(std::fabs(Probe(variant, LaneFunction::kFresnelConductor, 1.0, eta, k) - normal) <
              1e-6);
        for (double cosine = 0.0; cosine <= 1.0; cosine += 0.01) {
          const double f = Probe(variant, LaneFunction::kFresnelConductor, cosine, eta, k);
          if (eta < 1.0 && k < 0.5 && cosine < 0.9) continue;  // total reflection's edge: see above
          CHECK(std::fabs(f - ReferenceConductor(cosine, eta, k)) < 5e-6);
        }
      }
    }
  }
}

}  // namespace swell::test
