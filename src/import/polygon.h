// The corners of a polygon in space -> triangles that cover it, also where it is not convex.
#ifndef SWELL_IMPORT_POLYGON_H_
#define SWELL_IMPORT_POLYGON_H_

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace swell {

// Appends 3 corner numbers for each of points.size() - 2 triangles, which wind as the polygon does.
// Convex polygons become fans around corner 0; others lose ear by ear. One that crosses itself, has
// no area or takes too long becomes a fan too, in the end.
void Triangulate(std::span<const std::array<float, 3>> points, std::vector<uint32_t>* corners);

}  // namespace swell

#endif  // SWELL_IMPORT_POLYGON_H_
