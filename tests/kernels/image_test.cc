// Pixels in, the texels that kernels gather out: every format, with smaller levels.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "src/scene/image.h"
#include "tests/kernels/image_probe.h"
#include "tests/support/probe.h"

namespace swell::test {
namespace {

Pixels RandomPixels(TexelFormat format, uint32_t channels, uint32_t width, uint32_t height) {
  std::mt19937 random(7);
  Pixels pixels{width, height, channels, format, {}, {}, {}};
  for (size_t code = 0; code < 256; ++code) pixels.decode[code] = std::pow(float(code) / 255, 2.2f);
  for (size_t i = 0; i < pixels.size(); ++i) {
    const auto code = static_cast<uint8_t>(random());
    if (format == TexelFormat::kByte) {
      pixels.codes.push_back(code);
    } else {
      pixels.values.push_back(float(code) / 64);
    }
  }
  return pixels;
}

// All texels of a level, as a kernel sees them.
WordColumns Fetch(const TexelImage& image, uint32_t level, Width width) {
  ImageLightView light{};
  light.image = image.view();
  SceneView scene{};
  scene.lights.images = &light;
  const ImageLevel& size = image.levels[level];
  WordColumns in(2, size_t{size.width} * size.height);
  for (uint32_t i = 0; i < in.count(); ++i) {
    in.Word(0, i) = i % size.width;
    in.Word(1, i) = i / size.width;
  }
  return RunProbe(ProbeTexel, width, in, 3, &scene, level);
}

}  // namespace

TEST_CASE("FetchTexel: every pixel of every format is where it was") {
  for (TexelFormat format : {TexelFormat::kByte, TexelFormat::kHalf, TexelFormat::kFloat}) {
    for (uint32_t channels : {1u, 3u}) {
      for (const auto& [w, h] : {std::pair{1u, 1u}, {4u, 4u}, {13u, 6u}, {3u, 17u}}) {
        const Pixels pixels = RandomPixels(format, channels, w, h);
        const TexelImage image = MakeTexelImage(pixels, Levels::kOne);
        CHECK(image.levels.size() == 1);
        ForEachTarget([&](const char* target, Width width) {
          INFO(std::string(target), ", format ", int(format), ", channels ", channels, ", ", w);
          const WordColumns texels = Fetch(image, 0, width);
          for (uint32_t i = 0; i < texels.count(); ++i) {
            for (uint32_t c = 0; c < 3; ++c) {
              const float expected = pixels.Value(i * channels + std::min(c, channels - 1));
              REQUIRE(texels.Float(c, i) == expected);
              REQUIRE(TexelAt(image, 0, i % w, i / w)[c] == expected);
            }
          }
        });
      }
    }
  }
}

TEST_CASE("MakeTexelImage: a smaller level's texel is the mean of what it covers") {
  const Pixels pixels = RandomPixels(TexelFormat::kFloat, 3, 7, 4);
  const TexelImage image = MakeTexelImage(pixels, Levels::kAll);
  REQUIRE(image.levels.size() == 3);  // 7x4, 3x2, 1x1
  REQUIRE(image.levels[1].width == 3);
  REQUIRE(image.levels[2].width == 1);
  double total = 0;
  for (uint32_t y = 0; y < 2; ++y) {
    for (uint32_t x = 0; x < 3; ++x) {
      double sum = 0;
      for (uint32_t j = 2 * y; j < 2 * y + 2; ++j) {
        for (uint32_t i = 0; i < 7; ++i) {
          const double from = std::max<double>(i, x * 7.0 / 3);
          const double to = std::min<double>(i + 1, (x + 1) * 7.0 / 3);
          sum += std::max(0.0, to - from) * pixels.Value((j * 7 + i) * 3 + 1);
        }
      }
      total += sum / 28;
      CHECK(TexelAt(image, 1, x, y)[1] == doctest::Approx(sum / (2 * 7.0 / 3)).epsilon(1e-6));
    }
  }
  CHECK(TexelAt(image, 2, 0, 0)[1] == doctest::Approx(total).epsilon(1e-6));
}

TEST_CASE("MakeTexelImage: levels of codes average light, not codes") {
  Pixels pixels{2, 1, 1, TexelFormat::kByte, {0, 255}, {}, {}};
  for (size_t code = 0; code < 256; ++code) pixels.decode[code] = std::pow(float(code) / 255, 2.2f);
  const TexelImage image = MakeTexelImage(pixels, Levels::kAll);
  REQUIRE(image.levels.size() == 2);
  CHECK(TexelAt(image, 1, 0, 0)[0] == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("ToHalf: the nearest half, as FromHalf knows them") {
  for (uint32_t half = 0; half < 0x7C00; ++half) {
    const auto bits = static_cast<uint16_t>(half);
    REQUIRE(ToHalf(FromHalf(bits)) == bits);
    if (half + 1 == 0x7C00) continue;
    const float next = FromHalf(static_cast<uint16_t>(half + 1)), here = FromHalf(bits);
    REQUIRE(ToHalf(here + 0.49f * (next - here)) == bits);
    REQUIRE(ToHalf(here + 0.51f * (next - here)) == half + 1);
    REQUIRE(ToHalf(-here) == (bits | 0x8000));
  }
  CHECK(FromHalf(ToHalf(1e9f)) == 65504.0f);
}

}  // namespace swell::test
