// Each material against the formulas of its model, on every target; and the registry.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

constexpr DiffuseSampling kDisk = DiffuseSampling::kDisk;

// Draws from one view with u2 at the middles of `count` equal steps.
Samples Stratified(const MaterialInfo& info, const Variant& variant, const Params& params,
                   const Direction& view, size_t count) {
  Uniforms uniforms = RandomUniforms(count, 2);
  for (size_t i = 0; i < count; ++i) {
    uniforms.u[2][i] = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
  }
  return Sample(info, variant, params, kDisk, Repeat(view, count), uniforms, count);
}

double UnpolarisedFresnel(double cos_i, double eta) {
  const double sin_t = std::sqrt(1.0 - cos_i * cos_i) / eta;
  if (sin_t >= 1.0) return 1.0;
  const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (p * p + s * s);
}

const NamedValue* FindNamed(const MaterialInfo& info, uint32_t param, const std::string& name) {
  const ParamSpec& spec = info.params[param];
  for (uint32_t i = 0; i < spec.named_count; ++i) {
    if (name == spec.named[i].name) return &spec.named[i];
  }
  return nullptr;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("registry: names are unique, parameters fit, defaults are in range, all is documented") {
  REQUIRE(kMaterialKindCount >= 5);
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    const MaterialInfo& info = *kMaterialKinds[i];
    INFO(info.name);
    for (uint32_t j = 0; j < i; ++j) {
      CHECK(std::string(info.name) != kMaterialKinds[j]->name);
    }
    CHECK(!std::string(info.help).empty());
    CHECK(ParamOffset(info, info.param_count) <= kMaterialWords);
    for (uint32_t p = 0; p < info.param_count; ++p) {
      const ParamSpec& spec = info.params[p];
      INFO(spec.name);
      CHECK(!std::string(spec.help).empty());
      CHECK((spec.named != nullptr) == (spec.named_count > 0));
      const uint32_t words = spec.type == ParamType::kRgb ? 3 : 1;
      for (uint32_t w = 0; w < words; ++w) {
        CHECK((spec.min <= spec.fallback[w] && spec.fallback[w] <= spec.max));
        for (uint32_t n = 0; n < spec.named_count; ++n) {
          CHECK((spec.min <= spec.named[n].value[w] && spec.named[n].value[w] <= spec.max));
        }
      }
    }
  }
}

TEST_CASE("diffuse: Lambert's law on the side of the view") {
  const MaterialInfo& info = FindMaterial("diffuse");
  Params params = Defaults(info);
  params[0] = 0.2f, params[1] = 0.5f, params[2] = 0.8f;
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    const Directions wo = RandomDirections(256, 20), wi = RandomDirections(256, 21);
    const Evaluation at = Evaluate(info, variant, params, kDisk, wo, wi, 256);
    for (size_t i = 0; i < 256; ++i) {
      const double cosine = wo.z[i] * wi.z[i] > 0.0f ? std::fabs(wi.z[i]) : 0.0;
      CHECK(at.pdf[i] == doctest::Approx(cosine / M_PI).epsilon(1e-6));
      for (int c = 0; c < 3; ++c) {
        CHECK(at.value[c][i] == doctest::Approx(params[c] * cosine / M_PI).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("diffuse: the weight of a sample is the reflectance to the bit, in all four ways") {
  const MaterialInfo& info = FindMaterial("diffuse");
  Params params = Defaults(info);
  SetParam(info, "reflectance", 0.3f, &params);
  for (const Variant& variant : SupportedVariants()) {
    for (const DiffuseSampling sampling : Samplings(info)) {
      const Samples s = Sample(info, variant, params, sampling, RandomDirections(4096, 22),
                               RandomUniforms(4096, 23), 4096);
      const auto all = [&](float weight) { return weight == 0.3f; };
      for (int c = 0; c < 3; ++c) {
        CHECK(std::all_of(s.weight[c].begin(), s.weight[c].end(), all));
      }
    }
  }
}

TEST_CASE("diffusetransmission: Lambert's law on both sides, scaled and cut at 1") {
  const MaterialInfo& info = FindMaterial("diffusetransmission");
  Params params = Defaults(info);
  const float colors[6] = {0.1f, 0.2f, 0.6f, 0.5f, 0.3f, 0.0f};
  std::copy(colors, colors + 6, params.begin());
  SetParam(info, "scale", 2.0f, &params);
  const double expected[2][3] = {{1.0, 0.6, 0.0}, {0.2, 0.4, 1.0}};
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    const Directions wo = RandomDirections(256, 60), wi = RandomDirections(256, 61);
    const Evaluation at = Evaluate(info, variant, params, kDisk, wo, wi, 256);
    const Samples s = Sample(info, variant, params, kDisk, wo, RandomUniforms(256, 62), 256);
    size_t back = 0;
    for (size_t i = 0; i < 256; ++i) {
      const bool same = wo.z[i] * wi.z[i] > 0.0f;
      const double lambert = std::fabs(wi.z[i]) / M_PI;
      // The larger channels of both sides are 1, so each is drawn half of the times.
      CHECK(at.pdf[i] == doctest::Approx(0.5 * lambert).epsilon(1e-6));
      const bool drawn_back = wo.z[i] * s.wi.z[i] > 0.0f;
      back += drawn_back;
      for (int c = 0; c < 3; ++c) {
        CHECK(at.value[c][i] == doctest::Approx(expected[same][c] * lambert).epsilon(1e-6));
        CHECK(s.weight[c][i] == doctest::Approx(2.0 * expected[drawn_back][c]).epsilon(1e-6));
      }
    }
    CHECK(back > 90);
    CHECK(back < 166);
  }
}

TEST_CASE("thindielectric: passes straight on or mirrors, as often as two faces do together") {
  const MaterialInfo& info = FindMaterial("thindielectric");
  constexpr size_t kCount = 1 << 13;
  for (const Variant& variant : SupportedVariants()) {
    for (const double cos_i : {1.0, 0.6, 0.1, -0.5}) {
      const Direction view = FromAngles(cos_i, 0.7);
      const Samples s = Stratified(info, variant, Defaults(info), view, kCount);
      INFO(variant.name, ", cos ", cos_i);
      size_t reflected = 0;
      for (size_t i = 0; i < kCount; ++i) {
        const bool back = s.wi.z[i] * cos_i > 0.0;
        reflected += back;
        REQUIRE(std::fabs(s.wi.x[i] + view.x) < 1e-6);
        REQUIRE(std::fabs(std::fabs(s.wi.z[i]) - std::fabs(view.z)) < 1e-6);
        REQUIRE((s.weight[0][i] == 1.0f && s.eta_scale[i] == 1.0f));
      }
      const double r = UnpolarisedFresnel(std::fabs(cos_i), 1.5);
      double sum = r;
      for (double inside = (1 - r) * r * (1 - r); inside > 1e-12; inside *= r * r) sum += inside;
      CHECK(std::fabs(static_cast<double>(reflected) / kCount - sum) < 1.0 / kCount);
    }
  }
}

TEST_CASE("mirror: reflects about the normal, with its tint, on both sides") {
  const MaterialInfo& info = FindMaterial("mirror");
  Params params = Defaults(info);
  params[0] = 0.9f, params[1] = 0.6f, params[2] = 0.3f;
  for (const Variant& variant : SupportedVariants()) {
    const Directions wo = RandomDirections(128, 24);
    const Samples s = Sample(info, variant, params, kDisk, wo, RandomUniforms(128, 25), 128);
    for (size_t i = 0; i < 128; ++i) {
      CHECK((s.wi.x[i] == -wo.x[i] && s.wi.y[i] == -wo.y[i] && s.wi.z[i] == wo.z[i]));
      for (int c = 0; c < 3; ++c) CHECK(s.weight[c][i] == params[c]);
    }
  }
}

TEST_CASE("fuzzymirror: stays in its cone, loses nothing at the normal and some at grazing") {
  const MaterialInfo& info = FindMaterial("fuzzymirror");
  for (const Variant& variant : SupportedVariants()) {
    for (const float fuzz : {0.01f, 0.3f, 0.9f}) {
      Params params = Defaults(info);
      SetParam(info, "fuzz", fuzz, &params);
      INFO(variant.name, ", fuzz ", fuzz);
      size_t lost[2] = {0, 0};
      for (int grazing = 0; grazing < 2; ++grazing) {
        const Direction view = FromAngles(grazing != 0 ? 0.005 : 1.0, 1.0);
        const Direction mirrored = {-view.x, -view.y, view.z};
        const Samples s = Stratified(info, variant, params, view, 4096);
        for (size_t i = 0; i < 4096; ++i) {
          lost[grazing] += s.pdf[i] == 0.0f;
          if (s.pdf[i] == 0.0f) continue;
          const Direction wi = s.wi.Get(i);
          const double chord2 = 2.0 - 2.0 * Dot(wi, mirrored) / std::sqrt(Dot(wi, wi));
          CHECK(std::sqrt(chord2 * (1.0 - 0.25 * chord2)) < fuzz * (1.0 + 1e-4) + 1e-5);
          CHECK(s.weight[0][i] == 1.0f);
        }
      }
      CHECK(lost[0] == 0);
      CHECK(lost[1] > 500);
      CHECK(lost[1] < 3000);
    }
  }
}

TEST_CASE("fuzzymirror: f times cos is symmetric; fuzz 0 is the mirror") {
  const MaterialInfo& info = FindMaterial("fuzzymirror");
  for (const Variant& variant : SupportedVariants()) {
    Params params = Defaults(info);
    SetParam(info, "fuzz", 0.9f, &params);
    const Directions a = RandomDirections(4096, 26), b = RandomDirections(4096, 27);
    const Evaluation there = Evaluate(info, variant, params, kDisk, a, b, 4096);
    const Evaluation back = Evaluate(info, variant, params, kDisk, b, a, 4096);
    double worst = 0.0;
    size_t lit = 0;
    for (size_t i = 0; i < 4096; ++i) {
      lit += there.pdf[i] > 0.0f;
      worst = std::fmax(
          worst, std::fabs(there.value[0][i] - back.value[0][i]) / (there.value[0][i] + 1e-6));
    }
    CHECK(lit > 500);
    CHECK(worst < 1e-3);

    SetParam(info, "fuzz", 0.0f, &params);
    CHECK(info.is_specular(params.data()));
    const Samples s = Sample(info, variant, params, kDisk, a, RandomUniforms(4096, 28), 4096);
    CHECK((s.wi.x[5] == -a.x[5] && s.wi.z[5] == a.z[5] && std::isinf(s.pdf[5])));
  }
}

TEST_CASE("dielectric: refracts by Snell, reflects with Fresnel's probability, scales by eta^2") {
  const MaterialInfo& info = FindMaterial("dielectric");
  constexpr size_t kCount = 1 << 13;
  for (const Variant& variant : SupportedVariants()) {
    for (const float index : {1.333f, 1.5f, 2.417f, 1 / 1.5f}) {
      Params params = Defaults(info);
      SetParam(info, "eta", index, &params);
      for (const double cos_i : {1.0, 0.8, 0.5, 0.2, -0.95, -0.5}) {
        const Direction view = FromAngles(cos_i, 0.7);
        const Samples s = Stratified(info, variant, params, view, kCount);
        const double eta = cos_i > 0.0 ? index : 1.0 / index;
        INFO(variant.name, ", eta ", eta, ", cos ", cos_i);
        size_t reflected = 0;
        for (size_t i = 0; i < kCount; ++i) {
          const Direction wi = s.wi.Get(i);
          if (wi.z * cos_i > 0.0) {
            ++reflected;
            REQUIRE((wi.z == doctest::Approx(cos_i) && s.weight[0][i] == 1.0f));
            REQUIRE(s.eta_scale[i] == 1.0f);
            continue;
          }
          // Opposite azimuth, and the sine shrinks by the index.
          REQUIRE(std::fabs(wi.x * eta + view.x) < 2e-6);
          REQUIRE(std::fabs(wi.y * eta + view.y) < 2e-6);
          REQUIRE(s.weight[0][i] == doctest::Approx(1.0 / (eta * eta)).epsilon(1e-6));
          REQUIRE(s.eta_scale[i] == doctest::Approx(eta * eta).epsilon(1e-6));
        }
        const double share = static_cast<double>(reflected) / kCount;
        CHECK(std::fabs(share - UnpolarisedFresnel(std::fabs(cos_i), eta)) < 1.0 / kCount);
      }
    }
  }
}

TEST_CASE("dielectric: a refracted path can be walked back, with the same Fresnel share") {
  const MaterialInfo& info = FindMaterial("dielectric");
  constexpr size_t kCount = 1 << 13;
  for (const Variant& variant : SupportedVariants()) {
    for (const float choice : {0.0f, 1.0f}) {
      Params params = Defaults(info);
      SetParam(info, "fresnel", choice, &params);
      for (const double cos_i : {0.9, 0.4, 0.05, -0.99, -0.8}) {
        const Direction view = FromAngles(cos_i, 0.7);
        const Samples there = Stratified(info, variant, params, view, kCount);
        const Direction through = there.wi.Get(kCount - 1);  // u2 near 1: refracted
        const Samples back = Stratified(info, variant, params, through, kCount);
        const Direction again = back.wi.Get(kCount - 1);
        INFO(variant.name, ", cos ", cos_i);
        CHECK(Dot(again, view) == doctest::Approx(1.0).epsilon(1e-5));
        CHECK(there.weight[0][kCount - 1] * back.weight[0][kCount - 1] == doctest::Approx(1.0));
        const auto reflected = [&](const Samples& s, const Direction& from) {
          long count = 0;
          for (size_t i = 0; i < kCount; ++i) count += s.wi.z[i] * from.z > 0.0;
          return count;
        };
        CHECK(std::labs(reflected(there, view) - reflected(back, through)) <= 1);
      }
    }
  }
}

TEST_CASE("dielectric: eta 1 lets light straight through; a bubble is glass turned inside out") {
  const MaterialInfo& info = FindMaterial("dielectric");
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    Params params = Defaults(info);
    SetParam(info, "eta", 1.0f, &params);
    const Directions wo = RandomDirections(512, 29);
    const Uniforms uniforms = RandomUniforms(512, 30);
    const Samples straight = Sample(info, variant, params, kDisk, wo, uniforms, 512);
    for (size_t i = 0; i < 512; ++i) {
      CHECK(Dot(straight.wi.Get(i), wo.Get(i)) == doctest::Approx(-1.0).epsilon(1e-6));
      CHECK((straight.weight[0][i] == 1.0f && straight.eta_scale[i] == 1.0f));
    }

    SetParam(info, "eta", 1.0f / 1.5f, &params);
    const Samples bubble = Sample(info, variant, params, kDisk, wo, uniforms, 512);
    Directions flipped(512);
    for (size_t i = 0; i < 512; ++i) flipped.Set(i, {wo.x[i], wo.y[i], -wo.z[i]});
    const Samples glass = Sample(info, variant, Defaults(info), kDisk, flipped, uniforms, 512);
    for (size_t i = 0; i < 512; ++i) {
      CHECK(bubble.wi.x[i] == doctest::Approx(glass.wi.x[i]).epsilon(1e-5));
      CHECK(bubble.wi.z[i] == doctest::Approx(-glass.wi.z[i]).epsilon(1e-5));
      CHECK(bubble.weight[0][i] == doctest::Approx(glass.weight[0][i]));
    }
  }
}

TEST_CASE("dielectric: names stand for the indices of the lecture") {
  const MaterialInfo& info = FindMaterial("dielectric");
  const std::pair<const char*, float> expected[] = {{"vacuum", 1.0f},       {"air", 1.00029f},
                                                    {"ice", 1.31f},         {"water", 1.333f},
                                                    {"crown-glass", 1.52f}, {"diamond", 2.417f}};
  for (const auto& medium : expected) {
    INFO(medium.first);
    const NamedValue* named = FindNamed(info, 0, medium.first);
    REQUIRE(named != nullptr);
    CHECK(named->value[0] == medium.second);
  }
  REQUIRE(FindNamed(info, 1, "schlick") != nullptr);
}

TEST_CASE("conductor: normal incidence of the metals, and a reflectance instead of a metal") {
  const MaterialInfo& info = FindMaterial("conductor");
  const Direction normal = {0, 0, 1};
  for (const Variant& variant : SupportedVariants()) {
    INFO(variant.name);
    for (const char* metal : {"Cu", "Au", "Ag", "Al"}) {
      const NamedValue* eta = FindNamed(info, 0, metal);
      const NamedValue* k = FindNamed(info, 1, metal);
      REQUIRE((eta != nullptr && k != nullptr));
      CHECK(FindNamed(info, 0, std::string("metal-") + metal + "-eta")->value[1] == eta->value[1]);
      CHECK(FindNamed(info, 1, std::string("metal-") + metal + "-k")->value[1] == k->value[1]);
      Params params = Defaults(info);
      for (int c = 0; c < 3; ++c) params[c] = eta->value[c], params[3 + c] = k->value[c];
      const Samples s = Stratified(info, variant, params, normal, 16);
      for (int c = 0; c < 3; ++c) {
        const double n = eta->value[c], k2 = double{k->value[c]} * k->value[c];
        const double expected = ((n - 1) * (n - 1) + k2) / ((n + 1) * (n + 1) + k2);
        CHECK(s.weight[c][3] == doctest::Approx(expected).epsilon(1e-6));
      }
      CHECK(s.wi.z[3] == 1.0f);
    }
    Params params = Defaults(info);
    params[6] = 0.9f, params[7] = 0.5f, params[8] = 0.0f;
    const Samples s = Stratified(info, variant, params, normal, 16);
    CHECK(s.weight[0][0] == doctest::Approx(0.9).epsilon(1e-5));
    CHECK(s.weight[1][0] == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(s.weight[2][0] < 1e-6f);
  }
}

TEST_SUITE_END();

}  // namespace swell::test
