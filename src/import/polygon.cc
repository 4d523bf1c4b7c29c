// Polygons to triangles by ear clipping in the plane that the polygon faces most.
#include "src/import/polygon.h"

#include <cmath>

namespace swell {
namespace {

// Tests of a corner against a triangle, for each corner: bounds what a hostile polygon costs.
constexpr uint64_t kTestsPerCorner = 1000;

struct Point2 {
  double x, y;
};

// Twice the area of a triangle, above 0 if it winds to the left.
double Turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon without the axis along which its normal (Newell's) is longest, winding to the left.
// Empty if it has no normal.
std::vector<Point2> Flatten(std::span<const std::array<float, 3>> points) {
  double normal[3] = {0, 0, 0};
  const std::array<float, 3>& origin = points[0];
  for (size_t i = 0; i < points.size(); ++i) {
    const std::array<float, 3>&p = points[i], &q = points[(i + 1) % points.size()];
    for (size_t k = 0; k < 3; ++k) {
      const size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double pa = double{p[a]} - origin[a], pb = double{p[b]} - origin[b];
      normal[k] += pa * (double{q[b]} - origin[b]) - pb * (double{q[a]} - origin[a]);
    }
  }
  size_t axis = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  if (!(std::abs(normal[axis]) > 0.0) || !std::isfinite(normal[axis])) return {};
  const size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
  std::vector<Point2> flat;
  flat.reserve(points.size());
  for (const std::array<float, 3>& p : points) flat.push_back({sign * p[x], double{p[y]}});
  return flat;
}

bool IsConvex(const std::vector<Point2>& points) {
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i) {
    if (Turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0.0) return false;
  }
  return true;
}

// A ring of the corners that are left.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point2>& points)
      : points_(points),
        left_(static_cast<uint32_t>(points.size())),
        tests_left_(kTestsPerCorner * points.size()),
        gone_(points.size(), false) {
    for (uint32_t i = 0; i < left_; ++i) {
      before_.push_back((i + left_ - 1) % left_);
      after_.push_back((i + 1) % left_);
    }
    for (uint32_t i = 0; i < left_; ++i) {
      if (!TurnsLeft(i)) reflex_.push_back(i);
    }
  }

  void Clip(std::vector<uint32_t>* corners) {
    uint32_t at = 0;
    uint32_t passed = 0;  // corners since the last ear
    while (left_ > 2) {
      if (passed < left_ && !IsEar(at)) {
        at = after_[at];
        ++passed;
        continue;
      }
      corners->insert(corners->end(), {before_[at], at, after_[at]});
      after_[before_[at]] = after_[at];
      before_[after_[at]] = before_[at];
      gone_[at] = true;
      at = after_[at];
      --left_;
      passed = 0;
    }
  }

 private:
  bool TurnsLeft(uint32_t i) const {
    return Turn(points_[before_[i]], points_[i], points_[after_[i]]) > 0.0;
  }

  bool IsEar(uint32_t i) {
    if (tests_left_ == 0) return true;
    if (!TurnsLeft(i)) return false;
    const Point2 a = points_[before_[i]], b = points_[i], c = points_[after_[i]];
    for (const uint32_t other : reflex_) {
      if (tests_left_ == 0) return true;
      --tests_left_;
      if (gone_[other] || TurnsLeft(other)) continue;
      const Point2& p = points_[other];
      const auto same = [&p](const Point2& q) { return p.x == q.x && p.y == q.y; };
      if (same(a) || same(b) || same(c)) continue;
      if (Turn(a, b, p) >= 0.0 && Turn(b, c, p) >= 0.0 && Turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  const std::vector<Point2>& points_;
  uint32_t left_;
  uint64_t tests_left_;
  std::vector<uint32_t> before_, after_;
  std::vector<bool> gone_;
  std::vector<uint32_t> reflex_;  // corners that did not turn left at first
};

}  // namespace

void Triangulate(std::span<const std::array<float, 3>> points, std::vector<uint32_t>* corners) {
  if (points.size() < 3) return;
  std::vector<Point2> flat;
  if (points.size() > 3) flat = Flatten(points);
  if (!flat.empty() && !IsConvex(flat)) return EarClipper(flat).Clip(corners);
  for (uint32_t i = 2; i < points.size(); ++i) corners->insert(corners->end(), {0, i - 1, i});
}

}  // namespace swell
