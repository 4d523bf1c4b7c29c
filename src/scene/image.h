// Pixels of a file -> texels as kernels gather them: compact, in tiles, with smaller levels.
#ifndef SWELL_SCENE_IMAGE_H_
#define SWELL_SCENE_IMAGE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/image_view.h"

namespace swell {

// Pixels row by row from the top, channels (1 or 3) together. Codes and `decode` for kByte, linear
// values otherwise.
struct Pixels {
  uint32_t width = 0, height = 0, channels = 3;
  TexelFormat format = TexelFormat::kFloat;
  std::vector<uint8_t> codes;
  std::vector<float> values;
  std::array<float, 256> decode{};  // ascending

  size_t size() const { return size_t{width} * height * channels; }
  float Value(size_t i) const {
    return format == TexelFormat::kByte ? decode[codes[i]] : values[i];
  }
};

struct TexelImage {
  std::string name;  // of its file, for people; may be empty
  TexelFormat format = TexelFormat::kFloat;
  uint32_t channels = 3;
  std::vector<uint32_t> words;
  std::vector<float> decode;
  std::vector<ImageLevel> levels;

  ImageView view() const;
  size_t bytes() const { return words.size() * sizeof(uint32_t); }
};

enum class Levels { kOne, kAll };

// Smaller levels halve each side (rounding down) and average the pixels that a texel covers, in
// linear light.
TexelImage MakeTexelImage(const Pixels& pixels, Levels levels);

// IEEE binary16 nearest to `value`; beyond its range the largest one.
uint16_t ToHalf(float value);
float FromHalf(uint16_t half);

// Channels of a texel, as kernels decode them; a single channel three times.
std::array<float, 3> TexelAt(const TexelImage& image, uint32_t level, uint32_t x, uint32_t y);

}  // namespace swell

#endif  // SWELL_SCENE_IMAGE_H_
