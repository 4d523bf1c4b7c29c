// A registry of the material kinds that importers ask for by name, without their kernels: fuzzers
// are of importers alone.
#include <iterator>

#include "kernels/material.h"
#include "kernels/microfacet_params.h"
#include "kernels/principled_params.h"

namespace swell {
namespace {

constexpr NamedValue kNames[] = {{"Cu", {0.2f, 0.9f, 1.1f}}, {"glass-BK7", {1.5f, 1.5f, 1.5f}}};
constexpr ParamSpec kDiffuseParams[] = {
    {"reflectance", ParamType::kRgb, {0.5f, 0.5f, 0.5f}, 0.0f, 1.0f, "", nullptr, 0}};
constexpr ParamSpec kDielectricParams[] = {
    {"eta", ParamType::kFloat, {1.5f}, 0.1f, 10.0f, "", kNames, 2},
    {"reflectance", ParamType::kRgb, {1.0f, 1.0f, 1.0f}, 0.0f, 1.0f, "", nullptr, 0},
    {"transmittance", ParamType::kRgb, {1.0f, 1.0f, 1.0f}, 0.0f, 1.0f, "", nullptr, 0},
    SWELL_MICROFACET_PARAMS};
constexpr ParamSpec kConductorParams[] = {
    {"eta", ParamType::kRgb, {0.2f, 0.9f, 1.1f}, 0.0f, 100.0f, "", kNames, 2},
    {"k", ParamType::kRgb, {3.9f, 2.4f, 2.1f}, 0.0f, 100.0f, "", kNames, 2},
    {"reflectance", ParamType::kRgb, {-1.0f, -1.0f, -1.0f}, -1.0f, 1.0f, "", nullptr, 0},
    SWELL_MICROFACET_PARAMS};

bool TakesColumns() { return true; }

template <size_t N> constexpr MaterialInfo Kind(const char* name, const ParamSpec (&params)[N]) {
  return {name, "", params, N, true, {}, {}, {}, nullptr, TakesColumns};
}
constexpr MaterialInfo kConductor = Kind("conductor", kConductorParams);
constexpr MaterialInfo kDielectric = Kind("dielectric", kDielectricParams);
constexpr MaterialInfo kDiffuse = Kind("diffuse", kDiffuseParams);
constexpr MaterialInfo kPrincipled = Kind("principled", kPrincipledParams);

}  // namespace

const MaterialInfo* const kMaterialKinds[] = {&kConductor, &kDielectric, &kDiffuse, &kPrincipled};
const uint32_t kMaterialKindCount = std::size(kMaterialKinds);

}  // namespace swell
