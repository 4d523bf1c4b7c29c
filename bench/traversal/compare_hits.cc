// Rays and two engines in, their disagreements by reason out.
#include "bench/traversal/compare_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "bench/traversal/run.h"
#include "kernels/intersect_rays.h"
#include "src/stats/text_table.h"

namespace swell::bench {
namespace {

using Double3 = std::array<double, 3>;

Double3 operator-(const Double3& a, const Double3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double Dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double Length(const Double3& a) { return std::sqrt(Dot(a, a)); }
Double3 Cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct ExactRay {
  Double3 org, dir;
  double t_max;
};

// Where a ray crosses a triangle's plane, in world units.
struct Crossing {
  double along;      // the ray
  double inside;     // from the nearest edge; below zero: outside
  double tolerance;  // what single precision may be off
};

// 16 roundings of the largest coordinate, more where the ray grazes the plane.
constexpr double kTolerance = 16 * 0x1p-24;

std::array<Double3, 3> Corners(const Scene& scene, uint32_t prim) {
  std::array<Double3, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    const float* p = &scene.positions[3 * size_t{scene.indices[3 * size_t{prim} + i]}];
    corners[i] = {p[0], p[1], p[2]};
  }
  return corners;
}

Crossing Cross(const ExactRay& ray, const std::array<Double3, 3>& corners) {
  const Double3 normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double slope = Dot(normal, ray.dir);
  const double t = Dot(normal, corners[0] - ray.org) / slope;
  Double3 at;
  double largest = 0.0;
  for (size_t k = 0; k < 3; ++k) {
    at[k] = ray.org[k] + t * ray.dir[k];
    largest = std::max({largest, std::fabs(ray.org[k]), std::fabs(at[k])});
    for (const Double3& corner : corners) largest = std::max(largest, std::fabs(corner[k]));
  }
  double inside = INFINITY;
  for (size_t i = 0; i < 3; ++i) {
    const Double3 edge = corners[(i + 1) % 3] - corners[i];
    inside = std::min(inside,
                      Dot(Cross(edge, at - corners[i]), normal) / (Length(edge) * Length(normal)));
  }
  const double cosine = std::fabs(slope) / (Length(normal) * Length(ray.dir));
  return {t * Length(ray.dir), inside, kTolerance * largest / std::max(cosine, 1e-9)};
}

// Of two triangles, how many corners lie at the same place.
int SharedCorners(const std::array<Double3, 3>& a, const std::array<Double3, 3>& b) {
  int shared = 0;
  for (const Double3& corner : a) shared += std::find(b.begin(), b.end(), corner) != b.end();
  return shared;
}

// One engine's answer, seen in double precision.
struct Answer {
  bool hit = false;
  bool right = true;        // there is such a hit, or it cannot be told
  bool borderline = false;  // rounding may decide whether there is one
  bool on_edge = false;
  Crossing crossing{INFINITY, 0, 0};
};

Answer Check(const Scene& scene, const ExactRay& ray, const HitFields<Row>& hit) {
  Answer answer;
  if (hit.prim == kNoPrim) return answer;
  const double length = Length(ray.dir);
  const Crossing at = Cross(ray, Corners(scene, hit.prim));
  answer.hit = true;
  answer.crossing = at;
  // Not a number: a degenerate triangle, or a ray in its plane.
  answer.on_edge = !(std::fabs(at.inside) > at.tolerance);
  answer.borderline = answer.on_edge || std::fabs(at.along) <= at.tolerance ||
                      std::fabs(at.along - ray.t_max * length) <= at.tolerance;
  answer.right = !(at.inside < -at.tolerance) &&
                 !(std::fabs(at.along - double{hit.t} * length) > at.tolerance);
  return answer;
}

void Classify(const Scene& scene, const ExactRay& ray, const HitFields<Row>& ours,
              const HitFields<Row>& theirs, Differences& differences) {
  const Answer a = Check(scene, ray, ours), b = Check(scene, ray, theirs);
  if (a.hit && b.hit && ours.prim == theirs.prim && a.right && b.right) return;
  const double apart = std::fabs(a.crossing.along - b.crossing.along);
  const bool together = a.hit && b.hit && apart <= a.crossing.tolerance + b.crossing.tolerance;
  const Answer& nearer = a.crossing.along < b.crossing.along ? a : b;
  if (a.right && b.right && together) {
    const bool neighbours =
        SharedCorners(Corners(scene, ours.prim), Corners(scene, theirs.prim)) > 0;
    ++(neighbours && a.on_edge && b.on_edge ? differences.shared_edge : differences.coplanar);
  } else if (a.right && b.right && nearer.hit && nearer.borderline) {
    ++differences.below_rounding;  // only one engine has the nearer hit
  } else {
    const bool same = a.hit && ours.prim == theirs.prim;
    ++(same ? differences.distance : differences.other);
    if (!differences.example.empty()) return;
    differences.example =
        Format("swell %d at %.9g, exact %.9g; peer %d at %.9g, exact %.9g; inside by %.3g, %.3g",
               static_cast<int>(ours.prim), double{ours.t} * Length(ray.dir), a.crossing.along,
               static_cast<int>(theirs.prim), double{theirs.t} * Length(ray.dir), b.crossing.along,
               a.crossing.inside, b.crossing.inside);
  }
}

HitFields<Row> HitAt(const HitsIn& hits, size_t row) {
  return {hits.t[row], hits.prim[row], hits.u[row], hits.v[row], hits.instance[row]};
}

ExactRay ExactRayAt(const ShadowRaysIn& rays, size_t row) {
  return {{rays.org.x[row], rays.org.y[row], rays.org.z[row]},
          {rays.dir.x[row], rays.dir.y[row], rays.dir.z[row]},
          rays.t_max[row]};
}

// What an engine finds, all rows.
struct Answers {
  explicit Answers(size_t rows) : hits(rows), paths(rows) {}
  Table<HitFields> hits;
  Table<PathFields> paths;  // row for row: radiance 1 if the shadow ray is free
};

Answers TraceAll(const Engine& engine, size_t rows) {
  Answers answers(rows);
  for (size_t first = 0; first < rows; first += kMostRows) {
    engine.trace(first, std::min<size_t>(kMostRows, rows - first), answers.hits.Columns(first),
                 answers.paths.Columns(first).radiance);
  }
  return answers;
}

uint64_t RowsThatDiffer(const Answers& a, const Answers& b, size_t rows) {
  uint64_t count = 0;
  const auto a_hits = a.hits.Words(), b_hits = b.hits.Words();
  const PathsIn a_paths = a.paths.ReadColumns(), b_paths = b.paths.ReadColumns();
  for (size_t row = 0; row < rows; ++row) {
    bool differ = a_paths.radiance.r[row] != b_paths.radiance.r[row];
    for (size_t c = 0; c < a_hits.size(); ++c) differ |= a_hits[c][row] != b_hits[c][row];
    count += differ;
  }
  return count;
}

// Why an engine answers as it does at the rows of a set: its closest hits, and for shadow rays what
// its closest-hit query finds within t_max where its any-hit query found something.
std::vector<HitFields<Row>> HitsAt(const std::vector<uint32_t>& rows, const RaySet& set,
                                   const Answers& answers, const Answers& closest) {
  std::vector<HitFields<Row>> hits;
  const float* free = answers.paths.ReadColumns().radiance.r;
  const float* t_max = set.rays.ReadColumns().t_max;
  for (size_t i = 0; i < rows.size(); ++i) {
    HitFields<Row> hit = set.shadow() ? HitAt(closest.hits.ReadColumns(), i)
                                      : HitAt(answers.hits.ReadColumns(), rows[i]);
    const bool none = set.shadow() && (free[rows[i]] != 0.0f || !(hit.t <= t_max[rows[i]]));
    if (none) hit = {INFINITY, kNoPrim, 0, 0, kNone};
    hits.push_back(hit);
  }
  return hits;
}

RaySet Subset(const RaySet& set, const std::vector<uint32_t>& rows, const RaySetSpec& spec) {
  RaySet subset{&spec, static_cast<uint32_t>(rows.size()), Table<ShadowRayFields>(rows.size())};
  const auto from = set.rays.Words(), to = subset.rays.Words();
  for (size_t c = 0; c < from.size(); ++c) {
    for (size_t i = 0; i < rows.size(); ++i) to[c][i] = from[c][rows[i]];
  }
  return subset;
}

}  // namespace

Differences CompareHits(const Scene& scene, const RaySet& set, const Bvh& bvh,
                        const PeerScene& robust) {
  Differences differences;
  differences.rows = set.rows;
  const Answers ours = TraceAll(SwellEngine(set, bvh, Traversal::kAuto, ""), set.rows);
  for (const NamedTraversal& fixed : kFixedTraversals) {
    const Answers again = TraceAll(SwellEngine(set, bvh, fixed.traversal, ""), set.rows);
    differences.traversals_differ += RowsThatDiffer(ours, again, set.rows);
  }
  const Answers theirs = TraceAll(PeerEngine(set, robust, 0, ""), set.rows);

  std::vector<uint32_t> rows;
  const HitsIn a = ours.hits.ReadColumns(), b = theirs.hits.ReadColumns();
  const float* a_free = ours.paths.ReadColumns().radiance.r;
  const float* b_free = theirs.paths.ReadColumns().radiance.r;
  for (uint32_t row = 0; row < set.rows; ++row) {
    // Distances that differ more than rounding explains are differences too.
    const bool far_apart = std::fabs(a.t[row] - b.t[row]) > 1e-4f * a.t[row];
    if (a.prim[row] != b.prim[row] || a_free[row] != b_free[row] || far_apart) rows.push_back(row);
  }
  constexpr RaySetSpec kDiffering{"", "", Stage::kIntersect, 1};
  const RaySet differing = Subset(set, rows, kDiffering);
  const auto our_hits = HitsAt(
      rows, set, ours, TraceAll(SwellEngine(differing, bvh, Traversal::kAuto, ""), differing.rows));
  const auto their_hits =
      HitsAt(rows, set, theirs, TraceAll(PeerEngine(differing, robust, 0, ""), differing.rows));
  for (size_t i = 0; i < rows.size(); ++i) {
    Classify(scene, ExactRayAt(differing.rays.ReadColumns(), i), our_hits[i], their_hits[i],
             differences);
  }
  return differences;
}

}  // namespace swell::bench
