// Bezier curves and B-splines of degree 2 and 3 -> cubic Bezier segments.
#include "src/import/read_curve.h"

#include <algorithm>
#include <vector>

#include "src/base/suggest.h"
#include "src/import/append_mesh.h"
#include "src/import/curves.h"

namespace swell {
namespace {

// The weighted mean of control points from `first` on.
Point Blend(const std::vector<float>& points, size_t first, const std::array<double, 4>& weights) {
  Point sum{};
  for (size_t i = 0; i < 4; ++i) {
    if (weights[i] == 0.0) continue;
    const Point p = Row3(points, first + i);
    for (size_t c = 0; c < 3; ++c) sum[c] += weights[i] * p[c];
  }
  return sum;
}

using Weights = std::array<std::array<double, 4>, 4>;  // of each point of a cubic Bezier segment

// The uniform B-spline's are by knot insertion (W. Boehm), the quadratics' by raising the degree.
constexpr Weights kCubicBezier{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
constexpr Weights kQuadraticBezier{
    {{1, 0, 0, 0}, {1 / 3.0, 2 / 3.0, 0, 0}, {0, 2 / 3.0, 1 / 3.0, 0}, {0, 0, 1, 0}}};
constexpr Weights kCubicSpline{{{1 / 6.0, 4 / 6.0, 1 / 6.0, 0},
                                {0, 4 / 6.0, 2 / 6.0, 0},
                                {0, 2 / 6.0, 4 / 6.0, 0},
                                {0, 1 / 6.0, 4 / 6.0, 1 / 6.0}}};
constexpr Weights kQuadraticSpline{{{1 / 2.0, 1 / 2.0, 0, 0},
                                    {1 / 6.0, 5 / 6.0, 0, 0},
                                    {0, 5 / 6.0, 1 / 6.0, 0},
                                    {0, 1 / 2.0, 1 / 2.0, 0}}};

bool ReadWord(Parameters& parameters, std::string_view name,
              const std::vector<std::string_view>& known, std::string* word) {
  *word = parameters.String(name, known.front());
  if (parameters.failed()) return false;
  if (std::find(known.begin(), known.end(), *word) != known.end()) return true;
  parameters.Fail(parameters.Any(name)->place,
                  "unknown " + std::string(name) + " " + Quote(*word) + KnownWords(*word, known));
  return false;
}

// A normal where each segment meets the next, and at both ends.
void ReadNormals(Parameters& parameters, Curve* curve) {
  const Parameter* normals = parameters.Floats("N", {"normal", "normal3"}, 3);
  if (parameters.failed()) return;
  const size_t needed = curve->segments.size() + 1;
  if (!curve->ribbon) {
    if (normals != nullptr) parameters.Warn(normals->place, "\"N\" is for ribbons; it is ignored");
    return;
  }
  if (normals == nullptr || normals->floats.size() != 3 * needed) {
    return parameters.Fail(normals == nullptr ? parameters.place() : normals->place,
                           "a ribbon of " + std::to_string(curve->segments.size()) +
                               " segments needs \"normal N\" with " + std::to_string(needed) +
                               " normals");
  }
  for (size_t i = 0; i < curve->segments.size(); ++i) {
    curve->segments[i].normals = {Row3(normals->floats, i), Row3(normals->floats, i + 1)};
  }
}

}  // namespace

void ReadCurve(Parameters& parameters, const Placement& placement, Scene* scene) {
  std::string type, basis;
  if (!ReadWord(parameters, "type", {"flat", "cylinder", "ribbon"}, &type)) return;
  if (!ReadWord(parameters, "basis", {"bezier", "bspline"}, &basis)) return;
  const int32_t degree = parameters.IntWithin("degree", 3, 2, 3);
  const float width = parameters.FloatWithin("width", 1.0f, 0.0f, 1e30f);
  const float width0 = parameters.FloatWithin("width0", width, 0.0f, 1e30f);
  const float width1 = parameters.FloatWithin("width1", width, 0.0f, 1e30f);
  const Parameter* points = parameters.Floats("P", {"point3", "point"}, 3);
  parameters.Accept({"splitdepth"});
  if (parameters.failed()) return;
  if (points == nullptr) return parameters.Fail(placement.place, "\"point3 P\" is missing");
  const size_t count = points->floats.size() / 3, order = static_cast<size_t>(degree);
  const bool spline = basis == "bspline";
  const size_t step = spline ? 1 : order;
  if (count < order + 1 || (count - 1 - order) % step != 0) {
    return parameters.Fail(points->place,
                           "a " + basis + " curve of degree " + std::to_string(degree) + " has " +
                               std::to_string(order + 1) + " points and " + std::to_string(step) +
                               " more a segment, not " + std::to_string(count));
  }
  const Weights& weights = spline ? (degree == 3 ? kCubicSpline : kQuadraticSpline)
                                  : (degree == 3 ? kCubicBezier : kQuadraticBezier);
  Curve curve;
  curve.ribbon = type == "ribbon";
  const size_t segments = (count - 1 - order) / step + 1;
  for (size_t k = 0; k < segments; ++k) {
    CurveSegment segment;
    for (size_t i = 0; i < 4; ++i) segment.points[i] = Blend(points->floats, k * step, weights[i]);
    for (size_t i = 0; i < 2; ++i) {
      const double t = static_cast<double>(k + i) / static_cast<double>(segments);
      segment.widths[i] = (1.0 - t) * width0 + t * width1;
    }
    curve.segments.push_back(segment);
  }
  ReadNormals(parameters, &curve);
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  if (type == "flat") {
    parameters.Warn(placement.place, "a flat curve, which faces every ray, is rendered as a tube");
  }
  AddCurve(*scene, *parameters.diagnostics(), placement, curve);
}

}  // namespace swell
