// Points and directions one at a time, in long double: the arithmetic of the references.
#ifndef SWELL_TESTS_REFERENCE_VECTOR_H_
#define SWELL_TESTS_REFERENCE_VECTOR_H_

#include <cmath>

namespace swell::reference {

using Real = long double;
inline constexpr Real kPi = 3.14159265358979323846264338327950288L;

struct Vector {
  Real x = 0, y = 0, z = 0;

  Vector operator+(const Vector& v) const { return {x + v.x, y + v.y, z + v.z}; }
  Vector operator-(const Vector& v) const { return {x - v.x, y - v.y, z - v.z}; }
  Vector operator*(Real s) const { return {x * s, y * s, z * s}; }
};
inline Real Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector Cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real Length(const Vector& a) { return std::sqrt(Dot(a, a)); }
inline Vector Normalize(const Vector& a) { return a * (1 / Length(a)); }

// Row-major 3x4 times a point, and times a vector.
inline Vector TransformVector(const float* m, const Vector& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
          m[8] * v.x + m[9] * v.y + m[10] * v.z};
}
inline Vector TransformPoint(const float* m, const Vector& p) {
  return TransformVector(m, p) + Vector{m[3], m[7], m[11]};
}
// A normal by the transpose of the inverse map.
inline Vector TransformNormal(const float* inverse, const Vector& n) {
  return {inverse[0] * n.x + inverse[4] * n.y + inverse[8] * n.z,
          inverse[1] * n.x + inverse[5] * n.y + inverse[9] * n.z,
          inverse[2] * n.x + inverse[6] * n.y + inverse[10] * n.z};
}

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_VECTOR_H_
