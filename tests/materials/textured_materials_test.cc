// Parameters that vary from row to row: each row behaves as if they were constant.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/materials/material_support.h"

namespace swell::test {
namespace {

constexpr size_t kCount = 64;

// Values inside the range of a parameter, far from those that change what kind of surface it is.
float ValueOf(const ParamSpec& spec, size_t row) {
  const float low = std::max(spec.min, 0.0f), high = std::min(spec.max, 4.0f);
  return low + (high - low) * (0.2f + 0.6f * float(row % 7) / 7);
}

// The defaults, but rough.
Params RoughDefaults(const MaterialInfo& info) {
  Params params = Defaults(info);
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const std::string name = info.params[i].name;
    const bool roughness = name.size() >= 9 && name.substr(name.size() - 9) == "roughness" &&
                           info.params[i].type == ParamType::kFloat &&
                           info.params[i].fallback[0] >= 0.0f;
    if (roughness) params[ParamOffset(info, i)] = 0.4f;
  }
  return params;
}

struct Rows {
  std::vector<float> value[3], pdf;
};

Rows EvaluateRow(const MaterialInfo& info, const Variant& variant, const Params& params,
                 const float* const* columns, const Directions& wo, const Directions& wi) {
  Rows rows;
  for (auto* column : {&rows.value[0], &rows.value[1], &rows.value[2], &rows.pdf}) {
    column->resize(RoundUpToPadding(kCount) + kRowPadding);
  }
  BsdfQuery query{};
  query.params = params.data();
  query.wo = wo.in();
  query.wi = wi.in();
  query.count = kCount;
  query.value = {rows.value[0].data(), rows.value[1].data(), rows.value[2].data()};
  query.pdf = rows.pdf.data();
  query.columns = columns;
  const TargetScope scope(variant);
  info.evaluate(variant.width, query);
  return rows;
}

}  // namespace

TEST_SUITE_BEGIN("statistical");

TEST_CASE("materials: all can be textured") {
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    INFO(std::string(kMaterialKinds[i]->name));
    CHECK(kMaterialKinds[i]->takes_columns());
  }
}

TEST_CASE("materials: a textured parameter acts row by row as its constant would") {
  const Directions wo = RandomDirections(kCount, 8), wi = RandomDirections(kCount, 9);
  for (uint32_t m = 0; m < kMaterialKindCount; ++m) {
    const MaterialInfo& info = *kMaterialKinds[m];
    for (uint32_t p = 0; p < info.param_count; ++p) {
      const ParamSpec& spec = info.params[p];
      if (spec.type != ParamType::kFloat && spec.type != ParamType::kRgb) continue;
      const uint32_t first = ParamOffset(info, p), words = spec.type == ParamType::kRgb ? 3 : 1;
      Params typical = RoughDefaults(info);
      std::vector<float> column(RoundUpToPadding(kCount) + kRowPadding, 0.5f);
      for (size_t row = 0; row < kCount; ++row) column[row] = ValueOf(spec, row);
      const float* columns[kMaterialWords] = {};
      for (uint32_t w = first; w < first + words; ++w) {
        columns[w] = column.data();
        typical[w] = ValueOf(spec, 3);
      }
      for (const Variant& variant : SupportedVariants()) {
        const Rows textured = EvaluateRow(info, variant, typical, columns, wo, wi);
        for (size_t row = 0; row < 7; ++row) {
          Params constant = typical;
          for (uint32_t w = first; w < first + words; ++w) constant[w] = ValueOf(spec, row);
          const Rows expected = EvaluateRow(info, variant, constant, nullptr, wo, wi);
          for (size_t i = row; i < kCount; i += 7) {
            INFO(std::string(info.name), " ", spec.name, " ", variant.name, ", row ", i);
            for (int c = 0; c < 3; ++c) REQUIRE(textured.value[c][i] == expected.value[c][i]);
            REQUIRE(textured.pdf[i] == expected.pdf[i]);
          }
        }
      }
    }
  }
}

TEST_SUITE_END();

}  // namespace swell::test
