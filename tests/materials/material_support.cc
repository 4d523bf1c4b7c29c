// Implements material_support.h.
#include "tests/materials/material_support.h"

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "src/base/check.h"

namespace swell::test {

std::vector<Variant> SupportedVariants() {
  const int64_t supported = hwy::SupportedTargets() | HWY_SCALAR;
  const Variant all[] = {
      {"wide AVX-512", HWY_AVX3, Width::kWide, true},
      {"wide AVX2", HWY_AVX2, Width::kWide, true},
      {"wide SSE4", HWY_SSE4, Width::kWide, false},
      {"wide NEON", HWY_NEON, Width::kWide, true},
      {"wide scalar", HWY_SCALAR, Width::kWide, false},
      {"one lane AVX2", HWY_AVX2, Width::kOneLane, true},
      {"one lane NEON", HWY_NEON, Width::kOneLane, true},
      {"one lane scalar", HWY_SCALAR, Width::kOneLane, false},
  };
  std::vector<Variant> variants;
  for (const Variant& variant : all) {
    if ((variant.target & supported) != 0) variants.push_back(variant);
  }
  return variants;
}

TargetScope::TargetScope(const Variant& variant) {
  hwy::SetSupportedTargetsForTest(variant.target);
  hwy::GetChosenTarget().Update(variant.target);
}
TargetScope::~TargetScope() {
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

Params Defaults(const MaterialInfo& info) {
  Params params{};
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const uint32_t words = info.params[i].type == ParamType::kRgb ? 3 : 1;
    for (uint32_t w = 0; w < words; ++w) {
      params[ParamOffset(info, i) + w] = info.params[i].fallback[w];
    }
  }
  return params;
}

namespace {
// "roughness" of a material's only surface, "conductor.roughness" of one of them.
bool IsNamed(const ParamSpec& spec, std::string_view name) {
  const std::string_view own = spec.name;
  return own == name || own.ends_with("." + std::string(name));
}

bool IsPrincipled(const MaterialInfo& info) { return std::string_view(info.name) == "principled"; }

// Every parameter but `skipped` in turn at both ends and inside its range, the rest as in base.
void AddVariations(const MaterialInfo& info, const ParamSet& base,
                   const std::vector<std::string_view>& skipped, std::vector<ParamSet>* sets) {
  sets->push_back(base);
  const auto add = [&](const ParamSpec& spec, uint32_t at, const auto& value) {
    ParamSet set = base;
    const uint32_t words = spec.type == ParamType::kRgb ? 3 : 1;
    for (uint32_t w = 0; w < words; ++w) set.params[at + w] = value(w);
    set.label += std::string(" ") + spec.name + "=" + std::to_string(set.params[at]);
    sets->push_back(set);
  };
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const ParamSpec& spec = info.params[i];
    const uint32_t at = ParamOffset(info, i);
    const auto named = [&](std::string_view name) { return IsNamed(spec, name); };
    if (std::any_of(skipped.begin(), skipped.end(), named)) continue;
    if (spec.type == ParamType::kChoice) {
      for (uint32_t n = 0; n < spec.named_count; ++n) {
        add(spec, at, [&](uint32_t) { return spec.named[n].value[0]; });
      }
    } else if (spec.type == ParamType::kInt) {  // larger ones only take longer
      for (const float value : {spec.min, 2.0f * spec.fallback[0] + 1.0f}) {
        add(spec, at, [&](uint32_t) { return value; });
      }
    } else if (spec.type == ParamType::kBool) {
      for (const float value : {0.0f, 1.0f}) add(spec, at, [&](uint32_t) { return value; });
    } else {
      // Its roughness is the root of alpha; thinner lobes than of alpha 0.1 escape the quadrature.
      for (const float share : {0.0f, IsPrincipled(info) ? 0.35f : 0.1f, 0.6f, 1.0f}) {
        add(spec, at, [&](uint32_t w) {
          return spec.min + (spec.max - spec.min) * share / static_cast<float>(1 + w);
        });
      }
    }
  }
}
}  // namespace

std::vector<ParamSet> ParamSets(const MaterialInfo& info) {
  std::vector<ParamSet> sets;
  ParamSet base = {"defaults", Defaults(info)};
  ParamSet rough = {"rough", base.params};
  bool has_roughness = false;
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (!IsNamed(info.params[i], "roughness")) continue;
    rough.params[ParamOffset(info, i)] = 0.3f;
    has_roughness = true;
  }
  if (IsPrincipled(info)) {
    AddVariations(info, base, {}, &sets);
    // All of glTF's kinds of surface in one.
    for (const float roughness : {0.0f, 0.35f, 0.7f}) {
      base.label = "all in one, roughness " + std::to_string(roughness);
      SetParam(info, "base_color", 0.8f, &base.params);
      SetParam(info, "metallic", 0.3f, &base.params);
      SetParam(info, "roughness", roughness, &base.params);
      SetParam(info, "transmission", 0.4f, &base.params);
      SetParam(info, "clearcoat", 0.7f, &base.params);
      SetParam(info, "clearcoat_roughness", 0.7f - roughness, &base.params);
      SetParam(info, "sheen_color", 0.6f, &base.params);
      SetParam(info, "sheen_roughness", 0.4f, &base.params);
      sets.push_back(base);
    }
    base.label = "all in one, a coat of its own normal";
    SetParam(info, "clearcoat_normal", 0.8f, &base.params);
    sets.push_back(base);
    return sets;
  }
  if (!has_roughness) {
    AddVariations(info, base, {}, &sets);
    return sets;
  }
  // Roughness chooses between two models: vary the rest in both. A surface that is rough in one
  // direction alone scatters into a line too thin for the quadrature.
  AddVariations(info, base, {"uroughness", "vroughness"}, &sets);
  AddVariations(info, rough, {"roughness"}, &sets);
  return sets;
}

void SetParam(const MaterialInfo& info, const char* name, float value, Params* params) {
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (std::string_view(info.params[i].name) != name) continue;
    const uint32_t words = info.params[i].type == ParamType::kRgb ? 3 : 1;
    for (uint32_t w = 0; w < words; ++w) (*params)[ParamOffset(info, i) + w] = value;
    return;
  }
  SWELL_CHECK(!"a parameter of this name");
}

const MaterialInfo& FindMaterial(const std::string& name) {
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    if (name == kMaterialKinds[i]->name) return *kMaterialKinds[i];
  }
  SWELL_CHECK(!"a material of this name");
  return *kMaterialKinds[0];
}

Direction FromAngles(double cos_theta, double phi) {
  const double sin_theta = std::sqrt(std::fmax(0.0, 1.0 - cos_theta * cos_theta));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}
double Dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

namespace {
std::vector<float> Column(size_t count) { return std::vector<float>(RoundUpToPadding(count)); }
}  // namespace

Directions::Directions(size_t count) : x(Column(count)), y(Column(count)), z(Column(count)) {}
void Directions::Set(size_t row, const Direction& d) {
  x[row] = static_cast<float>(d.x);
  y[row] = static_cast<float>(d.y);
  z[row] = static_cast<float>(d.z);
}
Evaluation::Evaluation(size_t count)
    : value{Column(count), Column(count), Column(count)}, pdf(Column(count)) {}
Samples::Samples(size_t count)
    : wi(count),
      weight{Column(count), Column(count), Column(count)},
      pdf(Column(count)),
      eta_scale(Column(count)) {}
Uniforms::Uniforms(size_t count) : u{Column(count), Column(count), Column(count)} {}

Uniforms RandomUniforms(size_t count, uint64_t seed) {
  Uniforms uniforms(count);
  std::mt19937_64 engine(seed);
  for (std::vector<float>& column : uniforms.u) {
    for (float& u : column) u = static_cast<float>(engine() >> 40) * 0x1p-24f;
  }
  return uniforms;
}

Evaluation Evaluate(const MaterialInfo& info, const Variant& variant, const Params& params,
                    DiffuseSampling sampling, const Directions& wo, const Directions& wi,
                    size_t count, uint32_t seed) {
  Evaluation result(count);
  BsdfQuery query{};
  query.params = params.data();
  query.settings.diffuse_sampling = sampling;
  query.wo = wo.in();
  query.wi = wi.in();
  query.count = count;
  query.seed = seed;
  query.value = {result.value[0].data(), result.value[1].data(), result.value[2].data()};
  query.pdf = result.pdf.data();
  const TargetScope scope(variant);
  info.evaluate(variant.width, query);
  return result;
}

Samples Sample(const MaterialInfo& info, const Variant& variant, const Params& params,
               DiffuseSampling sampling, const Directions& wo, const Uniforms& uniforms,
               size_t count) {
  Samples result(count);
  BsdfQuery query{};
  query.params = params.data();
  query.settings.diffuse_sampling = sampling;
  query.wo = wo.in();
  for (int d = 0; d < 3; ++d) query.u[d] = uniforms.u[d].data();
  query.count = count;
  query.sampled_wi = result.wi.out();
  query.value = {result.weight[0].data(), result.weight[1].data(), result.weight[2].data()};
  query.pdf = result.pdf.data();
  query.eta_scale = result.eta_scale.data();
  const TargetScope scope(variant);
  info.sample(variant.width, query);
  return result;
}

Directions Repeat(const Direction& d, size_t count) {
  Directions directions(count);
  for (size_t i = 0; i < directions.x.size(); ++i) directions.Set(i, d);
  return directions;
}

Directions RandomDirections(size_t count, uint64_t seed) {
  Directions directions(count);
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  for (size_t i = 0; i < directions.x.size(); ++i) {
    const double cos_theta = 1.0 - 2.0 * uniform();
    directions.Set(i, FromAngles(cos_theta, 2.0 * M_PI * uniform()));
  }
  return directions;
}

std::vector<DiffuseSampling> Samplings(const MaterialInfo& info) {
  if (std::string_view(info.name) != "diffuse") return {DiffuseSampling::kDisk};
  return {DiffuseSampling::kDisk, DiffuseSampling::kNormalPlusSphere,
          DiffuseSampling::kNormalPlusRejectedSphere, DiffuseSampling::kNormalPlusGaussian};
}

std::string Describe(const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling) {
  return std::string(info.name) + " " + set.label + ", way " +
         std::to_string(static_cast<int>(sampling));
}

const std::vector<Direction>& ViewDirections() {
  static const std::vector<Direction> directions = {
      FromAngles(1.0, 0.0), FromAngles(0.9, 0.3),  FromAngles(0.6, 2.0),   FromAngles(0.3, 4.0),
      FromAngles(0.1, 5.5), FromAngles(0.01, 1.0), FromAngles(-0.7, -1.0), FromAngles(-0.05, 3.0),
  };
  return directions;
}

}  // namespace swell::test
