// Cubic curves with a width -> tubes and ribbons of triangles.
#ifndef SWELL_IMPORT_CURVES_H_
#define SWELL_IMPORT_CURVES_H_

#include <array>
#include <vector>

#include "src/import/shapes.h"

namespace swell {

// A Bezier segment with its widths and, for ribbons, its normals at both ends.
struct CurveSegment {
  std::array<Point, 4> points;
  std::array<double, 2> widths;
  std::array<Point, 2> normals{};
};

struct Curve {
  std::vector<CurveSegment> segments;  // each begins where the one before it ends
  bool ribbon = false;                 // else a tube without ends
};

inline constexpr double kCurveTolerance = 0.02;  // from curve to chord, in widths
inline constexpr uint32_t kMaxCurveSteps = 256;  // of a segment

// Chords are as many as keep them within kCurveTolerance of the curve. A tube has the mean width
// that it should; u runs along the curve, v across it.
void AddCurve(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
              const Curve& curve);

}  // namespace swell

#endif  // SWELL_IMPORT_CURVES_H_
