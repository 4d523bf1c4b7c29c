// A light in; where it is, whereto it shines and how strongly out: what a light tree is built of.
#ifndef SWELL_SCENE_LIGHT_BOUNDS_H_
#define SWELL_SCENE_LIGHT_BOUNDS_H_

#include <array>

#include "src/scene/objects.h"

namespace swell {

// Box, cone and strength of lights (Conty Estevez & Kulla 2018, section 4.1). Every light's axes
// lie within theta_o of `axis`, and it shines only to within theta_e of one of them.
struct LightBounds {
  Bounds box;
  std::array<double, 3> axis{0, 0, 1};
  double theta_o = 0, theta_e = 0;  // radians; at most pi and pi / 2
  double intensity = 0;             // along an axis [W/sr], the largest channel; sums add up
  bool two_sided = false;           // shines to both sides of its cone
};

// Bounds of both; `a` may be empty.
LightBounds Union(const LightBounds& a, const LightBounds& b);

// The directions of a cone, weighed: their equation 1.
double OrientationMeasure(const LightBounds& bounds);

// Of a light with a place. `level` is its mean radiance or intensity, the largest channel.
LightBounds BoundsOf(const Scene& scene, const LightRecord& light, double level);

}  // namespace swell

#endif  // SWELL_SCENE_LIGHT_BOUNDS_H_
