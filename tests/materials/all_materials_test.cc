// What every registered material must satisfy, at several parameters and angles, on every target.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <set>
#include <string>

#include "tests/materials/material_support.h"
#include "tests/materials/statistics.h"

namespace swell::test {
namespace {

// Calls f(info, set, sampling) for every registered material.
template <class F> void ForEachMaterial(const F& f) {
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    const MaterialInfo& info = *kMaterialKinds[i];
    for (const ParamSet& set : ParamSets(info)) {
      for (const DiffuseSampling sampling : Samplings(info)) f(info, set, sampling);
    }
  }
}

std::string Describe(const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
  return std::string(info.name) + " " + set.label + ", way " +
         std::to_string(static_cast<int>(sampling));
}

Direction Mirrored(const Direction& wo) { return {-wo.x, -wo.y, wo.z}; }

// Where a material's density is known to be singular: the ring at sin = fuzz around the mirror
// direction, blurred by the rounding of directions.
Rim RimOf(const MaterialInfo& info, const Params& params) {
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (std::string(info.params[i].name) != "fuzz") continue;
    const double fuzz = params[ParamOffset(info, i)];
    return {fuzz * fuzz, 4e-7 * fuzz};
  }
  return {};
}

// Materials that document that a part of what they draw is lost below the surface.
bool Absorbs(const MaterialInfo& info) { return std::string(info.name) != "diffuse"; }

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

struct Fit {
  double p_value;
  double integral;      // of the pdf over the sphere
  double scattered;     // share of samples that are not void
  std::string subject;  // what was tested
};

// Mean direction of what a few samples send to the other side; straight on if nothing is.
Direction MeanBeyond(const MaterialInfo& info, const Variant& variant, const ParamSet& set,
                     DiffuseSampling sampling, const Direction& view) {
  constexpr size_t kCount = 1024;
  const Samples s = Sample(info, variant, set.params, sampling, Repeat(view, kCount),
                           RandomUniforms(kCount, 99), kCount);
  Direction sum = {0, 0, 0};
  for (size_t i = 0; i < kCount; ++i) {
    if (s.pdf[i] == 0.0f || s.wi.z[i] * view.z > 0.0) continue;
    sum = {sum.x + s.wi.x[i], sum.y + s.wi.y[i], sum.z + s.wi.z[i]};
  }
  const double length = std::sqrt(Dot(sum, sum));
  if (length == 0.0) return {-view.x, -view.y, -view.z};
  return {sum.x / length, sum.y / length, sum.z / length};
}

Fit FitSamples(const MaterialInfo& info, const Variant& variant, const ParamSet& set,
               DiffuseSampling sampling, const Direction& view, size_t count, uint64_t seed) {
  const Directions wo = Repeat(view, count);
  const Samples samples =
      Sample(info, variant, set.params, sampling, wo, RandomUniforms(count, seed), count);
  const Direction stored = wo.Get(0);  // as rounded to single precision
  const double length = std::sqrt(Dot(stored, stored));
  const Direction mirrored = Mirrored(stored);
  // The view's side is cut around the mirror direction, the other one around its lobe.
  const SphereBins near({mirrored.x / length, mirrored.y / length, mirrored.z / length},
                        RimOf(info, set.params));
  const SphereBins far(MeanBeyond(info, variant, set, sampling, view), {});

  std::vector<double> observed(near.count() + far.count(), 0.0);
  size_t scattered = 0;
  for (size_t i = 0; i < count; ++i) {
    const Direction wi = samples.wi.Get(i);
    if (samples.pdf[i] == 0.0f) continue;
    ++scattered;
    observed[wi.z * view.z > 0.0 ? near.Find(wi) : near.count() + far.Find(wi)] += 1.0;
  }
  const auto density_on = [&](double side) {
    return [&, side](const Directions& wi, size_t rows) {
      std::vector<float> pdf =
          Evaluate(info, variant, set.params, sampling, Repeat(view, rows), wi, rows).pdf;
      for (size_t i = 0; i < rows; ++i) pdf[i] = wi.z[i] * side > 0.0 ? pdf[i] : 0.0f;
      return pdf;
    };
  };
  std::vector<double> expected = near.Integrate(density_on(view.z));
  const std::vector<double> beyond = far.Integrate(density_on(-view.z));
  expected.insert(expected.end(), beyond.begin(), beyond.end());
  // The shape here; the mass, integral against scattered share, is the caller's.
  const double integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  for (double& e : expected) e *= static_cast<double>(scattered) / integral;
  return {ChiSquarePValue(observed, expected), integral,
          static_cast<double>(scattered) / static_cast<double>(count),
          Describe(info, set, sampling) + ", cos " + std::to_string(view.z) + ", " + variant.name};
}

// Tells parameter sets apart that draw differently: tints do not.
std::vector<float> Fingerprint(const MaterialInfo& info, const ParamSet& set,
                               DiffuseSampling sampling) {
  constexpr size_t kCount = 64;
  const Samples s = Sample(info, SupportedVariants()[0], set.params, sampling,
                           RandomDirections(kCount, 1), RandomUniforms(kCount, 2), kCount);
  std::vector<float> print;
  for (const std::vector<float>* column : {&s.wi.x, &s.wi.y, &s.wi.z, &s.pdf}) {
    print.insert(print.end(), column->begin(), column->end());
  }
  return print;
}

}  // namespace

TEST_SUITE_BEGIN("statistical");

TEST_CASE("materials: samples follow the density, which integrates to what is scattered") {
  constexpr size_t kCount = 60000;
  std::vector<Fit> fits;
  std::set<std::vector<float>> tested;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (info.is_specular(set.params.data())) return;
    if (!tested.insert(Fingerprint(info, set, sampling)).second) return;
    for (const Variant& variant : SupportedVariants()) {
      for (const Direction& view : ViewDirections()) {
        const Fit fit = FitSamples(info, variant, set, sampling, view, kCount, 17 + fits.size());
        INFO(fit.subject);
        // Five standard deviations, and what the quadrature leaves at the horizon.
        const double sigma = std::sqrt(fit.scattered * (1.0 - fit.scattered) / kCount);
        CHECK(fit.integral == doctest::Approx(fit.scattered).epsilon(5.0 * sigma + 1e-3));
        if (!Absorbs(info)) CHECK(fit.integral == doctest::Approx(1.0).epsilon(1e-3));
        fits.push_back(fit);
      }
    }
  });
  REQUIRE(fits.size() > 0);
  const double threshold = SidakThreshold(0.01, fits.size());
  for (const Fit& fit : fits) {
    INFO(fit.subject);
    CHECK(fit.p_value > threshold);
  }
}

TEST_CASE("materials: value, density and weight of a sample agree with Evaluate") {
  constexpr size_t kCount = 1024;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (info.is_specular(set.params.data())) return;
    for (const Variant& variant : SupportedVariants()) {
      const Directions wo = RandomDirections(kCount, 3);
      const Samples samples =
          Sample(info, variant, set.params, sampling, wo, RandomUniforms(kCount, 4), kCount);
      const Evaluation at = Evaluate(info, variant, set.params, sampling, wo, samples.wi, kCount);
      double worst = 0.0;
      for (size_t i = 0; i < kCount; ++i) {
        if (samples.pdf[i] == 0.0f) continue;
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
          CHECK(mean <= 1.0 + 1e-6 + 5.0 * error);
        }
      }
    }
  });
}

TEST_CASE("materials: reciprocal ones give the same value in both directions") {
  constexpr size_t kCount = 2048;
  ForEachMaterial([&](const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
    if (!info.reciprocal || info.is_specular(set.params.data())) return;
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
        all_drawn &= samples.pdf[i] == 1.0f;
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
          CHECK(std::isfinite(s.pdf[i]));
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
