// The parameters of the layer under a coat, in the order that Layer reads them.
#ifndef SWELL_KERNELS_LAYER_PARAMS_H_
#define SWELL_KERNELS_LAYER_PARAMS_H_

#include "kernels/material.h"

// clang-format off
#define SWELL_LAYER_PARAMS                                                                        \
  {"thickness", ParamType::kFloat, {0.01f}, 0.0f, 1e4f,                                           \
   "of the layer, which takes 1/e of light in a unit of length", nullptr, 0},                     \
  {"g", ParamType::kFloat, {0.0f}, -1.0f, 1.0f,                                                   \
   "mean cosine of scattering in the layer", nullptr, 0},                                         \
  {"albedo", ParamType::kRgb, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f,                                     \
   "share of the light taken by the layer that is scattered; 0: clear", nullptr, 0},              \
  {"maxdepth", ParamType::kInt, {10.0f}, 1.0f, 1000.0f,                                           \
   "events of a random walk in the layer", nullptr, 0},                                           \
  {"nsamples", ParamType::kInt, {1.0f}, 1.0f, 1000.0f,                                            \
   "random walks for one value", nullptr, 0}
// clang-format on

#endif  // SWELL_KERNELS_LAYER_PARAMS_H_
