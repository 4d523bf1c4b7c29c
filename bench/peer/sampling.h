// Random numbers of the peer, and maps from them to directions.
#ifndef SWELL_BENCH_PEER_SAMPLING_H_
#define SWELL_BENCH_PEER_SAMPLING_H_

#include <cstdint>

#include "bench/peer/vec3.h"

namespace swell::bench {

inline constexpr float kPi = 3.14159265f;
inline constexpr float kInvPi = 0.318309886f;
inline constexpr float kInvFourPi = 0.0795774715f;

// PCG32 (O'Neill 2014), one stream per pixel and sample.
class Random {
 public:
  Random(uint32_t pixel, uint32_t sample, uint32_t seed)
      : state_(Mix((uint64_t{pixel} << 32 | sample) + 0x9E3779B97F4A7C15u * (seed + 1ull))) {}

  // [0, 1)
  float Next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<uint32_t>(old >> 59);
    const uint32_t bits = shifted >> turn | shifted << (-turn & 31);
    return static_cast<float>(bits >> 8) * 0x1p-24f;
  }

 private:
  // The finaliser of SplitMix64 (Steele et al. 2014).
  static uint64_t Mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }
  uint64_t state_;
};

inline Vec3 CosineHemisphere(float u0, float u1) {
  const float radius = std::sqrt(u0);
  const float phi = 2.0f * kPi * u1;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u0))};
}

inline Vec3 UniformSphere(float u0, float u1) {
  const float z = 1.0f - 2.0f * u0;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u1;
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

// Veach 1997, 9.2.3.
inline float PowerHeuristic(float pdf, float other) {
  const float ratio = other / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_SAMPLING_H_
