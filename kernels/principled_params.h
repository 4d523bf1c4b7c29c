// The parameters of the principled material, in the order that it reads them, with glTF's defaults.
#ifndef SWELL_KERNELS_PRINCIPLED_PARAMS_H_
#define SWELL_KERNELS_PRINCIPLED_PARAMS_H_

#include "kernels/material.h"

namespace swell {

// clang-format off
inline constexpr ParamSpec kPrincipledParams[] = {
    {"base_color", ParamType::kRgb, {1.0f, 1.0f, 1.0f}, 0.0f, 1.0f,
     "albedo of the dielectric's base, or reflectance of the metal at normal incidence", nullptr, 0},
    {"metallic", ParamType::kFloat, {1.0f}, 0.0f, 1.0f, "share of metal", nullptr, 0},
    {"roughness", ParamType::kFloat, {1.0f}, 0.0f, 1.0f,
     "square root of GGX's alpha; 0 is smooth", nullptr, 0},
    {"ior", ParamType::kFloat, {1.5f}, 0.0f, 100.0f,
     "index of refraction of the dielectric; 0: reflects everything", nullptr, 0},
    {"specular", ParamType::kFloat, {1.0f}, 0.0f, 1.0f,
     "strength of the dielectric's reflection", nullptr, 0},
    {"specular_color", ParamType::kRgb, {1.0f, 1.0f, 1.0f}, 0.0f, 100.0f,
     "tint of the dielectric's reflection at normal incidence", nullptr, 0},
    {"transmission", ParamType::kFloat, {0.0f}, 0.0f, 1.0f,
     "share of the dielectric's base that is thin glass", nullptr, 0},
    {"clearcoat", ParamType::kFloat, {0.0f}, 0.0f, 1.0f, "strength of the coat", nullptr, 0},
    {"clearcoat_roughness", ParamType::kFloat, {0.0f}, 0.0f, 1.0f,
     "of the coat, as roughness", nullptr, 0},
    {"sheen_color", ParamType::kRgb, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f,
     "tint of the sheen; 0: none", nullptr, 0},
    {"sheen_roughness", ParamType::kFloat, {0.0f}, 0.0f, 1.0f, "of the sheen", nullptr, 0},
    {"emissive", ParamType::kRgb, {0.0f, 0.0f, 0.0f}, 0.0f, 1e6f,
     "radiance that surfaces of this material emit, if no AreaLightSource says otherwise", nullptr, 0},
    {"emissive_strength", ParamType::kFloat, {1.0f}, 0.0f, 1e6f, "multiplies emissive", nullptr, 0},
    {"anisotropy", ParamType::kFloat, {0.0f}, 0.0f, 1.0f,
     "how much rougher the surface is along one direction than across it", nullptr, 0},
    {"anisotropy_direction", ParamType::kRgb, {1.0f, 0.5f, 1.0f}, 0.0f, 1.0f,
     "that direction along u and v, as in a map: 0.5 is 0; the third number does not count",
     nullptr, 0},
    {"anisotropy_rotation", ParamType::kFloat, {0.0f}, -1e4f, 1e4f,
     "turns that direction from u towards v, radians", nullptr, 0},
    {"clearcoat_normal", ParamType::kRgb, {0.5f, 0.5f, 0.5f}, -1e3f, 1e3f,
     "normal of the coat along u, v and the smooth normal, as in a map: 0.5 is 0; all 0.5: that of "
     "what it covers", nullptr, 0},
};
// clang-format on

}  // namespace swell

#endif  // SWELL_KERNELS_PRINCIPLED_PARAMS_H_
