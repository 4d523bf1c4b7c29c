// Packs pixels into tiles of words, level by level.
#include "src/scene/image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace swell {
namespace {

constexpr uint32_t kTileTexels = kTileSide * kTileSide;

uint32_t WordsPerTile(TexelFormat format, uint32_t channels) {
  const uint32_t bits = format == TexelFormat::kByte ? 8 : format == TexelFormat::kHalf ? 16 : 32;
  // Three bytes or halves fill whole words.
  const uint32_t stored = channels == 1 ? 1 : format == TexelFormat::kFloat ? 3 : 4;
  return kTileTexels * stored * bits / 32;
}

size_t TexelNumber(const ImageLevel& level, uint32_t x, uint32_t y) {
  const size_t tile = size_t{y >> kTileShift} * level.tiles_across + (x >> kTileShift);
  return tile * kTileTexels + (y % kTileSide) * kTileSide + x % kTileSide;
}

uint8_t NearestCode(const std::array<float, 256>& decode, float value) {
  const auto above = std::upper_bound(decode.begin(), decode.end(), value);
  if (above == decode.begin()) return 0;
  if (above == decode.end()) return 255;
  const auto code = static_cast<uint8_t>(above - decode.begin());
  return value - above[-1] <= above[0] - value ? static_cast<uint8_t>(code - 1) : code;
}

void Append(const Pixels& pixels, TexelImage& image) {
  ImageLevel level{pixels.width, pixels.height, (pixels.width + kTileSide - 1) / kTileSide,
                   static_cast<uint32_t>(image.words.size())};
  const uint32_t tiles_down = (pixels.height + kTileSide - 1) / kTileSide;
  image.words.resize(image.words.size() + size_t{level.tiles_across} * tiles_down *
                                              WordsPerTile(image.format, image.channels));
  uint32_t* words = image.words.data() + level.first;
  auto* bytes = reinterpret_cast<uint8_t*>(words);
  const uint32_t stored = image.channels == 1 ? 1 : 4;
  for (uint32_t y = 0; y < pixels.height; ++y) {
    for (uint32_t x = 0; x < pixels.width; ++x) {
      const size_t to = TexelNumber(level, x, y);
      const size_t from = (size_t{y} * pixels.width + x) * image.channels;
      for (uint32_t c = 0; c < image.channels; ++c) {
        switch (image.format) {
          case TexelFormat::kByte:
            bytes[to * stored + c] = pixels.codes[from + c];
            break;
          case TexelFormat::kHalf: {
            const uint16_t half = ToHalf(pixels.values[from + c]);
            std::memcpy(bytes + 2 * (to * stored + c), &half, sizeof(half));
            break;
          }
          case TexelFormat::kFloat:
            words[to * image.channels + c] = std::bit_cast<uint32_t>(pixels.values[from + c]);
            break;
        }
      }
    }
  }
  image.levels.push_back(level);
}

// The pixels of one axis that texel `i` of `count` covers, of `size`, with their weights.
struct Span {
  uint32_t first, last;
  double first_weight, last_weight;

  Span(uint32_t i, uint32_t count, uint32_t size) {
    const double begin = double{1} * i * size / count, end = double{1} * (i + 1) * size / count;
    first = static_cast<uint32_t>(begin);
    last = std::min(static_cast<uint32_t>(std::ceil(end)), size) - 1;
    first_weight = first == last ? end - begin : first + 1.0 - begin;
    last_weight = end - last;
  }
  double Weight(uint32_t at) const {
    return at == first ? first_weight : at == last ? last_weight : 1.0;
  }
};

Pixels Halved(const Pixels& pixels) {
  Pixels half;
  half.width = std::max(1u, pixels.width / 2);
  half.height = std::max(1u, pixels.height / 2);
  half.channels = pixels.channels;
  half.format = pixels.format;
  half.decode = pixels.decode;
  const bool codes = half.format == TexelFormat::kByte;
  (codes ? half.codes.resize(half.size()) : half.values.resize(half.size()));
  for (uint32_t y = 0; y < half.height; ++y) {
    const Span rows(y, half.height, pixels.height);
    for (uint32_t x = 0; x < half.width; ++x) {
      const Span columns(x, half.width, pixels.width);
      for (uint32_t c = 0; c < half.channels; ++c) {
        double sum = 0, weights = 0;
        for (uint32_t j = rows.first; j <= rows.last; ++j) {
          for (uint32_t i = columns.first; i <= columns.last; ++i) {
            const double weight = rows.Weight(j) * columns.Weight(i);
            sum += weight * pixels.Value((size_t{j} * pixels.width + i) * half.channels + c);
            weights += weight;
          }
        }
        const auto mean = static_cast<float>(sum / weights);
        const size_t to = (size_t{y} * half.width + x) * half.channels + c;
        (codes ? void(half.codes[to] = NearestCode(half.decode, mean))
               : void(half.values[to] = mean));
      }
    }
  }
  return half;
}

}  // namespace

uint16_t ToHalf(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const auto sign = static_cast<uint16_t>((bits >> 16) & 0x8000u);
  const float magnitude = std::min(std::abs(value), 65504.0f);
  // Adding 2^(e + 13) of the value's own exponent rounds it to 11 significant bits (to even);
  // halves below 2^-14 have a fixed step of 2^-24.
  const int exponent = std::max(std::ilogb(std::max(magnitude, 0x1p-30f)), -14);
  const float step = std::ldexp(1.0f, exponent - 10);
  const float rounded = std::nearbyint(magnitude / step) * step;
  const auto scaled = std::bit_cast<uint32_t>(rounded * 0x1p-112f);  // exact but for denormals
  if (rounded < 0x1p-14f)
    return static_cast<uint16_t>(sign | static_cast<uint16_t>(rounded * 0x1p24f));
  return static_cast<uint16_t>(sign | (scaled >> 13));
}

float FromHalf(uint16_t half) {
  const float magnitude = std::bit_cast<float>((half & 0x7FFFu) << 13) * 0x1p112f;
  return (half & 0x8000u) != 0 ? -magnitude : magnitude;
}

ImageView TexelImage::view() const {
  ImageView view{};
  view.words = words.data();
  view.decode = decode.data();
  view.format = format;
  view.channels = channels;
  view.level_count = static_cast<uint32_t>(levels.size());
  std::copy(levels.begin(), levels.end(), view.levels);
  return view;
}

TexelImage MakeTexelImage(const Pixels& pixels, Levels levels) {
  TexelImage image;
  image.format = pixels.format;
  image.channels = pixels.channels;
  if (pixels.format == TexelFormat::kByte) {
    image.decode.assign(pixels.decode.begin(), pixels.decode.end());
  }
  Append(pixels, image);
  Pixels smaller;
  const Pixels* last = &pixels;
  while (levels == Levels::kAll && (last->width > 1 || last->height > 1)) {
    smaller = Halved(*last);
    last = &smaller;
    Append(smaller, image);
  }
  return image;
}

std::array<float, 3> TexelAt(const TexelImage& image, uint32_t level, uint32_t x, uint32_t y) {
  const ImageLevel& l = image.levels[level];
  const uint32_t* words = image.words.data() + l.first;
  const auto* bytes = reinterpret_cast<const uint8_t*>(words);
  const size_t at = TexelNumber(l, x, y);
  const uint32_t stored = image.channels == 1 ? 1 : 4;
  std::array<float, 3> texel{};
  for (uint32_t c = 0; c < 3; ++c) {
    const uint32_t channel = std::min(c, image.channels - 1);
    uint16_t half = 0;
    switch (image.format) {
      case TexelFormat::kByte:
        texel[c] = image.decode[bytes[at * stored + channel]];
        break;
      case TexelFormat::kHalf:
        std::memcpy(&half, bytes + 2 * (at * stored + channel), sizeof(half));
        texel[c] = FromHalf(half);
        break;
      case TexelFormat::kFloat:
        texel[c] = std::bit_cast<float>(words[at * image.channels + channel]);
        break;
    }
  }
  return texel;
}

}  // namespace swell
