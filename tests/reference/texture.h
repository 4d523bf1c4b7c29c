// Textures at one point, in double precision: the oracle of the kernels' programs.
#ifndef SWELL_TESTS_REFERENCE_TEXTURE_H_
#define SWELL_TESTS_REFERENCE_TEXTURE_H_

#include <array>

#include "src/scene/scene.h"

namespace swell::reference {

using Color = std::array<double, 3>;

struct TexturedPoint {
  std::array<double, 3> p, n;  // world space
  double u, v;
  std::array<double, 4> color{1, 1, 1, 1};  // of the mesh's vertices, and their alpha
};

// Perlin 2002.
double PerlinNoise(double x, double y, double z);
// The value of a node of the scene, unfiltered: as if the pixel had no width.
Color EvaluateTexture(const Scene& scene, uint32_t node, const TexturedPoint& at);

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_TEXTURE_H_
