// One ray and a scene in, its hit out: every primitive is tested, in plain scalar code.
#ifndef SWELL_TESTS_REFERENCE_INTERSECT_H_
#define SWELL_TESTS_REFERENCE_INTERSECT_H_

#include <array>
#include <cstdint>

#include "kernels/records.h"
#include "src/scene/scene.h"

namespace swell::reference {

struct Ray {
  std::array<float, 3> org, dir;
};

// The kernels' arithmetic in scalar floats: equal to the bit on targets with fused multiply-add.
HitFields<Row> ClosestHit(const Scene& scene, const Ray& ray);

// In double precision, with the textbook formulas. `certain` is false where a change of the ray by
// a few float roundings might hit another primitive or none.
struct ExactHit {
  double t;
  uint32_t prim, instance;
  bool certain;
};
ExactHit ExactClosestHit(const Scene& scene, const Ray& ray);

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_INTERSECT_H_
