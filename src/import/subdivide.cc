// Loop's subdivision (C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987), with
// Warren's weights, and its limit points and tangents (H. Hoppe et al., "Piecewise Smooth Surface
// Reconstruction", 1994), creases along boundaries.
#include "src/import/subdivide.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace swell {
namespace {

using Face = std::array<uint32_t, 3>;

void AddScaled(double s, const Point& p, Point* sum) {
  for (size_t c = 0; c < 3; ++c) (*sum)[c] += s * p[c];
}

// The neighbours of a vertex in the order of its faces; a boundary vertex's begin and end there.
struct Ring {
  std::vector<uint32_t> vertices;
  bool boundary = false;
};

struct Edge {
  uint32_t from, to;  // as the face has it
  uint32_t opposite;
  uint32_t face, side;
};

// Weight of each neighbour of an inner vertex (J. Warren).
double NeighbourWeight(size_t valence) {
  return valence == 3 ? 3.0 / 16.0 : 3.0 / (8.0 * static_cast<double>(valence));
}

// Brings the faces (v, a, b) of one vertex into a chain of a -> b. False if they make none.
bool OrderRing(std::vector<std::pair<uint32_t, uint32_t>>& steps, Ring* ring) {
  std::sort(steps.begin(), steps.end());
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].first == steps[i - 1].first) return false;
  }
  const auto next = [&](uint32_t a) {
    const auto at = std::lower_bound(steps.begin(), steps.end(), std::pair{a, 0u});
    return at == steps.end() || at->first != a ? nullptr : &*at;
  };
  uint32_t start = steps.front().first;
  for (const auto& [a, b] : steps) {
    const bool is_entered = std::any_of(steps.begin(), steps.end(),
                                        [a = a](const auto& step) { return step.second == a; });
    if (is_entered) continue;
    start = a;
    ring->boundary = true;
  }
  uint32_t at = start;
  for (size_t i = 0; i < steps.size(); ++i) {
    const auto* step = next(at);
    if (step == nullptr) return false;
    ring->vertices.push_back(at);
    at = step->second;
  }
  if (ring->boundary) ring->vertices.push_back(at);
  return ring->boundary ? next(at) == nullptr : at == start;
}

Result<std::vector<Ring>> MakeRings(size_t points, const std::vector<Face>& faces) {
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> steps(points);
  for (const Face& face : faces) {
    for (size_t k = 0; k < 3; ++k) {
      steps[face[k]].emplace_back(face[(k + 1) % 3], face[(k + 2) % 3]);
    }
  }
  std::vector<Ring> rings(points);
  for (size_t v = 0; v < points; ++v) {
    if (steps[v].empty() || OrderRing(steps[v], &rings[v])) continue;
    return Error{"the faces around vertex " + std::to_string(v) +
                 " make no surface: they wind differently, or more than two share an edge"};
  }
  return rings;
}

// Where an old vertex goes.
Point MoveVertex(const std::vector<Point>& points, const Ring& ring, const Point& p, double crease,
                 double inner) {
  Point moved{};
  const std::vector<uint32_t>& around = ring.vertices;
  if (around.empty()) return p;
  if (ring.boundary) {
    AddScaled(1.0 - 2.0 * crease, p, &moved);
    AddScaled(crease, points[around.front()], &moved);
    AddScaled(crease, points[around.back()], &moved);
    return moved;
  }
  AddScaled(1.0 - inner * static_cast<double>(around.size()), p, &moved);
  for (const uint32_t other : around) AddScaled(inner, points[other], &moved);
  return moved;
}

std::vector<Edge> SortedEdges(const std::vector<Face>& faces) {
  std::vector<Edge> edges;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      edges.push_back({faces[f][k], faces[f][(k + 1) % 3], faces[f][(k + 2) % 3], f, k});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::minmax(a.from, a.to) < std::minmax(b.from, b.to);
  });
  return edges;
}

// One level: every face into four.
ControlMesh Refine(const ControlMesh& mesh, const std::vector<Ring>& rings) {
  ControlMesh fine;
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    const size_t valence = std::max<size_t>(rings[v].vertices.size(), 3);
    fine.points.push_back(
        MoveVertex(mesh.points, rings[v], mesh.points[v], 1.0 / 8.0, NeighbourWeight(valence)));
  }
  std::vector<Face> middle(mesh.faces.size());
  const std::vector<Edge> edges = SortedEdges(mesh.faces);
  for (size_t i = 0; i < edges.size();) {
    const Edge& edge = edges[i];
    const bool shared =
        i + 1 < edges.size() && edges[i + 1].from == edge.to && edges[i + 1].to == edge.from;
    Point p{};
    AddScaled(shared ? 3.0 / 8.0 : 0.5, mesh.points[edge.from], &p);
    AddScaled(shared ? 3.0 / 8.0 : 0.5, mesh.points[edge.to], &p);
    for (size_t k = 0; shared && k < 2; ++k) {
      AddScaled(1.0 / 8.0, mesh.points[edges[i + k].opposite], &p);
    }
    for (size_t k = 0; k < (shared ? 2u : 1u); ++k) {
      middle[edges[i + k].face][edges[i + k].side] = static_cast<uint32_t>(fine.points.size());
    }
    fine.points.push_back(p);
    i += shared ? 2 : 1;
  }
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& old = mesh.faces[f];
    const Face& m = middle[f];  // of the edges 01, 12, 20
    for (const Face& face : {Face{old[0], m[0], m[2]}, Face{m[0], old[1], m[1]},
                             Face{m[2], m[1], old[2]}, Face{m[0], m[1], m[2]}}) {
      fine.faces.push_back(face);
    }
  }
  return fine;
}

Point LimitNormal(const std::vector<Point>& points, const Ring& ring, const Point& p) {
  Point s{}, t{};
  const std::vector<uint32_t>& around = ring.vertices;
  const size_t n = around.size();
  const auto at = [&](size_t i) -> const Point& { return points[around[i]]; };
  if (n == 0) return {};
  if (!ring.boundary) {
    for (size_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      AddScaled(std::cos(angle), at(i), &s);
      AddScaled(std::sin(angle), at(i), &t);
    }
    return Cross(s, t);
  }
  // s goes along the boundary, t across it.
  AddScaled(1.0, at(0), &s);
  AddScaled(-1.0, at(n - 1), &s);
  if (n == 2) {
    AddScaled(1.0, at(0), &t);
    AddScaled(1.0, at(1), &t);
    AddScaled(-2.0, p, &t);
  } else if (n == 3) {
    AddScaled(1.0, at(1), &t);
    AddScaled(-1.0, p, &t);
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    AddScaled(-std::sin(theta), at(0), &t);
    AddScaled(-std::sin(theta), at(n - 1), &t);
    for (size_t i = 1; i + 1 < n; ++i) {
      AddScaled((2.0 - 2.0 * std::cos(theta)) * std::sin(static_cast<double>(i) * theta), at(i),
                &t);
    }
  }
  return Cross(s, t);
}

}  // namespace

Result<SmoothMesh> SubdivideLoop(ControlMesh mesh, int levels) {
  Result<std::vector<Ring>> rings = MakeRings(mesh.points.size(), mesh.faces);
  for (int level = 0; level < levels && rings; ++level) {
    if (4 * uint64_t{mesh.faces.size()} > kMaxSubdividedFaces) {
      return Error{"its levels make more than " + std::to_string(kMaxSubdividedFaces) +
                   " faces; use fewer"};
    }
    mesh = Refine(mesh, *rings);
    rings = MakeRings(mesh.points.size(), mesh.faces);
  }
  if (!rings) return rings.error();
  SmoothMesh smooth;
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    const Ring& ring = (*rings)[v];
    const auto valence = static_cast<double>(std::max<size_t>(ring.vertices.size(), 3));
    const double inner = 1.0 / (valence + 3.0 / (8.0 * NeighbourWeight(ring.vertices.size())));
    smooth.points.push_back(MoveVertex(mesh.points, ring, mesh.points[v], 1.0 / 5.0, inner));
  }
  for (size_t v = 0; v < mesh.points.size(); ++v) {
    smooth.normals.push_back(LimitNormal(mesh.points, (*rings)[v], mesh.points[v]));
  }
  smooth.faces = std::move(mesh.faces);
  return smooth;
}

}  // namespace swell
