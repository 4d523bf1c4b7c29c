// A registry of three material kinds, so that the importer is tested without kernels.
#include "kernels/material.h"

namespace swell {
namespace {

constexpr NamedValue kModels[] = {{"exact", {0, 0, 0}}, {"schlick", {1, 0, 0}}};
constexpr NamedValue kIndices[] = {
    {"water", {1.33f, 0, 0}}, {"diamond", {2.42f, 0, 0}}, {"glass-BK7", {1.52f, 0, 0}}};
constexpr NamedValue kMetals[] = {{"Cu", {0.2f, 0.9f, 1.1f}}, {"Au", {0.1f, 0.4f, 1.4f}}};

constexpr ParamSpec kDiffuseParams[] = {
    {"reflectance", ParamType::kRgb, {0.5f, 0.5f, 0.5f}, 0.0f, 1.0f, "", nullptr, 0}};
constexpr ParamSpec kGlassParams[] = {
    {"eta", ParamType::kFloat, {1.5f, 0, 0}, 1.0f, 4.0f, "", kIndices, 3},
    {"tint", ParamType::kRgb, {1, 1, 1}, 0.0f, 20.0f, "", kMetals, 2},
    {"fresnel", ParamType::kChoice, {0, 0, 0}, 0.0f, 1.0f, "", kModels, 2}};
constexpr ParamSpec kConductorParams[] = {
    {"eta", ParamType::kRgb, {0.2f, 0.9f, 1.1f}, 0.0f, 20.0f, "", kMetals, 2},
    {"k", ParamType::kRgb, {3.9f, 2.4f, 2.1f}, 0.0f, 20.0f, "", kMetals, 2},
    {"reflectance", ParamType::kRgb, {-1, -1, -1}, 0.0f, 1.0f, "", nullptr, 0}};

constexpr MaterialInfo kConductor = {"conductor", "", kConductorParams, 3, true, {},
                                     {},          {}, nullptr};
constexpr MaterialInfo kDiffuse = {"diffuse", "", kDiffuseParams, 1, true, {}, {}, {}, nullptr};
constexpr MaterialInfo kGlass = {"glass", "", kGlassParams, 3, true, {}, {}, {}, nullptr};

}  // namespace

const MaterialInfo* const kMaterialKinds[] = {&kDiffuse, &kGlass, &kConductor};
const uint32_t kMaterialKindCount = 3;

}  // namespace swell
