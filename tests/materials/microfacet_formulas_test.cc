// Rough metal and glass against their models in closed form at the normal, on every target.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

constexpr DiffuseSampling kDisk = DiffuseSampling::kDisk;

double ValueAt(const MaterialInfo& info, const Variant& variant, const Params& params,
               const Direction& wo, const Direction& wi) {
  return Evaluate(info, variant, params, kDisk, Repeat(wo, 1), Repeat(wi, 1), 1).value[0][0];
}

// Of a metal of index 0.5 + 3 i.
double Fresnel(double cos_i) {
  const std::complex<double> index(0.5, 3.0);
  const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (index * index));
  return 0.5 * (std::norm((index * cos_i - cos_t) / (index * cos_i + cos_t)) +
                std::norm((cos_i - index * cos_t) / (cos_i + index * cos_t)));
}

constexpr Direction kUp = {0, 0, 1}, kDown = {0, 0, -1};

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("rough conductor: at the normal F D / 4, with alpha the root of a remapped roughness") {
  const MaterialInfo& info = FindMaterial("conductor");
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    Params params = Defaults(info);
    SetParam(info, "reflectance", 0.8f, &params);
    SetParam(info, "roughness", 0.25f, &params);
    // D(n) = 1 / (pi alpha_u alpha_v), and nothing is masked.
    const double remapped = 0.8 / (4.0 * M_PI * 0.5 * 0.5);
    CHECK(ValueAt(info, variant, params, kUp, kUp) == doctest::Approx(remapped).epsilon(1e-5));
    CHECK(ValueAt(info, variant, params, kDown, kDown) == doctest::Approx(remapped).epsilon(1e-5));
    SetParam(info, "remaproughness", 0.0f, &params);
    const double direct = 0.8 / (4.0 * M_PI * 0.25 * 0.25);
    CHECK(ValueAt(info, variant, params, kUp, kUp) == doctest::Approx(direct).epsilon(1e-5));
    SetParam(info, "vroughness", 0.5f, &params);
    const double stretched = 0.8 / (4.0 * M_PI * 0.25 * 0.5);
    CHECK(ValueAt(info, variant, params, kUp, kUp) == doctest::Approx(stretched).epsilon(1e-5));
  }
}

TEST_CASE("rough conductor: Torrance and Sparrow's formula at any pair of directions") {
  const MaterialInfo& info = FindMaterial("conductor");
  Params params = Defaults(info);
  SetParam(info, "eta", 0.5f, &params);
  SetParam(info, "k", 3.0f, &params);
  SetParam(info, "remaproughness", 0.0f, &params);
  SetParam(info, "uroughness", 0.2f, &params);
  SetParam(info, "vroughness", 0.6f, &params);
  const auto lambda = [](const Direction& w) {
    const double slope2 = (0.04 * w.x * w.x + 0.36 * w.y * w.y) / (w.z * w.z);
    return 0.5 * (std::sqrt(1.0 + slope2) - 1.0);
  };
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    const Directions a = RandomDirections(512, 50), b = RandomDirections(512, 51);
    const Evaluation at = Evaluate(info, variant, params, kDisk, a, b, 512);
    for (size_t i = 0; i < 512; ++i) {
      Direction wo = a.Get(i), wi = b.Get(i);
      if (wo.z * wi.z <= 0.0) continue;
      if (wo.z < 0.0) wo.z = -wo.z, wi.z = -wi.z;
      Direction m = {wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
      const double length = std::sqrt(Dot(m, m));
      m = {m.x / length, m.y / length, m.z / length};
      // Tangents of the normal's slopes, Walter et al. 2007 (eq. 33) stretched.
      const double tan2 = (m.x * m.x / 0.04 + m.y * m.y / 0.36) / (m.z * m.z);
      const double d = 1.0 / (M_PI * 0.12 * std::pow(m.z, 4.0) * (1.0 + tan2) * (1.0 + tan2));
      const double g = 1.0 / (1.0 + lambda(wo) + lambda(wi));
      CHECK(at.pdf[i] == doctest::Approx(d / (4.0 * wo.z * (1.0 + lambda(wo)))).epsilon(1e-4));
      CHECK(at.value[0][i] ==
            doctest::Approx(Fresnel(Dot(wo, m)) * d * g / (4.0 * wo.z)).epsilon(1e-4));
    }
  }
}

TEST_CASE("rough dielectric: straight through at the normal T D / (eta - 1)^2, and back F D / 4") {
  const MaterialInfo& info = FindMaterial("dielectric");
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    Params params = Defaults(info);
    SetParam(info, "eta", 1.5f, &params);
    SetParam(info, "roughness", 0.25f, &params);
    const double d = 1.0 / (M_PI * 0.25), f = 0.04;
    CHECK(ValueAt(info, variant, params, kUp, kUp) == doctest::Approx(f * d / 4).epsilon(1e-5));
    CHECK(ValueAt(info, variant, params, kDown, kDown) == doctest::Approx(f * d / 4).epsilon(1e-5));
    const double inward = (1.0 - f) * d / (0.5 * 0.5);
    CHECK(ValueAt(info, variant, params, kUp, kDown) == doctest::Approx(inward).epsilon(1e-5));
    // Outward eta is 1 / 1.5: the value is 1.5^2 times that of the way in.
    const double outward = (1.0 - f) * d / ((1 - 1 / 1.5) * (1 - 1 / 1.5));
    CHECK(ValueAt(info, variant, params, kDown, kUp) == doctest::Approx(outward).epsilon(1e-5));
  }
}

TEST_SUITE_END();

}  // namespace swell::test
