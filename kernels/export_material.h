// The boilerplate of a material file: its kernels per target, and its entry for the registry.
#ifndef SWELL_KERNELS_EXPORT_MATERIAL_H_
#define SWELL_KERNELS_EXPORT_MATERIAL_H_

#include <iterator>

#include "kernels/material.h"

// In the per-target namespace, after the class: the functions that HWY_EXPORT finds by name.
#define SWELL_MATERIAL_KERNELS(Class)                                                 \
  size_t Shade##Class(const ShadeArgs& args) { return ShadeRows<Class>(args); }       \
  void Evaluate##Class(const BsdfQuery& query) { EvaluateRows<Class>(query); }        \
  void Sample##Class(const BsdfQuery& query) { SampleRows<Class>(query); }            \
  bool Is##Class##Specular(const float* params) { return Class::IsSpecular(params); } \
  bool Takes##Class##Columns() { return kTakesColumns<Class>; }                       \
  bool Is##Class##Estimate() { return kIsEstimate<Class>; }                           \
  bool Is##Class##Opaque(const float* params) { return IsOpaque<Class>(Params(params)); }

// Dispatch of one width, in namespace swell::wide or swell::one_lane.
#define SWELL_DISPATCH_MATERIAL(Class)                                                           \
  HWY_EXPORT(Shade##Class);                                                                      \
  HWY_EXPORT(Evaluate##Class);                                                                   \
  HWY_EXPORT(Sample##Class);                                                                     \
  HWY_EXPORT(Is##Class##Specular);                                                               \
  HWY_EXPORT(Takes##Class##Columns);                                                             \
  HWY_EXPORT(Is##Class##Estimate);                                                               \
  HWY_EXPORT(Is##Class##Opaque);                                                                 \
  size_t Dispatch##Class##Shade(const ShadeArgs& args) {                                         \
    return HWY_DYNAMIC_DISPATCH(Shade##Class)(args);                                             \
  }                                                                                              \
  void Dispatch##Class##Evaluate(const BsdfQuery& query) {                                       \
    HWY_DYNAMIC_DISPATCH(Evaluate##Class)(query);                                                \
  }                                                                                              \
  void Dispatch##Class##Sample(const BsdfQuery& query) {                                         \
    HWY_DYNAMIC_DISPATCH(Sample##Class)(query);                                                  \
  }                                                                                              \
  bool Dispatch##Class##IsSpecular(const float* params) {                                        \
    return HWY_DYNAMIC_DISPATCH(Is##Class##Specular)(params);                                    \
  }                                                                                              \
  bool Dispatch##Class##TakesColumns() { return HWY_DYNAMIC_DISPATCH(Takes##Class##Columns)(); } \
  bool Dispatch##Class##IsEstimate() { return HWY_DYNAMIC_DISPATCH(Is##Class##Estimate)(); }     \
  bool Dispatch##Class##IsOpaque(const float* params) {                                          \
    return HWY_DYNAMIC_DISPATCH(Is##Class##Opaque)(params);                                      \
  }

// Under HWY_ONCE, at global scope, at the file's end. `params` is an array of ParamSpec. The entry
// is a constant, not made by a static constructor: the registry is complete before any code runs.
#ifdef SWELL_ONE_LANE
#define SWELL_EXPORT_MATERIAL(Class, name, params, help, reciprocal) \
  namespace swell::one_lane {                                        \
  SWELL_DISPATCH_MATERIAL(Class)                                     \
  }                                                                  \
  static_assert(true)
#else
#define SWELL_EXPORT_MATERIAL(Class, name, params, help, reciprocal)            \
  namespace swell::wide {                                                       \
  SWELL_DISPATCH_MATERIAL(Class)                                                \
  }                                                                             \
  namespace swell::one_lane {                                                   \
  size_t Dispatch##Class##Shade(const ShadeArgs& args);                         \
  void Dispatch##Class##Evaluate(const BsdfQuery& query);                       \
  void Dispatch##Class##Sample(const BsdfQuery& query);                         \
  }                                                                             \
  namespace swell {                                                             \
  extern const MaterialInfo k##Class##Material;                                 \
  constinit const MaterialInfo k##Class##Material = {                           \
      name,                                                                     \
      help,                                                                     \
      params,                                                                   \
      static_cast<uint32_t>(std::size(params)),                                 \
      reciprocal,                                                               \
      {&wide::Dispatch##Class##Shade, &one_lane::Dispatch##Class##Shade},       \
      {&wide::Dispatch##Class##Evaluate, &one_lane::Dispatch##Class##Evaluate}, \
      {&wide::Dispatch##Class##Sample, &one_lane::Dispatch##Class##Sample},     \
      &wide::Dispatch##Class##IsSpecular,                                       \
      &wide::Dispatch##Class##TakesColumns,                                     \
      &wide::Dispatch##Class##IsEstimate,                                       \
      &wide::Dispatch##Class##IsOpaque,                                         \
  };                                                                            \
  }                                                                             \
  static_assert(true)
#endif

#endif  // SWELL_KERNELS_EXPORT_MATERIAL_H_
