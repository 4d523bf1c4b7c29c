// Pixel filters along one axis in double precision, by pbrt-v4's definitions.
#ifndef SWELL_TESTS_REFERENCE_FILTER_H_
#define SWELL_TESTS_REFERENCE_FILTER_H_

#include <cmath>
#include <numbers>

#include "src/scene/scene.h"

namespace swell::reference {

// The filter at `x` pixels from the centre, not farther than its radius `r` along the axis.
inline double FilterValue(const Filter& f, double r, double x) {
  const double pi = std::numbers::pi;
  x = std::abs(x);
  switch (f.type) {
    case FilterType::kBox:
      return 1;
    case FilterType::kTriangle:
      return r - x;
    case FilterType::kGaussian:
      return std::exp(-x * x / (2 * f.a * f.a)) - std::exp(-r * r / (2 * f.a * f.a));
    case FilterType::kMitchell: {
      const double t = 2 * x / r, b = f.a, c = f.b;
      if (t <= 1)
        return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) /
               6;
      return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t +
              (8 * b + 24 * c)) /
             6;
    }
    case FilterType::kSinc: {
      if (x < 1e-9) return 1;
      const double y = x / f.a;
      return std::sin(pi * x) / (pi * x) * std::sin(pi * y) / (pi * y);
    }
  }
  return 0;
}

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_FILTER_H_
