// From counts and expectations to a p-value, and the sphere cut into bins around a direction.
#ifndef SWELL_TESTS_MATERIALS_STATISTICS_H_
#define SWELL_TESTS_MATERIALS_STATISTICS_H_

#include <functional>
#include <vector>

#include "tests/materials/material_support.h"

namespace swell::test {

// Probability that a chi-square variable of that many degrees of freedom exceeds x.
double ChiSquareTail(double x, double degrees_of_freedom);

// Pearson's test; bins that expect fewer than 5 are pooled.
double ChiSquarePValue(const std::vector<double>& observed, const std::vector<double>& expected);

// Each of `tests` p-values may fall below this so that all hold with probability 1 - alpha (Sidak).
double SidakThreshold(double alpha, size_t tests);

// A ring around the pole at which a density grows without bound, and how far rounding spreads it.
struct Rim {
  double sin2 = 0.0;  // squared sine of the angle to the pole; 0: none
  double blur = 0.0;  // of sin2
};

// The sphere in rings around `pole`, geometrically finer towards it, and sectors. Lobes of any
// width around the pole get many bins.
class SphereBins {
 public:
  // The rim's outer edge becomes an edge of bins; towards it the quadrature is refined.
  SphereBins(const Direction& pole, const Rim& rim);
  size_t count() const { return (edges_.size() - 1) * kSectors; }
  size_t Find(const Direction& d) const;
  // Integral over each bin of a function given by many directions at once.
  using Function = std::function<std::vector<float>(const Directions&, size_t count)>;
  std::vector<double> Integrate(const Function& f) const;

 private:
  static constexpr size_t kSectors = 8;
  Direction pole_, tangent_, bitangent_;
  std::vector<double> edges_;   // of 1 - cosine, ascending from 0 to 2
  std::vector<double> splits_;  // likewise: the edges, and the quadrature's finer rings
};

}  // namespace swell::test

#endif  // SWELL_TESTS_MATERIALS_STATISTICS_H_
