// The arithmetic of affine maps for importers.
#include "src/import/transform.h"

#include <algorithm>
#include <cmath>

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Relative to the product of the column lengths; below this the columns lie in a plane.
constexpr double kSingular = 1e-13;

double Length(const Point& v) { return std::sqrt(Dot(v, v)); }

Point Column(const Transform& t, int c) {
  const size_t i = static_cast<size_t>(c);
  return {t.m[i], t.m[4 + i], t.m[8 + i]};
}

}  // namespace

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::optional<Point> Normalized(const Point& v) {
  const double length = Length(v);
  if (!(length > 0.0)) return std::nullopt;
  return Point{v[0] / length, v[1] / length, v[2] / length};
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform product;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 4; ++col) {
      double sum = col == 3 ? a.m[4 * row + 3] : 0.0;
      for (size_t k = 0; k < 3; ++k) sum += a.m[4 * row + k] * b.m[4 * k + col];
      product.m[4 * row + col] = sum;
    }
  }
  return product;
}

Transform Translate(double x, double y, double z) { return {{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}}; }

Transform Scale(double x, double y, double z) { return {{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0}}; }

Transform Rotate(double degrees, const Point& axis) {
  const Point a = *Normalized(axis);
  // Quarter turns are exact, so that axis-aligned scenes stay aligned.
  double s = std::sin(degrees * kPi / 180.0), c = std::cos(degrees * kPi / 180.0);
  if (std::fmod(degrees, 90.0) == 0.0) {
    s = std::round(s);
    c = std::round(c);
  }
  const double x = a[0], y = a[1], z = a[2], k = 1.0 - c;
  return {{k * x * x + c, k * x * y - s * z, k * x * z + s * y, 0,  //
           k * x * y + s * z, k * y * y + c, k * y * z - s * x, 0,  //
           k * x * z - s * y, k * y * z + s * x, k * z * z + c, 0}};
}

std::optional<Transform> LookAt(const Point& eye, const Point& target, const Point& up) {
  const auto forward = Normalized({target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]});
  const auto unit_up = Normalized(up);
  if (!forward || !unit_up) return std::nullopt;
  const Point side = Cross(*unit_up, *forward);
  if (Length(side) < 1e-10) return std::nullopt;
  const Point right = *Normalized(side);
  const Point true_up = Cross(*forward, right);
  const Transform camera_to_world{{right[0], true_up[0], (*forward)[0], eye[0],  //
                                   right[1], true_up[1], (*forward)[1], eye[1],  //
                                   right[2], true_up[2], (*forward)[2], eye[2]}};
  return Inverse(camera_to_world);
}

Point MapPoint(const Transform& t, const Point& p) {
  const Point v = MapVector(t, p);
  return {v[0] + t.m[3], v[1] + t.m[7], v[2] + t.m[11]};
}

Point MapVector(const Transform& t, const Point& v) {
  return {t.m[0] * v[0] + t.m[1] * v[1] + t.m[2] * v[2],
          t.m[4] * v[0] + t.m[5] * v[1] + t.m[6] * v[2],
          t.m[8] * v[0] + t.m[9] * v[1] + t.m[10] * v[2]};
}

std::array<double, 9> Cofactors(const Transform& t) {
  const Point x = Column(t, 0), y = Column(t, 1), z = Column(t, 2);
  const Point a = Cross(y, z), b = Cross(z, x), c = Cross(x, y);
  return {a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2]};
}

double Determinant(const Transform& t) {
  return Dot(Column(t, 0), Cross(Column(t, 1), Column(t, 2)));
}

std::optional<Transform> Inverse(const Transform& t) {
  const double det = Determinant(t);
  const double volume = Length(Column(t, 0)) * Length(Column(t, 1)) * Length(Column(t, 2));
  if (!std::isfinite(volume) || !(std::abs(det) > kSingular * volume)) return std::nullopt;
  const std::array<double, 9> c = Cofactors(t);
  Transform inverse;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 3; ++col) inverse.m[4 * row + col] = c[3 * col + row] / det;
  }
  const Point origin = MapVector(inverse, Column(t, 3));
  for (size_t row = 0; row < 3; ++row) inverse.m[4 * row + 3] = -origin[row];
  for (double value : inverse.m) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return inverse;
}

Affine ToAffine(const Transform& t) {
  Affine affine{};
  std::transform(t.m.begin(), t.m.end(), affine.begin(),
                 [](double value) { return static_cast<float>(value); });
  return affine;
}

}  // namespace swell
