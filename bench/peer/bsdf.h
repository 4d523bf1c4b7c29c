// The materials of the peer: the same models as swell's, one direction at a time.
#ifndef SWELL_BENCH_PEER_BSDF_H_
#define SWELL_BENCH_PEER_BSDF_H_

#include "bench/peer/vec3.h"
#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell::bench {

enum class BsdfKind { kDiffuse, kMirror, kFuzzyMirror, kDielectric, kConductor };

// Directions are local, z is the shading normal, wo points away from the surface.
struct Bsdf {
  BsdfKind kind = BsdfKind::kDiffuse;
  bool specular = false;
  Rgb reflectance, transmittance;
  Rgb eta, k;  // dielectric: eta.x
  float fuzz = 0;
};

struct BsdfValue {
  Rgb value;  // f * |cos|
  float pdf;
};
struct BsdfSample {
  Vec3 wi;
  Rgb weight;  // f * |cos| / pdf
  float pdf;   // 0: nothing is scattered
  float eta_scale;
};

// An error names a material that the peer does not know.
Result<Bsdf> MakeBsdf(const Material& material);

BsdfValue Evaluate(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi);
BsdfSample Sample(const Bsdf& bsdf, const Vec3& wo, float u0, float u1, float u2);

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_BSDF_H_
