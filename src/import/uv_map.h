// Affine maps of texture coordinates: composed and inverted.
#ifndef SWELL_IMPORT_UV_MAP_H_
#define SWELL_IMPORT_UV_MAP_H_

#include <array>
#include <cmath>
#include <optional>

namespace swell {

// s = m[0] u + m[1] v + m[2], t = m[3] u + m[4] v + m[5].
struct UvMap {
  std::array<double, 6> m{1, 0, 0, 0, 1, 0};

  bool operator==(const UvMap& other) const { return m == other.m; }
};

// First `b`, then `a`.
inline UvMap operator*(const UvMap& a, const UvMap& b) {
  const auto &x = a.m, &y = b.m;
  return {{x[0] * y[0] + x[1] * y[3], x[0] * y[1] + x[1] * y[4], x[0] * y[2] + x[1] * y[5] + x[2],
           x[3] * y[0] + x[4] * y[3], x[3] * y[1] + x[4] * y[4], x[3] * y[2] + x[4] * y[5] + x[5]}};
}

// Nothing for a map onto a line or a point.
inline std::optional<UvMap> Inverse(const UvMap& map) {
  const auto& m = map.m;
  const double determinant = m[0] * m[4] - m[1] * m[3];
  const double size = std::hypot(m[0], m[1]) * std::hypot(m[3], m[4]);
  if (!std::isfinite(size) || !(std::abs(determinant) > 1e-9 * size)) return std::nullopt;
  return UvMap{{m[4] / determinant, -m[1] / determinant, (m[1] * m[5] - m[4] * m[2]) / determinant,
                -m[3] / determinant, m[0] / determinant,
                (m[3] * m[2] - m[0] * m[5]) / determinant}};
}

}  // namespace swell

#endif  // SWELL_IMPORT_UV_MAP_H_
