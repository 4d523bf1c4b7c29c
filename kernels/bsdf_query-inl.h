// Runs a material's Evaluate and Sample over columns of local directions, for tests and benchmarks.
#if defined(SWELL_KERNELS_BSDF_QUERY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_BSDF_QUERY_INL_H_
#undef SWELL_KERNELS_BSDF_QUERY_INL_H_
#else
#define SWELL_KERNELS_BSDF_QUERY_INL_H_
#endif

#include "kernels/bsdf-inl.h"
#include "kernels/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The numbers that a row's walk draws.
HWY_INLINE U32 QuerySeed(const BsdfQuery& query, size_t row) {
  const U32 number = hn::Add(hn::Iota(DU(), 0), SetU(static_cast<uint32_t>(row)));
  return HashBits(hn::Xor(number, HashBits(SetU(query.seed))));
}

template <class M> void EvaluateRows(const BsdfQuery& query) {
  const M material(query.params, query.settings);
  for (size_t i = 0; i < query.count; i += hn::Lanes(D())) {
    const Vec3 wo = Load(query.wo, i);
    const Vec3 wi = Load(query.wi, i);

    const BsdfValue result = EvaluateBsdf(material, wo, wi, QuerySeed(query, i));

    Store(result.value, query.value, i);
    Store(result.pdf, query.pdf, i);
  }
}

template <class M> void SampleRows(const BsdfQuery& query) {
  const M material(query.params, query.settings);
  for (size_t i = 0; i < query.count; i += hn::Lanes(D())) {
    const Vec3 wo = Load(query.wo, i);
    const F32 u0 = Load(query.u[0], i);
    const F32 u1 = Load(query.u[1], i);
    const F32 u2 = Load(query.u[2], i);

    const BsdfSample sample = SampleBsdf(material, wo, u0, u1, u2, QuerySeed(query, i));

    Store(sample.wi, query.sampled_wi, i);
    Store(sample.weight, query.value, i);
    Store(sample.pdf, query.pdf, i);
    if (query.eta_scale != nullptr) Store(sample.eta_scale, query.eta_scale, i);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_BSDF_QUERY_INL_H_
