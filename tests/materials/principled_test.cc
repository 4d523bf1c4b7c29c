// The principled material against the formulas of glTF's specification, in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

constexpr auto kDisk = DiffuseSampling::kDisk;

// glTF 2.0, appendix B, with one channel; the factors of the extensions.
struct Model {
  double base = 0.8, metallic = 0.0, roughness = 0.5, ior = 1.5;
  double specular = 1.0, specular_color = 1.0, transmission = 0.0;
  double coat = 0.0, coat_roughness = 0.3;
};

double Schlick(double f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0); }

// D V of GGX with correlated heights, times 1; all three directions above.
double Facets(double roughness, const Direction& v, const Direction& l, const Direction& h) {
  const double a2 = std::pow(roughness, 4.0);
  const double d = a2 / (M_PI * std::pow(h.z * h.z * (a2 - 1.0) + 1.0, 2.0));
  const auto part = [&](double x, double y) { return x * std::sqrt(a2 + (1.0 - a2) * y * y); };
  return d * 0.5 / (part(l.z, v.z) + part(v.z, l.z));
}

double Value(const Model& m, const Direction& v, Direction l) {
  const bool through = l.z < 0.0;
  l.z = std::fabs(l.z);
  Direction h = {v.x + l.x, v.y + l.y, v.z + l.z};
  const double length = std::sqrt(Dot(h, h));
  h = {h.x / length, h.y / length, h.z / length};
  const double vh = Dot(v, h);
  const double facets = Facets(m.roughness, v, l, h);
  const double root = (1.0 - m.ior) / (1.0 + m.ior);
  const double f0 = std::fmin(1.0, root * root * m.specular_color);
  const double reflected = m.specular * Schlick(f0, vh);
  const double left = 1.0 - m.specular * Schlick(f0, std::min({vh, v.z, l.z}));
  const double coat = m.coat * Schlick(0.04, v.z);
  if (through) {
    return (1.0 - coat) * (1.0 - m.metallic) * left * m.transmission * m.base * facets * l.z;
  }
  const double diffuse = left * (1.0 - m.transmission) * m.base / M_PI;
  const double dielectric = diffuse + reflected * facets;
  const double metal = Schlick(m.base, vh) * facets;
  const double under = (1.0 - m.metallic) * dielectric + m.metallic * metal;
  return ((1.0 - coat) * under + coat * Facets(m.coat_roughness, v, l, h)) * l.z;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("principled: the specification's formulas, with every extension's factor") {
  const MaterialInfo& info = FindMaterial("principled");
  std::vector<Model> models(8);
  models[1].metallic = 1.0;
  models[2].metallic = 0.4, models[2].roughness = 0.3;
  models[3].ior = 2.4;
  models[4].specular = 0.3, models[4].specular_color = 3.0;
  models[5].transmission = 0.7, models[5].roughness = 0.8;
  models[6].coat = 0.9;
  models[7] = {0.6, 0.2, 0.6, 1.8, 0.7, 1.5, 0.5, 0.4, 0.6};
  for (size_t k = 0; k < models.size(); ++k) {
    const Model& m = models[k];
    Params params = Defaults(info);
    const auto set = [&](const char* name, double value) {
      SetParam(info, name, static_cast<float>(value), &params);
    };
    set("base_color", m.base);
    set("metallic", m.metallic);
    set("roughness", m.roughness);
    set("ior", m.ior);
    set("specular", m.specular);
    set("specular_color", m.specular_color);
    set("transmission", m.transmission);
    set("clearcoat", m.coat);
    set("clearcoat_roughness", m.coat_roughness);
    const Directions wo = RandomDirections(512, 80), wi = RandomDirections(512, 81);
    for (const Variant& variant : SupportedVariants()) {
      INFO(variant.name, ", model ", k);
      const Evaluation at = Evaluate(info, variant, params, kDisk, wo, wi, 512);
      for (size_t i = 0; i < 512; ++i) {
        Direction v = wo.Get(i), l = wi.Get(i);
        if (v.z < 0.0) v.z = -v.z, l.z = -l.z;
        const double expected = Value(m, v, l);
        CHECK(at.value[0][i] == doctest::Approx(expected).epsilon(2e-4));
      }
    }
  }
}

TEST_CASE("principled: a coat with a normal of its own shines about that") {
  const MaterialInfo& info = FindMaterial("principled");
  Params params = Defaults(info);
  SetParam(info, "base_color", 0.0f, &params);
  SetParam(info, "metallic", 0.0f, &params);
  SetParam(info, "specular", 0.0f, &params);
  SetParam(info, "clearcoat", 0.9f, &params);
  SetParam(info, "clearcoat_roughness", 0.6f, &params);
  // The map's colour of the normal (0.6, 0, 0.8).
  uint32_t word = 0;
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (std::string_view(info.params[i].name) == "clearcoat_normal") word = ParamOffset(info, i);
  }
  params[word] = 0.8f;
  params[word + 1] = 0.5f;
  params[word + 2] = 0.9f;
  const auto about_normal = [](const Direction& w) {
    return Direction{0.8 * w.x - 0.6 * w.z, w.y, 0.6 * w.x + 0.8 * w.z};
  };
  const Directions wo = RandomDirections(512, 84), wi = RandomDirections(512, 85);
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    const Evaluation at = Evaluate(info, variant, params, kDisk, wo, wi, 512);
    size_t lit = 0;
    for (size_t i = 0; i < 512; ++i) {
      Direction v = wo.Get(i), l = wi.Get(i);
      if (v.z < 0.0) v.z = -v.z, l.z = -l.z;
      // It is level where it would look away from the viewer.
      const bool tilted = 0.6 * v.x + 0.8 * v.z > 0.0;
      const Direction own_v = tilted ? about_normal(v) : v, own_l = tilted ? about_normal(l) : l;
      double expected = 0.0;
      if (l.z > 0.0 && own_l.z > 0.0) {
        Direction h = {own_v.x + own_l.x, own_v.y + own_l.y, own_v.z + own_l.z};
        const double length = std::sqrt(Dot(h, h));
        h = {h.x / length, h.y / length, h.z / length};
        expected = 0.9 * Schlick(0.04, own_v.z) * Facets(0.6, own_v, own_l, h) * own_l.z;
        ++lit;
      }
      CHECK(at.value[0][i] == doctest::Approx(expected).epsilon(5e-4));
    }
    CHECK(lit > 100);
  }
}

TEST_CASE("principled: smooth metal is a tinted mirror, smooth thin glass lets light straight on") {
  const MaterialInfo& info = FindMaterial("principled");
  Params metal = Defaults(info);
  SetParam(info, "roughness", 0.0f, &metal);
  SetParam(info, "base_color", 0.6f, &metal);
  Params glass = metal;
  SetParam(info, "metallic", 0.0f, &glass);
  SetParam(info, "transmission", 1.0f, &glass);
  CHECK(info.is_specular(metal.data()));
  CHECK(info.is_specular(glass.data()));
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    const Direction view = FromAngles(0.8, 0.3);
    const Directions wo = Repeat(view, 256);
    const Samples m = Sample(info, variant, metal, kDisk, wo, RandomUniforms(256, 82), 256);
    const Samples g = Sample(info, variant, glass, kDisk, wo, RandomUniforms(256, 83), 256);
    double back = 0.0, on = 0.0;
    for (size_t i = 0; i < 256; ++i) {
      CHECK(m.weight[0][i] == doctest::Approx(Schlick(0.6, 0.8)).epsilon(1e-5));
      CHECK(std::fabs(m.wi.x[i] + view.x) < 1e-6);
      CHECK(std::fabs(g.wi.x[i] + view.x) < 1e-6);
      (g.wi.z[i] > 0.0f ? back : on) += g.weight[0][i] / 256;
    }
    // Each is drawn often enough for a mean of few: the weights are constant.
    CHECK(back == doctest::Approx(Schlick(0.04, 0.8)).epsilon(0.5));
    CHECK(on == doctest::Approx(0.6 * (1.0 - Schlick(0.04, 0.8))).epsilon(0.2));
  }
}

TEST_CASE("principled: sheen adds light at grazing angles, and takes it from what is below") {
  const MaterialInfo& info = FindMaterial("principled");
  Params plain = Defaults(info);
  SetParam(info, "metallic", 0.0f, &plain);
  SetParam(info, "specular", 0.0f, &plain);
  SetParam(info, "base_color", 0.5f, &plain);
  Params cloth = plain;
  SetParam(info, "sheen_color", 1.0f, &cloth);
  SetParam(info, "sheen_roughness", 0.5f, &cloth);
  const Variant variant = SupportedVariants()[0];
  const auto albedo = [&](const Params& params, double cosine) {
    constexpr size_t kCount = 1 << 15;
    const Samples s = Sample(info, variant, params, kDisk, Repeat(FromAngles(cosine, 0.2), kCount),
                             RandomUniforms(kCount, 84), kCount);
    double sum = 0.0;
    for (size_t i = 0; i < kCount; ++i) sum += s.weight[0][i] / kCount;
    return sum;
  };
  // The table's row for roughness 0.5 lies between 0.4688 and 0.5313.
  CHECK(albedo(plain, 0.5) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(albedo(cloth, 0.1) > albedo(cloth, 0.9));
  CHECK(albedo(cloth, 0.1) <= 1.0);
  Params black = cloth;
  SetParam(info, "base_color", 0.0f, &black);
  for (const double cosine : {0.2, 0.6}) {
    const double sheen = albedo(black, cosine);
    CHECK(sheen > 0.02);
    // Below is left at most what the sheen does not scatter towards the view.
    CHECK(albedo(cloth, cosine) < sheen + 0.5 * (1.0 - sheen) * 1.05);
  }
}

TEST_SUITE_END();

}  // namespace swell::test
