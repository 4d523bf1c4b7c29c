// The sample points of a path, one number at a time and bit by bit: Owen-scrambled Sobol' pairs.
#ifndef SWELL_TESTS_REFERENCE_SAMPLER_H_
#define SWELL_TESTS_REFERENCE_SAMPLER_H_

#include <cstdint>

namespace swell::reference {

inline uint32_t ReverseBits(uint32_t v) {
  uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (v >> bit & 1u) << (31 - bit);
  return reversed;
}

// Product of the index with the generator matrix of the second dimension (primitive polynomial
// x + 1): direction numbers v(j + 1) = v(j) ^ v(j) >> 1 (Bratley and Fox 1988).
inline uint32_t SobolSecond(uint32_t index) {
  uint32_t point = 0;
  uint32_t direction = 0x80000000u;
  for (int bit = 0; bit < 32; ++bit) {
    if ((index >> bit & 1u) != 0) point ^= direction;
    direction ^= direction >> 1;
  }
  return point;
}

// Vegdahl 2021, "Building a Better LK Hash"; the word is bit-reversed.
inline uint32_t ScrambleReversed(uint32_t v, uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

// Wellons 2018, "lowbias32".
inline uint32_t Hash(uint32_t v) {
  v ^= v >> 16;
  v *= 0x7FEB352Du;
  v ^= v >> 15;
  v *= 0x846CA68Bu;
  return v ^ v >> 16;
}

struct Pair {
  double x, y;
};
inline Pair SamplePair(uint32_t pixel, uint32_t sample, uint32_t seed, uint32_t pair) {
  const uint32_t key = Hash(pixel ^ Hash(seed ^ 0x9E3779B9u));
  const uint32_t seed0 = Hash(key + pair * 0x9E3779B9u);
  const auto scramble = [](uint32_t point, uint32_t s) {
    return ReverseBits(ScrambleReversed(ReverseBits(point), s));
  };
  const uint32_t index = scramble(sample, seed0);
  const uint32_t x = scramble(ReverseBits(index), Hash(seed0 + 0x85EBCA6Bu));
  const uint32_t y = scramble(SobolSecond(index), Hash(seed0 + 0xC2B2AE35u));
  return {(x >> 8) / 16777216.0, (y >> 8) / 16777216.0};
}

}  // namespace swell::reference

#endif  // SWELL_TESTS_REFERENCE_SAMPLER_H_
