// The oracle of layered materials: one walk at a time, by chance alone, in double precision.
#ifndef SWELL_TESTS_REFERENCE_LAYERED_H_
#define SWELL_TESTS_REFERENCE_LAYERED_H_

#include <random>

#include "tests/reference/vector.h"

namespace swell::reference {

// GGX alphas along x and y; 0 is smooth.
struct Facets {
  double x = 0.0, y = 0.0;
};
struct LayeredModel {
  double eta = 1.5;  // of the layer
  Facets coat;
  double thickness = 0.01, albedo = 0.0, g = 0.0;
  int max_events = 100;
  bool metal = false;                     // else diffuse
  double reflectance = 0.5;               // of the diffuse ground
  double metal_eta = 1.0, metal_k = 0.0;  // over air, not over the layer
  Facets ground;
};

struct LayeredExit {
  Vector wi;
  double weight = 0.0;    // 0: absorbed
  bool specular = false;  // given its last event but leaving, it could go nowhere else
};

// Where light seen along wo (above) comes from: nothing but a photon's walk, backwards.
LayeredExit WalkLayers(const LayeredModel& model, const Vector& wo, std::mt19937_64& random);

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_LAYERED_H_
