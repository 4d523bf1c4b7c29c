// Primaries and whites of colour spaces, and the matrices that follow from them.
#include "src/import/color_space.h"

#include <algorithm>

namespace swell {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // rows

struct Chromaticity {
  double x, y;
};

struct Space {
  Chromaticity red, green, blue, white;
};

constexpr Chromaticity kD65{0.3127, 0.3290};
// As pbrt-v4 has them: IEC 61966-2-1; SMPTE RP 431-2, with D65; ITU-R BT.2020; SMPTE ST 2065-1.
constexpr Space kSpaces[] = {
    {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65},
    {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65},
    {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65},
    {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}},
};

Vector Map(const Matrix& m, const Vector& v) {
  Vector out{};
  for (size_t r = 0; r < 3; ++r) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

Matrix Inverse(const Matrix& m) {
  const auto cofactor = [&](size_t r, size_t c) {
    const size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant =
      m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix inverse{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) inverse[c][r] = cofactor(r, c) / determinant;
  }
  return inverse;
}

Vector ToXyz(const Chromaticity& c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

// Primaries with the brightness that makes them the white together.
Matrix XyzFromRgb(const Space& space) {
  const Vector red{space.red.x, space.red.y, 1.0 - space.red.x - space.red.y};
  const Vector green{space.green.x, space.green.y, 1.0 - space.green.x - space.green.y};
  const Vector blue{space.blue.x, space.blue.y, 1.0 - space.blue.x - space.blue.y};
  Matrix m{};
  for (size_t r = 0; r < 3; ++r) m[r] = {red[r], green[r], blue[r]};
  const Vector share = Map(Inverse(m), ToXyz(space.white));
  for (Vector& row : m) {
    for (size_t c = 0; c < 3; ++c) row[c] *= share[c];
  }
  return m;
}

// What looks under `from` as `xyz` looks under `to` (Bradford; ICC.1:2010, annex E).
Vector Adapt(const Vector& xyz, const Vector& from, const Vector& to) {
  constexpr Matrix kCones{Vector{0.8951, 0.2664, -0.1614}, Vector{-0.7502, 1.7135, 0.0367},
                          Vector{0.0389, -0.0685, 1.0296}};
  const Vector before = Map(kCones, from), after = Map(kCones, to);
  Vector response = Map(kCones, xyz);
  for (size_t c = 0; c < 3; ++c) response[c] *= after[c] / before[c];
  return Map(Inverse(kCones), response);
}

}  // namespace

std::array<float, 3> ToSrgb(ColorSpaceName name, ColorUse use, const std::array<float, 3>& color) {
  if (name == ColorSpaceName::kSrgb) return color;
  const Space& space = kSpaces[static_cast<size_t>(name)];
  const Space& srgb = kSpaces[static_cast<size_t>(ColorSpaceName::kSrgb)];
  Vector xyz = Map(XyzFromRgb(space), {color[0], color[1], color[2]});
  if (use == ColorUse::kWeight) xyz = Adapt(xyz, ToXyz(space.white), ToXyz(srgb.white));
  const Vector rgb = Map(Inverse(XyzFromRgb(srgb)), xyz);
  std::array<float, 3> out{};
  for (size_t c = 0; c < 3; ++c) out[c] = static_cast<float>(std::max(rgb[c], 0.0));
  return out;
}

}  // namespace swell
