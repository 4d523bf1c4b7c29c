// Affine maps of the transform stack, in double precision.
#ifndef SWELL_IMPORT_TRANSFORM_H_
#define SWELL_IMPORT_TRANSFORM_H_

#include <array>
#include <optional>

#include "src/scene/scene.h"

namespace swell {

using Point = std::array<double, 3>;

// Row-major 3x4: x' = m[0] x + m[1] y + m[2] z + m[3].
struct Transform {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

// First `b`, then `a`.
Transform operator*(const Transform& a, const Transform& b);

Transform Translate(double x, double y, double z);
Transform Scale(double x, double y, double z);
// Right-handed about the axis, which must not be zero.
Transform Rotate(double degrees, const Point& axis);
// World to camera: the camera at `eye` looks along +z at `target`, +y is up and +x right of that.
// Nothing if the directions do not span a frame.
std::optional<Transform> LookAt(const Point& eye, const Point& target, const Point& up);

Point MapPoint(const Transform& t, const Point& p);
Point MapVector(const Transform& t, const Point& v);

// The matrix of cofactors of the linear part maps normals (times the determinant's sign) and
// scales areas: |cofactors * n| is the area of the image of a unit square facing n.
std::array<double, 9> Cofactors(const Transform& t);
double Determinant(const Transform& t);

// Nothing for a singular map: one whose determinant is lost in rounding.
std::optional<Transform> Inverse(const Transform& t);

Affine ToAffine(const Transform& t);

double Dot(const Point& a, const Point& b);
Point Cross(const Point& a, const Point& b);
std::optional<Point> Normalized(const Point& v);  // nothing for zero

}  // namespace swell

#endif  // SWELL_IMPORT_TRANSFORM_H_
