// Implements statistics.h.
#include "tests/materials/statistics.h"

#include <algorithm>
#include <cmath>

namespace swell::test {

namespace {
// Regularised upper incomplete gamma function (Abramowitz and Stegun 6.5.29 and 6.5.31).
double UpperGamma(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
    return std::fmax(0.0, 1.0 - sum * scale);
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::fabs(d * c - 1.0) < 1e-15) break;
  }
  return scale * h;
}
}  // namespace

double ChiSquareTail(double x, double degrees_of_freedom) {
  return UpperGamma(0.5 * degrees_of_freedom, 0.5 * x);
}

double ChiSquarePValue(const std::vector<double>& observed, const std::vector<double>& expected) {
  double sum = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
  int bins = 0;
  const auto add = [&](double o, double e) {
    sum += (o - e) * (o - e) / e;
    ++bins;
  };
  for (size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5.0) {
      add(observed[i], expected[i]);
      continue;
    }
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < 5.0) continue;
    add(pooled_observed, pooled_expected);
    pooled_observed = pooled_expected = 0.0;
  }
  // What is left expects fewer than 5: a Poisson variable that exceeds 25 once in 10^10 times.
  if (pooled_observed > 25.0) return 0.0;
  if (bins < 2) return 1.0;
  return ChiSquareTail(sum, bins - 1);
}

double SidakThreshold(double alpha, size_t tests) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
}

SphereBins::SphereBins(const Direction& pole, const Rim& rim) : pole_(pole) {
  const Direction axis = std::fabs(pole.z) < 0.9 ? Direction{0, 0, 1} : Direction{1, 0, 0};
  tangent_ = {pole.y * axis.z - pole.z * axis.y, pole.z * axis.x - pole.x * axis.z,
              pole.x * axis.y - pole.y * axis.x};
  const double length = std::sqrt(Dot(tangent_, tangent_));
  tangent_ = {tangent_.x / length, tangent_.y / length, tangent_.z / length};
  // Not along a horizon.
  const Direction across = {pole.y * tangent_.z - pole.z * tangent_.y,
                            pole.z * tangent_.x - pole.x * tangent_.z,
                            pole.x * tangent_.y - pole.y * tangent_.x};
  tangent_ = {std::cos(0.15) * tangent_.x + std::sin(0.15) * across.x,
              std::cos(0.15) * tangent_.y + std::sin(0.15) * across.y,
              std::cos(0.15) * tangent_.z + std::sin(0.15) * across.z};
  bitangent_ = {pole.y * tangent_.z - pole.z * tangent_.y,
                pole.z * tangent_.x - pole.x * tangent_.z,
                pole.x * tangent_.y - pole.y * tangent_.x};
  edges_ = {0.0, 2.0};
  for (int octave = 0; octave < 14; ++octave) {
    for (const double step : {1.0, 1.5}) edges_.push_back(std::ldexp(step, -octave));
  }
  const auto at = [](double sin2) { return 1.0 - std::sqrt(std::fmax(0.0, 1.0 - sin2)); };
  if (rim.sin2 > 0.0) {
    edges_.push_back(at(rim.sin2 + rim.blur));
    splits_.push_back(at(rim.sin2));
    for (double width = rim.blur; width < 0.5 * rim.sin2; width *= 8.0) {
      splits_.push_back(at(rim.sin2 - width));
    }
  }
  splits_.insert(splits_.end(), edges_.begin(), edges_.end());
  std::sort(edges_.begin(), edges_.end());
  std::sort(splits_.begin(), splits_.end());
}

size_t SphereBins::Find(const Direction& d) const {
  const double length = std::sqrt(Dot(d, d));
  const Direction chord = {d.x / length - pole_.x, d.y / length - pole_.y, d.z / length - pole_.z};
  const double x = 0.5 * Dot(chord, chord);
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x);
  const double turn = std::atan2(Dot(d, bitangent_), Dot(d, tangent_)) / (2.0 * M_PI) + 0.5;
  const size_t sector = std::min(static_cast<size_t>(turn * kSectors), kSectors - 1);
  return static_cast<size_t>(above - edges_.begin() - 1) * kSectors + sector;
}

std::vector<double> SphereBins::Integrate(const Function& f) const {
  constexpr int kRingSteps = 16, kTurnSteps = 16;
  // Each ring step shifts its turn steps by the golden ratio, which averages over a horizon that
  // cuts a bin. A midpoint rule in t with x = t^2 (3 - 2 t): dx vanishes at both ends, which makes
  // densities that grow like 1 / sqrt there smooth.
  double weights[kRingSteps], weight_sum = 0.0;
  for (int i = 0; i < kRingSteps; ++i) {
    const double t = (i + 0.5) / kRingSteps;
    weight_sum += weights[i] = t * (1.0 - t);
  }
  std::vector<double> integrals(count(), 0.0);
  const size_t per_ring = kRingSteps * kTurnSteps * kSectors;
  Directions directions(per_ring * (splits_.size() - 1));
  size_t row = 0;
  for (size_t ring = 0; ring + 1 < splits_.size(); ++ring) {
    for (int i = 0; i < kRingSteps; ++i) {
      const double t = (i + 0.5) / kRingSteps;
      const double x =
          splits_[ring] + (splits_[ring + 1] - splits_[ring]) * t * t * (3.0 - 2.0 * t);
      const double sine = std::sqrt(x * (2.0 - x));
      const double shift = std::fmod(0.5 + 0.6180339887 * i, 1.0);
      for (size_t k = 0; k < kTurnSteps * kSectors; ++k, ++row) {
        const double turn = (static_cast<double>(k) + shift) / (kTurnSteps * kSectors);
        const double phi = (turn - 0.5) * 2.0 * M_PI;
        const double u = sine * std::cos(phi), v = sine * std::sin(phi), w = 1.0 - x;
        directions.Set(row, {u * tangent_.x + v * bitangent_.x + w * pole_.x,
                             u * tangent_.y + v * bitangent_.y + w * pole_.y,
                             u * tangent_.z + v * bitangent_.z + w * pole_.z});
      }
    }
  }
  const std::vector<float> values = f(directions, row);
  row = 0;
  size_t bin_ring = 0;
  for (size_t ring = 0; ring + 1 < splits_.size(); ++ring) {
    while (splits_[ring] >= edges_[bin_ring + 1]) ++bin_ring;
    const double area = (splits_[ring + 1] - splits_[ring]) * 2.0 * M_PI / (kTurnSteps * kSectors);
    for (int i = 0; i < kRingSteps; ++i) {
      for (size_t k = 0; k < kTurnSteps * kSectors; ++k, ++row) {
        integrals[bin_ring * kSectors + k / kTurnSteps] +=
            values[row] * area * weights[i] / weight_sum;
      }
    }
  }
  return integrals;
}

}  // namespace swell::test
