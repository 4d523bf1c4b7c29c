// Rows of points along curves: rings of tubes, pairs of ribbons.
#include "src/import/curves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/import/append_mesh.h"

namespace swell {
namespace {

constexpr uint32_t kTubeSides = 8;
constexpr double kMaxTwist = 10.0 * kPi / 180.0;  // of a ribbon, from chord to chord

Point Combine(double a, const Point& p, double b, const Point& q) {
  return {a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]};
}

double Length(const Point& p) { return std::sqrt(Dot(p, p)); }

Point PointAt(const CurveSegment& s, double t) {
  const double r = 1.0 - t;
  return Combine(1.0, Combine(r * r * r, s.points[0], 3.0 * r * r * t, s.points[1]), 1.0,
                 Combine(3.0 * r * t * t, s.points[2], t * t * t, s.points[3]));
}

// Nothing where the control points coincide.
std::optional<Point> TangentAt(const CurveSegment& s, double t) {
  const double r = 1.0 - t;
  const Point a = Minus(s.points[1], s.points[0]), b = Minus(s.points[2], s.points[1]),
              c = Minus(s.points[3], s.points[2]);
  const Point sum = Combine(1.0, Combine(r * r, a, 2.0 * r * t, b), t * t, c);
  const Point chord = Minus(s.points[3], s.points[0]);
  // Handles of no length leave the derivative 0 at the ends: there the chord leads.
  return Normalized(Length(sum) > 1e-9 * Length(chord) ? sum : chord);
}

double AngleBetween(const Point& a, const Point& b) {
  const double lengths = Length(a) * Length(b);
  return lengths > 0.0 ? std::acos(std::clamp(Dot(a, b) / lengths, -1.0, 1.0)) : 0.0;
}

// n chords are within d2 / (8 n^2) of a curve whose second derivative is at most d2.
uint32_t StepsOf(const CurveSegment& s, bool ribbon) {
  double bend = 0.0;
  for (size_t i = 0; i < 2; ++i) {
    const Point second = Combine(1.0, Minus(s.points[i], s.points[i + 1]), 1.0,
                                 Minus(s.points[i + 2], s.points[i + 1]));
    bend = std::max(bend, 6.0 * Length(second));
  }
  const double width = std::max(s.widths[0], s.widths[1]);
  double steps = width > 0.0 ? std::sqrt(bend / (8.0 * kCurveTolerance * width)) : 1.0;
  if (ribbon) steps = std::max(steps, AngleBetween(s.normals[0], s.normals[1]) / kMaxTwist);
  return static_cast<uint32_t>(std::clamp(std::ceil(steps), 1.0, double{kMaxCurveSteps}));
}

Point Slerp(const Point& a, const Point& b, double t) {
  const double angle = AngleBetween(a, b);
  if (angle < 1e-4 || angle > kPi - 1e-4) return Combine(1.0 - t, a, t, b);
  return Combine(std::sin((1.0 - t) * angle) / std::sin(angle), a,
                 std::sin(t * angle) / std::sin(angle), b);
}

// A direction across the tangent that turns as little as it can from the one before.
Point Across(const Point& tangent, const Point& before) {
  const auto kept = Normalized(Combine(1.0, before, -Dot(before, tangent), tangent));
  if (kept && Length(Combine(1.0, before, -Dot(before, tangent), tangent)) > 1e-6) return *kept;
  const bool x_is_least =
      std::abs(tangent[0]) <= std::min(std::abs(tangent[1]), std::abs(tangent[2]));
  const Point axis = x_is_least                                     ? Point{1, 0, 0}
                     : std::abs(tangent[1]) <= std::abs(tangent[2]) ? Point{0, 1, 0}
                                                                    : Point{0, 0, 1};
  return *Normalized(Cross(tangent, axis));
}

class CurveMesh {
 public:
  CurveMesh(Scene* scene, bool ribbon) : scene_(*scene), ribbon_(ribbon) {}

  // `normal` matters to ribbons.
  void AddRow(const Point& p, const Point& tangent, double width, const Point& normal, double u) {
    const auto row = static_cast<uint32_t>(scene_.positions.size() / 3);
    across_ = Across(tangent, ribbon_ ? Cross(normal, tangent) : across_);
    const Point up = Cross(across_, tangent);
    const uint32_t columns = ribbon_ ? 2 : kTubeSides + 1;
    // Corners stand out as far as gives the polygon the circle's mean width.
    const double stretch = (kPi / kTubeSides) / std::sin(kPi / kTubeSides);
    for (uint32_t i = 0; i < columns; ++i) {
      const double v = static_cast<double>(i) / (columns - 1);
      const double angle = 2.0 * kPi * v;
      const Point out = ribbon_ ? across_ : Combine(std::cos(angle), across_, std::sin(angle), up);
      const double reach = ribbon_ ? (v - 0.5) * width : 0.5 * width * stretch;
      AppendPoint(&scene_.positions, Combine(1.0, p, reach, out));
      AppendPoint(&scene_.normals, ribbon_ ? Cross(tangent, across_) : out);
      scene_.uvs.insert(scene_.uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
      if (row_ == kNone || i == 0) continue;
      const uint32_t a = row_ + i - 1, b = row + i - 1;
      scene_.indices.insert(scene_.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
    row_ = row;
  }

 private:
  Scene& scene_;
  bool ribbon_;
  Point across_{1, 0, 0};
  uint32_t row_ = kNone;  // where the last row starts; kNone: there is none
};

}  // namespace

void AddCurve(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
              const Curve& curve) {
  const MeshStart start = BeginMesh(scene);
  CurveMesh mesh(&scene, curve.ribbon);
  const auto count = static_cast<double>(curve.segments.size());
  std::optional<Point> tangent;
  for (size_t k = 0; k < curve.segments.size(); ++k) {
    const CurveSegment& s = curve.segments[k];
    const uint32_t steps = StepsOf(s, curve.ribbon);
    for (uint32_t i = k == 0 ? 0 : 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      if (const auto here = TangentAt(s, t)) tangent = here;
      if (!tangent) continue;
      mesh.AddRow(PointAt(s, t), *tangent, (1.0 - t) * s.widths[0] + t * s.widths[1],
                  Slerp(s.normals[0], s.normals[1], t), (static_cast<double>(k) + t) / count);
    }
  }
  AppendMesh(scene, diagnostics, placement, start, 1.0);
}

}  // namespace swell
