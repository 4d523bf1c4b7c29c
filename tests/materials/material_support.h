// What the material tests share: targets and widths, columns, parameter sets, directions, numbers.
#ifndef SWELL_TESTS_MATERIALS_MATERIAL_SUPPORT_H_
#define SWELL_TESTS_MATERIALS_MATERIAL_SUPPORT_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/material.h"

namespace swell::test {

// One compilation of a kernel that this machine can run.
struct Variant {
  std::string name;
  int64_t target;  // HWY_* bit
  Width width;
  bool fused;  // has fused multiply-add: all such variants agree to the bit
};
std::vector<Variant> SupportedVariants();

// While it lives, kernels run on the variant's target.
class TargetScope {
 public:
  explicit TargetScope(const Variant& variant);
  ~TargetScope();
  TargetScope(const TargetScope&) = delete;
  TargetScope& operator=(const TargetScope&) = delete;
};

using Params = std::array<float, kMaterialWords>;
struct ParamSet {
  std::string label;
  Params params;
};
// The defaults; then every parameter in turn at both ends and inside its range, the rest default.
// Materials with a roughness: once from a smooth and once from a rough surface.
std::vector<ParamSet> ParamSets(const MaterialInfo& info);
Params Defaults(const MaterialInfo& info);
// Sets a parameter by name; all three words of a colour.
void SetParam(const MaterialInfo& info, const char* name, float value, Params* params);
const MaterialInfo& FindMaterial(const std::string& name);

struct Direction {
  double x, y, z;
};
Direction FromAngles(double cos_theta, double phi);
double Dot(const Direction& a, const Direction& b);

// Rows of directions, padded as kernels need it.
struct Directions {
  std::vector<float> x, y, z;
  explicit Directions(size_t count);
  void Set(size_t row, const Direction& d);
  Direction Get(size_t row) const { return {x[row], y[row], z[row]}; }
  Vec3Fields<In> in() const { return {x.data(), y.data(), z.data()}; }
  Vec3Fields<Out> out() { return {x.data(), y.data(), z.data()}; }
};

struct Evaluation {
  std::vector<float> value[3], pdf;
  explicit Evaluation(size_t count);
};
struct Samples {
  Directions wi;
  std::vector<float> weight[3], pdf, eta_scale;
  explicit Samples(size_t count);
};
struct Uniforms {
  std::vector<float> u[3];
  explicit Uniforms(size_t count);
};
// `count` triples of independent numbers in [0, 1), multiples of 2^-24.
Uniforms RandomUniforms(size_t count, uint64_t seed);

Evaluation Evaluate(const MaterialInfo& info, const Variant& variant, const Params& params,
                    DiffuseSampling sampling, const Directions& wo, const Directions& wi,
                    size_t count, uint32_t seed = 0);
Samples Sample(const MaterialInfo& info, const Variant& variant, const Params& params,
               DiffuseSampling sampling, const Directions& wo, const Uniforms& uniforms,
               size_t count);
Directions Repeat(const Direction& d, size_t count);
// Uniform on the whole sphere.
Directions RandomDirections(size_t count, uint64_t seed);

// Ways of drawing that the material knows: all four for diffuse, else one.
std::vector<DiffuseSampling> Samplings(const MaterialInfo& info);

// For messages.
std::string Describe(const MaterialInfo& info, const ParamSet& set, DiffuseSampling sampling);

// Calls f(info, set, sampling) for every registered material.
template <class F> void ForEachMaterial(const F& f) {
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    const MaterialInfo& info = *kMaterialKinds[i];
    for (const ParamSet& set : ParamSets(info)) {
      for (const DiffuseSampling sampling : Samplings(info)) f(info, set, sampling);
    }
  }
}

// Directions of view for the statistical tests: from the normal to grazing, both sides.
const std::vector<Direction>& ViewDirections();

}  // namespace swell::test

#endif  // SWELL_TESTS_MATERIALS_MATERIAL_SUPPORT_H_
