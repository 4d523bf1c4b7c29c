// A scene and its objects in; which primitives stand in the world itself, where objects are placed,
// and how far everything reaches out.
#ifndef SWELL_SCENE_OBJECTS_H_
#define SWELL_SCENE_OBJECTS_H_

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "src/scene/scene.h"

namespace swell {

struct RowRange {
  size_t first, count;
};

// Triangles, or spheres, that no object claims; in order, none empty.
std::vector<RowRange> WorldTriangles(const Scene& scene);
std::vector<RowRange> WorldSpheres(const Scene& scene);

// An instance of row `object` of the scene's objects. Row-major 3x4, as Affine. Nothing if the map
// flattens the object, or stretches or shrinks it 1e15 times.
std::optional<InstanceRecord> PlaceObject(const std::array<double, 12>& object_to_world,
                                          uint32_t object);

struct Bounds {
  std::array<double, 3> low, high;

  Bounds() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  bool empty() const { return !(low[0] <= high[0]); }
  void Add(size_t axis, double from, double to) {
    if (from < low[axis]) low[axis] = from;
    if (to > high[axis]) high[axis] = to;
  }
};

// Of what is drawn: of an instance, the corners of its object's bounds.
Bounds WorldBounds(const Scene& scene);

struct PrimCounts {
  uint64_t triangles = 0, spheres = 0;
};
// What is drawn, primitives of objects once for every instance.
PrimCounts CountDrawn(const Scene& scene);

}  // namespace swell

#endif  // SWELL_SCENE_OBJECTS_H_
