// Materials of a scene in, scalar scattering functions out.
#include "bench/peer/bsdf.h"

#include <string>

#include "bench/peer/sampling.h"
#include "kernels/material.h"

namespace swell::bench {
namespace {

Vec3 MirrorDirection(const Vec3& wo) { return {-wo.x, -wo.y, wo.z}; }

// Born and Wolf, Principles of Optics, section 14.2.
float FresnelConductor(float cos_i, float eta, float k) {
  const float cos2 = cos_i * cos_i, sin2 = 1.0f - cos2;
  const float real = eta * eta - k * k - sin2;
  const float size = std::sqrt(real * real + 4.0f * eta * eta * k * k);
  const float a = std::sqrt(std::max(0.0f, 0.5f * (size + real)));
  const float sum = size + cos2, two_a_cos = 2.0f * a * cos_i;
  const float perpendicular = (sum - two_a_cos) / (sum + two_a_cos);
  const float far_sum = cos2 * size + sin2 * sin2, mixed = two_a_cos * sin2;
  return 0.5f * perpendicular * (1.0f + (far_sum - mixed) / (far_sum + mixed));
}

float FresnelDielectric(float cos_i, float cos_t, float eta) {
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// See kernels/materials/fuzzy_mirror.cc for the derivation.
float FuzzyDensity(float fuzz, const Vec3& wo, const Vec3& wi) {
  if (wo.z * wi.z <= 0.0f) return 0.0f;
  const Vec3 chord = wi - MirrorDirection(wo);
  const float chord2 = Dot(chord, chord);
  const float c = 1.0f - 0.5f * chord2;
  const float rim = fuzz * fuzz - chord2 * (1.0f - 0.25f * chord2);
  const float blur = 4e-7f * fuzz;
  if (rim <= -blur || c <= 0.0f) return 0.0f;
  const float s2 = std::max(rim, blur);
  return (c * c + s2) / (2.0f * kPi * fuzz * std::sqrt(s2));
}

BsdfSample SampleFuzzyMirror(const Bsdf& bsdf, const Vec3& wo, float u0, float u1) {
  const Vec3 sum = MirrorDirection(wo) + bsdf.fuzz * UniformSphere(u0, u1);
  if (Dot(sum, sum) < 1e-12f) return {{}, {}, 0.0f, 1.0f};
  const Vec3 wi = Normalize(sum);
  return {wi, bsdf.reflectance, FuzzyDensity(bsdf.fuzz, wo, wi), 1.0f};
}

BsdfSample SampleDielectric(const Bsdf& bsdf, const Vec3& wo, float u) {
  const float eta = wo.z > 0.0f ? bsdf.eta.x : 1.0f / bsdf.eta.x;
  const float cos_i = std::abs(wo.z);
  const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
  const float cos_t = sin2_t < 1.0f ? std::sqrt(1.0f - sin2_t) : 0.0f;
  const float reflected = sin2_t < 1.0f ? FresnelDielectric(cos_i, cos_t, eta) : 1.0f;
  if (u < reflected) return {MirrorDirection(wo), bsdf.reflectance, 1.0f, 1.0f};
  const Vec3 refracted = {-wo.x / eta, -wo.y / eta, std::copysign(cos_t, -wo.z)};
  return {refracted, (1.0f / (eta * eta)) * bsdf.transmittance, 1.0f, eta * eta};
}

BsdfSample SampleConductor(const Bsdf& bsdf, const Vec3& wo) {
  const float cos_i = std::min(std::abs(wo.z), 1.0f);
  const Rgb reflected = {FresnelConductor(cos_i, bsdf.eta.x, bsdf.k.x),
                         FresnelConductor(cos_i, bsdf.eta.y, bsdf.k.y),
                         FresnelConductor(cos_i, bsdf.eta.z, bsdf.k.z)};
  return {MirrorDirection(wo), reflected, 1.0f, 1.0f};
}

}  // namespace

Result<Bsdf> MakeBsdf(const Material& material) {
  const std::string kind = kMaterialKinds[material.kind]->name;
  const float* p = material.params.data();
  Bsdf bsdf;
  bsdf.reflectance = Load3(p);
  if (kind == "diffuse") {
    bsdf.kind = BsdfKind::kDiffuse;
  } else if (kind == "mirror") {
    bsdf.kind = BsdfKind::kMirror;
  } else if (kind == "fuzzymirror") {
    bsdf.kind = p[3] == 0.0f ? BsdfKind::kMirror : BsdfKind::kFuzzyMirror;
    bsdf.fuzz = p[3];
  } else if (kind == "dielectric" && p[1] == 0.0f) {
    bsdf.kind = BsdfKind::kDielectric;
    bsdf.eta.x = p[0];
    bsdf.reflectance = Load3(p + 2);
    bsdf.transmittance = Load3(p + 5);
  } else if (kind == "conductor" && std::min({p[6], p[7], p[8]}) < 0.0f) {
    bsdf.kind = BsdfKind::kConductor;
    bsdf.eta = Load3(p);
    bsdf.k = Load3(p + 3);
  } else {
    return Error{"the peer has no material '" + kind + "' with these parameters"};
  }
  bsdf.specular = bsdf.kind != BsdfKind::kDiffuse && bsdf.kind != BsdfKind::kFuzzyMirror;
  return bsdf;
}

BsdfValue Evaluate(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  switch (bsdf.kind) {
    case BsdfKind::kDiffuse: {
      const float pdf = wo.z * wi.z > 0.0f ? std::abs(wi.z) * kInvPi : 0.0f;
      return {pdf * bsdf.reflectance, pdf};
    }
    case BsdfKind::kFuzzyMirror: {
      const float pdf = FuzzyDensity(bsdf.fuzz, wo, wi);
      return {pdf * bsdf.reflectance, pdf};
    }
    default:
      return {{}, 0.0f};
  }
}

BsdfSample Sample(const Bsdf& bsdf, const Vec3& wo, float u0, float u1, float u2) {
  switch (bsdf.kind) {
    case BsdfKind::kDiffuse: {
      Vec3 wi = CosineHemisphere(u0, u1);
      const float pdf = wi.z * kInvPi;
      wi.z = std::copysign(wi.z, wo.z);
      return {wi, bsdf.reflectance, pdf, 1.0f};
    }
    case BsdfKind::kMirror:
      return {MirrorDirection(wo), bsdf.reflectance, 1.0f, 1.0f};
    case BsdfKind::kFuzzyMirror:
      return SampleFuzzyMirror(bsdf, wo, u0, u1);
    case BsdfKind::kDielectric:
      return SampleDielectric(bsdf, wo, u2);
    case BsdfKind::kConductor:
      return SampleConductor(bsdf, wo);
  }
  return {{}, {}, 0.0f, 1.0f};
}

}  // namespace swell::bench
