// What every registered material must satisfy, at several parameters and angles, on every target.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

// Index of the medium on the side of w, for materials with an index inside.
double IndexAt(const MaterialInfo& info, const Params& params, float z) {
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (std::string(info.params[i].name) != "eta" || info.params[i].type != ParamType::kFloat) {
      continue;
    }
    return z > 0.0f ? 1.0 : params[ParamOffset(info, i)];
  }
  return 1.0;
}

// 1, but for materials whose parameters are the scene's word that they scatter more.
double MostScattered(const MaterialInfo& info, const Params& params) {
  if (std::string(info.name) != "diffusetransmission") return 1.0;
  const auto clamped = [&](int word) { return std::fmin(1.0, params[word] * params[6]); };
  return std::fmax(1.0, clamped(0) + clamped(3));
}

}  // namespace

TEST_SUITE_BEGIN("statistical");

TEST_CASE("materials: value, density and weight of a sample agree with Evaluate") {
  constexpr size_t kCount = 1024;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (info.is_specular(set.params.data()) || info.is_estimate()) return;
    for (const Variant& variant : SupportedVariants()) {
      const Directions wo = RandomDirections(kCount, 3);
      const Samples samples =
          Sample(info, variant, set.params, sampling, wo, RandomUniforms(kCount, 4), kCount);
      const Evaluation at = Evaluate(info, variant, set.params, sampling, wo, samples.wi, kCount);
      double worst = 0.0;
      for (size_t i = 0; i < kCount; ++i) {
        if (samples.pdf[i] == 0.0f || std::isinf(samples.pdf[i])) continue;
        worst = std::fmax(worst, std::fabs(at.pdf[i] / samples.pdf[i] - 1.0));
        for (int c = 0; c < 3; ++c) {
          const double value = double{samples.weight[c][i]} * samples.pdf[i];
          worst = std::fmax(worst, std::fabs(at.value[c][i] - value) / (value + 1e-30));
          if (value == 0.0) CHECK(at.value[c][i] == 0.0f);
        }
      }
      INFO(Describe(info, set, sampling), " ", variant.name);
      CHECK(worst < 1e-6);
    }
  });
}

TEST_CASE("materials: none scatters more power than it receives") {
  constexpr size_t kCount = 8192;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    for (const Variant& variant : SupportedVariants()) {
      for (const Direction& view : ViewDirections()) {
        const Samples samples = Sample(info, variant, set.params, sampling, Repeat(view, kCount),
                                       RandomUniforms(kCount, 5), kCount);
        INFO(Describe(info, set, sampling), ", cos ", view.z, " ", variant.name);
        for (int c = 0; c < 3; ++c) {
          double sum = 0.0, squares = 0.0;
          for (size_t i = 0; i < kCount; ++i) {
            // Power, not radiance: eta_scale takes the change of solid angle back.
            const double power = double{samples.weight[c][i]} * samples.eta_scale[i];
            sum += power;
            squares += power * power;
          }
          const double mean = sum / kCount;
          const double error = std::sqrt(std::fmax(0.0, squares / kCount - mean * mean) / kCount);
          CHECK(mean <= MostScattered(info, set.params) + 1e-6 + 5.0 * error);
        }
      }
    }
  });
}

TEST_CASE("materials: reciprocal ones give the same value in both directions") {
  constexpr size_t kCount = 2048;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (!info.reciprocal || info.is_specular(set.params.data()) || info.is_estimate()) return;
    for (const Variant& variant : SupportedVariants()) {
      const Directions a = RandomDirections(kCount, 6), b = RandomDirections(kCount, 7);
      const Evaluation there = Evaluate(info, variant, set.params, sampling, a, b, kCount);
      const Evaluation back = Evaluate(info, variant, set.params, sampling, b, a, kCount);
      INFO(Describe(info, set, sampling), " ", variant.name);
      for (int c = 0; c < 3; ++c) {
        double worst = 0.0;
        for (size_t i = 0; i < kCount; ++i) {
          const double na = IndexAt(info, set.params, a.z[i]);
          const double nb = IndexAt(info, set.params, b.z[i]);
          const double f = there.value[c][i] / std::fabs(b.z[i]) / (na * na);
          const double g = back.value[c][i] / std::fabs(a.z[i]) / (nb * nb);
          // Where a Fresnel share nearly vanishes, its absolute error is small, not its relative
          // one.
          worst = std::fmax(worst, std::fabs(f - g) / (f + g + 0.1));
        }
        CHECK(worst < 3e-5);
      }
    }
  });
}

TEST_CASE("materials: opaque ones scatter nothing to the far side of the surface") {
  constexpr size_t kCount = 4096;
  size_t opaque = 0, others = 0, principled = 0;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    ++(info.is_opaque(set.params.data()) ? opaque : others);
    if (!info.is_opaque(set.params.data())) return;
    principled += std::string(info.name) == "principled";
    for (const Variant& variant : SupportedVariants()) {
      const Directions wo = RandomDirections(kCount, 14);
      Directions behind = RandomDirections(kCount, 15);
      for (size_t i = 0; i < kCount; ++i) {
        behind.z[i] = -std::copysign(behind.z[i], wo.z[i]);
      }
      const Evaluation at = Evaluate(info, variant, set.params, sampling, wo, behind, kCount);
      const Samples samples =
          Sample(info, variant, set.params, sampling, wo, RandomUniforms(kCount, 16), kCount);
      size_t received = 0, passed = 0;
      for (size_t i = 0; i < kCount; ++i) {
        received += at.pdf[i] != 0.0f || at.value[0][i] != 0.0f || at.value[1][i] != 0.0f ||
                    at.value[2][i] != 0.0f;
        passed += samples.pdf[i] > 0.0f && samples.wi.z[i] * wo.z[i] <= 0.0f;
      }
      INFO(Describe(info, set, sampling), " ", variant.name);
      CHECK(received == 0);
      CHECK(passed == 0);
    }
  });
  CHECK(opaque > 30);
  CHECK(others > 30);
  CHECK(principled > 10);
}

TEST_CASE("materials: specular ones evaluate to zero, even in the directions they draw") {
  constexpr size_t kCount = 512;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (!info.is_specular(set.params.data())) return;
    for (const Variant& variant : SupportedVariants()) {
      const Directions wo = RandomDirections(kCount, 8);
      const Samples samples =
          Sample(info, variant, set.params, sampling, wo, RandomUniforms(kCount, 9), kCount);
      const Evaluation at = Evaluate(info, variant, set.params, sampling, wo, samples.wi, kCount);
      INFO(Describe(info, set, sampling), " ", variant.name);
      bool all_zero = true, all_drawn = true;
      for (size_t i = 0; i < kCount; ++i) {
        all_zero &= at.pdf[i] == 0.0f && at.value[0][i] == 0.0f && at.value[1][i] == 0.0f &&
                    at.value[2][i] == 0.0f;
        all_drawn &= std::isinf(samples.pdf[i]) || (info.is_estimate() && samples.pdf[i] == 0.0f);
      }
      CHECK(all_zero);
      CHECK(all_drawn);
    }
  });
}

TEST_CASE("materials: the same bits at every width and target with fused multiply-add") {
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    for (const size_t count :
         {size_t{0}, size_t{1}, size_t{7}, size_t{16}, size_t{17}, size_t{1000}}) {
      const Directions wo = RandomDirections(count, 10), wi = RandomDirections(count, 11);
      const Uniforms uniforms = RandomUniforms(count, 12);
      const Variant* first = nullptr;
      Samples drawn(0);
      Evaluation at(0);
      const std::vector<Variant> variants = SupportedVariants();
      for (const Variant& variant : variants) {
        if (!variant.fused) continue;
        const Samples s = Sample(info, variant, set.params, sampling, wo, uniforms, count);
        const Evaluation e = Evaluate(info, variant, set.params, sampling, wo, wi, count);
        if (first == nullptr) {
          first = &variant;
          drawn = s;
          at = e;
          continue;
        }
        INFO(Describe(info, set, sampling), ": ", first->name, " against ", variant.name);
        const auto same = [&](const std::vector<float>& a, const std::vector<float>& b) {
          return count == 0 || std::memcmp(a.data(), b.data(), count * sizeof(float)) == 0;
        };
        CHECK((same(s.wi.x, drawn.wi.x) && same(s.wi.y, drawn.wi.y) && same(s.wi.z, drawn.wi.z)));
        CHECK((same(s.pdf, drawn.pdf) && same(s.eta_scale, drawn.eta_scale)));
        CHECK(same(e.pdf, at.pdf));
        for (int c = 0; c < 3; ++c) {
          CHECK(same(s.weight[c], drawn.weight[c]));
          CHECK(same(e.value[c], at.value[c]));
        }
      }
    }
  });
}

TEST_CASE("materials: extreme numbers draw unit directions with a density, or nothing") {
  const float extremes[] = {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f};
  Uniforms uniforms(64);
  for (size_t i = 0; i < 64; ++i) {
    for (int d = 0; d < 3; ++d) uniforms.u[d][i] = extremes[(i >> (2 * d)) & 3];
  }
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    for (const Variant& variant : SupportedVariants()) {
      for (const Direction& view : ViewDirections()) {
        const Samples s =
            Sample(info, variant, set.params, sampling, Repeat(view, 64), uniforms, 64);
        INFO(Describe(info, set, sampling), ", cos ", view.z, " ", variant.name);
        for (size_t i = 0; i < 64; ++i) {
          const Direction wi = s.wi.Get(i);
          CHECK(Dot(wi, wi) == doctest::Approx(1.0).epsilon(1e-5));
          CHECK((s.pdf[i] >= 0.0f));  // and not NaN
          if (s.pdf[i] == 0.0f) CHECK(s.weight[0][i] == 0.0f);
          if (s.pdf[i] > 0.0f) CHECK(s.wi.z[i] != 0.0f);
        }
      }
    }
  });
}

TEST_CASE("materials: a view in the surface or not a number scatters nothing") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float heights[] = {0.0f, -0.0f, nan};
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    for (const Variant& variant : SupportedVariants()) {
      for (const float height : heights) {
        const Directions wo = Repeat({1.0, 0.0, height}, 32), wi = RandomDirections(32, 13);
        const Samples s =
            Sample(info, variant, set.params, sampling, wo, RandomUniforms(32, 14), 32);
        const Evaluation e = Evaluate(info, variant, set.params, sampling, wo, wi, 32);
        const Evaluation back = Evaluate(info, variant, set.params, sampling, wi, wo, 32);
        INFO(Describe(info, set, sampling), " ", variant.name, ", height ", height);
        for (size_t i = 0; i < 32; ++i) {
          CHECK(std::isfinite(s.wi.x[i] + s.wi.y[i] + s.wi.z[i]));
          CHECK((s.pdf[i] == 0.0f && e.pdf[i] == 0.0f && back.pdf[i] == 0.0f));
          for (int c = 0; c < 3; ++c) {
            CHECK((s.weight[c][i] == 0.0f && e.value[c][i] == 0.0f && back.value[c][i] == 0.0f));
          }
        }
      }
    }
  });
}

TEST_SUITE_END();

}  // namespace swell::test
