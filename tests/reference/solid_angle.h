// A point and a triangle in, the solid angle in which the point sees it out: by Girard's theorem.
#ifndef SWELL_TESTS_REFERENCE_SOLID_ANGLE_H_
#define SWELL_TESTS_REFERENCE_SOLID_ANGLE_H_

#include "kernels/scene_view.h"
#include "tests/reference/vector.h"

namespace swell::reference {

// The angle at a between the planes through a, b and a, c.
inline Real AngleAt(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = Cross(a, b), ac = Cross(a, c);
  return std::atan2(Length(Cross(ab, ac)), Dot(ab, ac));
}

inline Real SolidAngle(const Vector& from, const Vector& p0, const Vector& p1, const Vector& p2) {
  const Vector a = p0 - from, b = p1 - from, c = p2 - from;
  return AngleAt(a, b, c) + AngleAt(b, c, a) + AngleAt(c, a, b) - kPi;
}

// Of a triangle light.
inline Real SolidAngle(const Vector& from, const LightRecord& light) {
  const Vector p{light.p[0], light.p[1], light.p[2]};
  return SolidAngle(from, p, p + Vector{light.e1[0], light.e1[1], light.e1[2]},
                    p + Vector{light.e2[0], light.e2[1], light.e2[2]});
}

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_SOLID_ANGLE_H_
