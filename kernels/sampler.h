// The samplers that a render may choose, by kind, name and meaning; each is a file in samplers/.
#ifndef SWELL_KERNELS_SAMPLER_H_
#define SWELL_KERNELS_SAMPLER_H_

#include <cstdint>

namespace swell {

// samplers/NAME-inl.h has a struct Kind with a function Pair; other_samplers.cc includes it.
#define SWELL_SAMPLERS(X)                                                                      \
  X(Sobol, "sobol", "Owen-scrambled Sobol' pairs, shuffled for each pixel and pair")           \
  X(ZSobol, "zsobol",                                                                          \
    "one Sobol' sequence along a shuffled Morton curve: noise between pixels"                  \
    " is blue")                                                                                \
  X(Halton, "halton", "radical inverses in a prime base for each dimension, digits scrambled") \
  X(Stratified, "stratified", "a point in each cell of a grid for each pair, cells shuffled")  \
  X(Independent, "independent", "every number on its own")

enum class SamplerKind : uint32_t {
#define SWELL_SAMPLER_KIND(Kind, name, help) k##Kind,
  SWELL_SAMPLERS(SWELL_SAMPLER_KIND)
#undef SWELL_SAMPLER_KIND
};

struct SamplerInfo {
  const char* name;
  const char* help;
};
inline constexpr SamplerInfo kSamplers[] = {
#define SWELL_SAMPLER_INFO(Kind, name, help) {name, help},
    SWELL_SAMPLERS(SWELL_SAMPLER_INFO)
#undef SWELL_SAMPLER_INFO
};

struct SamplerView {
  SamplerKind kind = SamplerKind::kSobol;
  uint32_t samples_per_pixel = 1;  // of the whole picture; samples are below it, it is <= 2^22
};

}  // namespace swell

#endif  // SWELL_KERNELS_SAMPLER_H_
