// Layered materials' values and samples against a plain walk in double precision, and both ways.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/materials/material_support.h"
#include "tests/reference/layered.h"

namespace swell::test {
namespace {

using reference::LayeredModel;

constexpr auto kDisk = DiffuseSampling::kDisk;

struct Case {
  std::string label, material;
  LayeredModel model;
  Params params;
};

// Sets the material's parameters to what the model says; roughness is alpha itself.
Case MakeCase(const std::string& label, const LayeredModel& model) {
  const char* name = model.metal ? "coatedconductor" : "coateddiffuse";
  const MaterialInfo& info = FindMaterial(name);
  Params params = Defaults(info);
  const auto set = [&](const std::string& param, double value) {
    SetParam(info, param.c_str(), static_cast<float>(value), &params);
  };
  const std::string prefix = model.metal ? "interface." : "";
  set("remaproughness", 0.0);
  set(prefix + "eta", model.eta);
  set(prefix + "uroughness", model.coat.x);
  set(prefix + "vroughness", model.coat.y);
  set("thickness", model.thickness);
  set("albedo", model.albedo);
  set("g", model.g);
  set("maxdepth", model.max_events);
  if (model.metal) {
    set("conductor.eta", model.metal_eta);
    set("conductor.k", model.metal_k);
    set("conductor.uroughness", model.ground.x);
    set("conductor.vroughness", model.ground.y);
  } else {
    set("reflectance", model.reflectance);
  }
  return {label, name, model, params};
}

std::vector<Case> Cases() {
  const LayeredModel plastic;
  LayeredModel rough = plastic;
  rough.coat = {0.3, 0.3};
  LayeredModel cloudy = rough;
  cloudy.thickness = 0.5, cloudy.albedo = 0.7, cloudy.g = 0.5;
  LayeredModel brushed = plastic;
  brushed.metal = true, brushed.metal_eta = 0.5, brushed.metal_k = 3.0, brushed.ground = {0.3, 0.3};
  LayeredModel satin = brushed;
  satin.coat = {0.2, 0.2}, satin.ground = {};
  LayeredModel all = brushed;
  all.coat = {0.1, 0.4}, all.thickness = 1.0, all.albedo = 0.5, all.g = -0.3;
  LayeredModel fog = satin;
  fog.coat = {}, fog.thickness = 1.0, fog.albedo = 0.8;
  std::vector<Case> cases = {MakeCase("plastic", plastic),       MakeCase("rough plastic", rough),
                             MakeCase("cloudy plastic", cloudy), MakeCase("brushed", brushed),
                             MakeCase("satin", satin),           MakeCase("all at once", all),
                             MakeCase("fog on a mirror", fog)};
  SetParam(FindMaterial("coatedconductor"), "nsamples", 3.0f, &cases[5].params);
  return cases;
}

// Means and their squared standard errors of what leaves in each part of the upper hemisphere, and
// of what no light sampling finds.
struct Tally {
  static constexpr int kRings = 4, kSectors = 4;
  static constexpr int kBins = kRings * kSectors + 1;
  double sum[kBins] = {}, squares[kBins] = {};
  size_t count = 0;

  static int Bin(const Direction& wi) {
    const double turn = std::atan2(wi.y, wi.x) / (2.0 * M_PI) + 0.5;
    const int ring = std::min(static_cast<int>(wi.z * kRings), kRings - 1);
    return ring * kSectors + std::min(static_cast<int>(turn * kSectors), kSectors - 1);
  }
  void Add(int bin, double weight) {
    sum[bin] += weight;
    squares[bin] += weight * weight;
  }
  double Mean(int bin) const { return sum[bin] / static_cast<double>(count); }
  double Variance(int bin) const {
    const auto n = static_cast<double>(count);
    return (squares[bin] / n - Mean(bin) * Mean(bin)) / n;
  }
};

Tally WalkReference(const LayeredModel& model, const Direction& view, size_t count) {
  std::mt19937_64 random(71);
  Tally tally;
  tally.count = count;
  for (size_t i = 0; i < count; ++i) {
    const reference::LayeredExit exit =
        reference::WalkLayers(model, {view.x, view.y, view.z}, random);
    if (exit.weight == 0.0) continue;
    tally.Add(exit.specular
                  ? Tally::kBins - 1
                  : Tally::Bin({static_cast<double>(exit.wi.x), static_cast<double>(exit.wi.y),
                                static_cast<double>(exit.wi.z)}),
              exit.weight);
  }
  return tally;
}

Tally TallySamples(const Case& c, const Variant& variant, const Direction& view, size_t count) {
  const Samples s = Sample(FindMaterial(c.material), variant, c.params, kDisk, Repeat(view, count),
                           RandomUniforms(count, 72), count);
  Tally tally;
  tally.count = count;
  for (size_t i = 0; i < count; ++i) {
    if (s.pdf[i] == 0.0f) continue;
    tally.Add(std::isinf(s.pdf[i]) ? Tally::kBins - 1 : Tally::Bin(s.wi.Get(i)), s.weight[0][i]);
  }
  return tally;
}

// By values in directions that are uniform over the hemisphere.
Tally TallyValues(const Case& c, const Variant& variant, const Direction& view, size_t count) {
  Directions wi = RandomDirections(count, 73);
  for (float& z : wi.z) z = std::fabs(z);
  const Evaluation at = Evaluate(FindMaterial(c.material), variant, c.params, kDisk,
                                 Repeat(view, count), wi, count, 74);
  Tally tally;
  tally.count = count;
  for (size_t i = 0; i < count; ++i) {
    tally.Add(Tally::Bin(wi.Get(i)), 2.0 * M_PI * at.value[0][i]);
  }
  return tally;
}

// The largest difference of two tallies, in standard errors; tiny means need more than chance.
double Worst(const Tally& a, const Tally& b, int bins) {
  double worst = 0.0;
  for (int bin = 0; bin < bins; ++bin) {
    const double error = std::sqrt(a.Variance(bin) + b.Variance(bin)) + 1e-5;
    worst = std::fmax(worst, std::fabs(a.Mean(bin) - b.Mean(bin)) / error);
  }
  return worst;
}

}  // namespace

TEST_SUITE_BEGIN("statistical");

TEST_CASE("layered: samples and values leave as much in every direction as plain walks do") {
  constexpr size_t kCount = 1 << 16;
  for (const Case& c : Cases()) {
    for (const Direction& view : {FromAngles(0.95, 0.4), FromAngles(0.4, 2.5)}) {
      const Tally expected = WalkReference(c.model, view, 4 * kCount);
      const bool lights = !FindMaterial(c.material).is_specular(c.params.data());
      REQUIRE(lights);
      for (const Variant& variant : SupportedVariants()) {
        INFO(c.label, ", cos ", view.z, " ", variant.name);
        const Tally samples = TallySamples(c, variant, view, kCount);
        CHECK(Worst(samples, expected, Tally::kBins) < 5.0);
        const Tally values = TallyValues(c, variant, view, 2 * kCount);
        CHECK(Worst(values, expected, Tally::kBins - 1) < 5.0);
      }
    }
  }
}

TEST_CASE("layered: the mean value is the same in both directions, and from below") {
  constexpr size_t kCount = 1 << 15;
  const Direction a = FromAngles(0.9, 0.3), b = FromAngles(0.5, 2.0);
  const Direction under_a = {-a.x, -a.y, -a.z}, under_b = {-b.x, -b.y, -b.z};
  for (const Case& c : Cases()) {
    const MaterialInfo& info = FindMaterial(c.material);
    for (const Variant& variant : SupportedVariants()) {
      INFO(c.label, " ", variant.name);
      // Mean and squared standard error of f.
      const auto value = [&](const Direction& wo, const Direction& wi, uint32_t seed) {
        const Evaluation at = Evaluate(info, variant, c.params, kDisk, Repeat(wo, kCount),
                                       Repeat(wi, kCount), kCount, seed);
        double sum = 0.0, squares = 0.0;
        for (size_t i = 0; i < kCount; ++i) {
          const double f = at.value[0][i] / std::fabs(wi.z);
          sum += f;
          squares += f * f;
        }
        const double mean = sum / kCount;
        return std::pair{mean, (squares / kCount - mean * mean) / kCount};
      };
      const auto there = value(a, b, 1), back = value(b, a, 2), under = value(under_a, under_b, 1);
      CHECK(there.first > 1e-4);
      CHECK(std::fabs(there.first - back.first) < 5.0 * std::sqrt(there.second + back.second));
      CHECK(under.first == there.first);
      CHECK(value(a, under_b, 3).first == 0.0);
    }
  }
}

TEST_CASE("layered: the density that weighs samples integrates to about their share") {
  for (const Case& c : Cases()) {
    const MaterialInfo& info = FindMaterial(c.material);
    constexpr size_t kCount = 1 << 14;
    Directions wi = RandomDirections(kCount, 75);
    for (float& z : wi.z) z = std::fabs(z);
    const Variant variant = SupportedVariants()[0];
    INFO(c.label);
    for (const double cosine : {0.9, 0.3}) {
      const Evaluation at = Evaluate(info, variant, c.params, kDisk,
                                     Repeat(FromAngles(cosine, 0.1), kCount), wi, kCount);
      double sum = 0.0;
      for (size_t i = 0; i < kCount; ++i) sum += at.pdf[i] * 2.0 * M_PI / kCount;
      CHECK(sum > 0.09);
      CHECK(sum < 1.6);
    }
  }
}

TEST_SUITE_END();

}  // namespace swell::test
