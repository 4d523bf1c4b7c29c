// Lights -> boxes and cones, and their unions.
#include "src/scene/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swell {
namespace {

using Vector = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double Angle(const Vector& a, const Vector& b) { return std::acos(std::clamp(Dot(a, b), -1., 1.)); }

// `from` turned by `angle` towards `to`; both unit, neither equal nor opposite.
Vector Turned(const Vector& from, const Vector& to, double angle) {
  const double cosine = Dot(from, to);
  Vector across;
  for (int i = 0; i < 3; ++i) across[i] = to[i] - cosine * from[i];
  const double length = std::sqrt(Dot(across, across));
  Vector turned;
  for (int i = 0; i < 3; ++i) {
    turned[i] = std::cos(angle) * from[i] + std::sin(angle) * across[i] / length;
  }
  return turned;
}

// The cone around both, algorithm 1 of the paper: a.theta_o is the larger one.
void JoinCones(const LightBounds& a, const LightBounds& b, LightBounds& joint) {
  joint.axis = a.axis;
  joint.theta_e = std::max(a.theta_e, b.theta_e);
  const double between = Angle(a.axis, b.axis);
  if (std::min(between + b.theta_o, kPi) <= a.theta_o) {
    joint.theta_o = a.theta_o;
    return;
  }
  const double theta_o = (a.theta_o + between + b.theta_o) / 2;
  const double turn = theta_o - a.theta_o;
  if (theta_o >= kPi || kPi - between < 1e-6) {
    joint.theta_o = kPi;
    return;
  }
  joint.theta_o = theta_o;
  if (between > 1e-9) joint.axis = Turned(a.axis, b.axis, turn);
}

void AddPoint(Bounds& box, const Vector& p) {
  for (size_t i = 0; i < 3; ++i) box.Add(i, p[i], p[i]);
}

Vector ToVector(const float* v) { return {v[0], v[1], v[2]}; }

void BoundTriangle(const LightRecord& light, double level, LightBounds& bounds) {
  const Vector p = ToVector(light.p), e1 = ToVector(light.e1), e2 = ToVector(light.e2);
  AddPoint(bounds.box, p);
  AddPoint(bounds.box, {p[0] + e1[0], p[1] + e1[1], p[2] + e1[2]});
  AddPoint(bounds.box, {p[0] + e2[0], p[1] + e2[1], p[2] + e2[2]});
  bounds.axis = ToVector(light.n);
  if (!(Dot(bounds.axis, bounds.axis) > 0.5)) bounds.axis = {0, 0, 1};  // no area: not a number
  bounds.theta_o = 0;
  bounds.intensity = level * light.area;
}

// A convex body's mean shadow is a quarter of its surface (Cauchy).
void BoundSphere(const SphereRecord& sphere, double level, LightBounds& bounds) {
  const float* m = sphere.object_to_world;
  Vector half{};
  double product = 1;
  for (size_t i = 0; i < 3; ++i) {
    half[i] = std::hypot(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    bounds.box.Add(i, m[4 * i + 3] - half[i], m[4 * i + 3] + half[i]);
    product *= std::hypot(m[i], m[4 + i], m[8 + i]);
  }
  bounds.intensity = level * kPi * std::pow(product, 2.0 / 3.0);
}

}  // namespace

LightBounds Union(const LightBounds& a, const LightBounds& b) {
  if (a.box.empty()) return b;
  LightBounds joint;
  joint.box = a.box;
  for (size_t i = 0; i < 3; ++i) joint.box.Add(i, b.box.low[i], b.box.high[i]);
  if (a.theta_o >= b.theta_o) {
    JoinCones(a, b, joint);
  } else {
    JoinCones(b, a, joint);
  }
  joint.intensity = a.intensity + b.intensity;
  joint.two_sided = a.two_sided || b.two_sided;
  return joint;
}

double OrientationMeasure(const LightBounds& b) {
  const double o = b.theta_o, w = std::min(o + b.theta_e, kPi);
  return 2 * kPi * (1 - std::cos(o)) +
         kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

LightBounds BoundsOf(const Scene& scene, const LightRecord& light, double level) {
  LightBounds bounds;
  bounds.theta_o = kPi;
  bounds.theta_e = kPi / 2;
  bounds.two_sided = (light.flags & kLightTwoSided) != 0;
  bounds.intensity = level;
  switch (light.type) {
    case kTriangleLight:
      BoundTriangle(light, level, bounds);
      break;
    case kSphereLight:
    case kEllipsoidLight:
      BoundSphere(scene.spheres[light.sphere], level, bounds);
      break;
    case kSpotLight:
      bounds.axis = ToVector(light.n);
      bounds.theta_o = std::acos(std::clamp<double>(light.e1[0], -1, 1));
      bounds.theta_e =
          std::min(kPi / 2, std::acos(std::clamp<double>(light.e1[1], -1, 1)) - bounds.theta_o);
      [[fallthrough]];
    default:
      AddPoint(bounds.box, ToVector(light.p));
  }
  return bounds;
}

}  // namespace swell
