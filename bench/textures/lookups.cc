// Makes an image of waves and noise, and coordinates in it.
#include "bench/textures/lookups.h"

#include <cmath>
#include <random>

namespace swell::bench {

Pixels MakePattern(uint32_t side, TexelFormat format) {
  Pixels pixels;
  pixels.width = pixels.height = side;
  pixels.format = format;
  for (size_t code = 0; code < 256; ++code) {
    pixels.decode[code] = static_cast<float>(code) / 255.0f;
  }
  std::minstd_rand noise(1);
  const float step = 40.0f / static_cast<float>(side);
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const float wave =
          std::sin(step * static_cast<float>(x)) * std::cos(step * static_cast<float>(y));
      for (uint32_t c = 0; c < 3; ++c) {
        const auto grain = static_cast<float>(noise() & 63u);
        const float code = 96.0f + 64.0f * wave + grain + 16.0f * static_cast<float>(c);
        if (format == TexelFormat::kByte) {
          pixels.codes.push_back(static_cast<uint8_t>(code));
        } else {
          pixels.values.push_back(FromHalf(ToHalf(code / 255.0f)));
        }
      }
    }
  }
  return pixels;
}

Lookups MakeLookups(size_t count, Coherence coherence, uint32_t side) {
  constexpr uint32_t kTile = 16;      // pixels
  constexpr uint32_t kAcross = 32;    // tiles of a frame
  constexpr float kTexels = 1.3f;     // between the frame's first columns
  constexpr float kStretch = 0.017f;  // by which that grows with each column
  Lookups lookups(count);
  const float texel = 1.0f / static_cast<float>(side);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> anywhere(-0.5f, 1.5f), level(0.0f, 5.0f);
  for (size_t i = 0; i < count; ++i) {
    if (coherence == Coherence::kRandom) {
      lookups.s[i] = anywhere(random);
      lookups.t[i] = anywhere(random);
      lookups.width[i] = texel * std::exp2(level(random));
      continue;
    }
    const size_t tile = i / (kTile * kTile), in_tile = i % (kTile * kTile);
    const auto x = static_cast<float>(tile % kAcross * kTile + in_tile % kTile);
    const auto y = static_cast<float>(tile / kAcross * kTile + in_tile / kTile);
    const float apart = kTexels + kStretch * x;
    lookups.s[i] = texel * (x * (kTexels + 0.5f * kStretch * x) + 0.3f * y) - 0.1f;
    lookups.t[i] = texel * (apart * y - 0.2f * x) - 0.1f;
    lookups.width[i] = texel * apart;
  }
  return lookups;
}

}  // namespace swell::bench
