// The parameters of rough surfaces, in the order that Microfacets reads them.
#ifndef SWELL_KERNELS_MICROFACET_PARAMS_H_
#define SWELL_KERNELS_MICROFACET_PARAMS_H_

#include "kernels/material.h"

// clang-format off
#define SWELL_MICROFACET_PARAMS                                                                   \
  {"roughness", ParamType::kFloat, {0.0f}, 0.0f, 1.0f,                                            \
   "GGX roughness in both directions; 0 is smooth", nullptr, 0},                                  \
  {"uroughness", ParamType::kFloat, {-1.0f}, -1.0f, 1.0f,                                         \
   "roughness along u; negative: as roughness", nullptr, 0},                                      \
  {"vroughness", ParamType::kFloat, {-1.0f}, -1.0f, 1.0f,                                         \
   "roughness along v; negative: as roughness", nullptr, 0},                                      \
  {"remaproughness", ParamType::kBool, {1.0f}, 0.0f, 1.0f,                                        \
   "whether GGX's alpha is the square root of the roughness, or the roughness itself", nullptr, 0}
// clang-format on

#endif  // SWELL_KERNELS_MICROFACET_PARAMS_H_
