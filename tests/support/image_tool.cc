// Image files in, figures or one image out, for tests in scripts: see kUsage.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "src/film/write_image.h"
#include "tests/support/compare_images.h"

namespace {

using swell::Image;
using Arguments = std::vector<std::string>;

constexpr const char* kUsage =
    "image_tool COMMAND ...\n"
    "  size A                     width height\n"
    "  mean A                     means of red, green, blue\n"
    "  range A                    smallest and largest value of all channels\n"
    "  pixels A X Y [X Y]...      red green blue of each pixel, a line each\n"
    "  dump A                     red green blue of all pixels, a line each, row by row\n"
    "  blocks A N                 means of N x N blocks, a line each, row by row\n"
    "  equal A B                  'same', or how far apart; exit code 1 if any bit differs\n"
    "  rmse A B                   root of the mean squared difference\n"
    "  paste OUT W H CROP X Y ... images into a frame of W x H at their corners\n";

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "image_tool: %s\n", message.c_str());
  std::exit(2);
}

Image Read(const std::string& path) {
  swell::Result<Image> image = swell::ReadImage(path);
  if (!image) Fail(image.error().message);
  return *std::move(image);
}

uint32_t Number(const std::string& text) {
  char* end = nullptr;
  const unsigned long value = std::strtoul(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0') Fail("'" + text + "' is not a number");
  return static_cast<uint32_t>(value);
}

void PrintPixels(const Image& image) {
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    std::printf("%.9g %.9g %.9g\n", static_cast<double>(image.rgb[i]),
                static_cast<double>(image.rgb[i + 1]), static_cast<double>(image.rgb[i + 2]));
  }
}

void PrintChosenPixels(const Image& image, const Arguments& words) {
  for (size_t i = 0; i + 1 < words.size(); i += 2) {
    const uint32_t x = Number(words[i]), y = Number(words[i + 1]);
    if (x >= image.width || y >= image.height) Fail("no pixel " + words[i] + " " + words[i + 1]);
    const float* rgb = &image.rgb[3 * (size_t{y} * image.width + x)];
    PrintPixels({1, 1, {rgb[0], rgb[1], rgb[2]}});
  }
}

void PrintRange(const Image& image) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : image.rgb) {
    if (std::isnan(value)) Fail("a value is not a number");
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
  std::printf("%.9g %.9g\n", low, high);
}

int Equal(const Image& a, const Image& b) {
  if (swell::test::SameBits(a, b)) {
    std::puts("same");
    return 0;
  }
  if (a.width != b.width || a.height != b.height) {
    std::puts("sizes differ");
    return 1;
  }
  size_t values = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) values += a.rgb[i] != b.rgb[i];
  std::printf("%zu of %zu values differ, by at most %g\n", values, a.rgb.size(),
              swell::test::LargestDifference(a, b));
  return 1;
}

void Paste(const Arguments& words) {
  Image frame{Number(words[1]), Number(words[2]), {}};
  frame.rgb.assign(size_t{3} * frame.width * frame.height, -1.0f);
  for (size_t i = 3; i + 2 < words.size(); i += 3) {
    const Image crop = Read(words[i]);
    const size_t left = Number(words[i + 1]), top = Number(words[i + 2]);
    if (left + crop.width > frame.width || top + crop.height > frame.height) {
      Fail("'" + words[i] + "' reaches out of the frame");
    }
    for (size_t y = 0; y < crop.height; ++y) {
      for (size_t v = 0; v < size_t{3} * crop.width; ++v) {
        frame.rgb[3 * ((top + y) * frame.width + left) + v] = crop.rgb[3 * y * crop.width + v];
      }
    }
  }
  if (swell::Status written = swell::WriteImage(words[0], frame, {}); !written) {
    Fail(written.error().message);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments words(argv + 1, argv + argc);
  const std::string command = words.empty() ? "" : words[0];
  if (!words.empty()) words.erase(words.begin());
  if (command == "paste" && words.size() >= 6) {
    Paste(words);
  } else if (command == "equal" && words.size() == 2) {
    return Equal(Read(words[0]), Read(words[1]));
  } else if (command == "rmse" && words.size() == 2) {
    std::printf("%.9g\n", swell::test::Rmse(Read(words[0]), Read(words[1])));
  } else if (command == "blocks" && words.size() == 2) {
    PrintPixels(swell::test::BlockMeans(Read(words[0]), Number(words[1])));
  } else if (command == "pixels" && words.size() >= 3) {
    PrintChosenPixels(Read(words[0]), {words.begin() + 1, words.end()});
  } else if (words.size() == 1 && command == "dump") {
    PrintPixels(Read(words[0]));
  } else if (words.size() == 1 && command == "size") {
    const Image image = Read(words[0]);
    std::printf("%u %u\n", image.width, image.height);
  } else if (words.size() == 1 && command == "range") {
    PrintRange(Read(words[0]));
  } else if (words.size() == 1 && command == "mean") {
    const auto mean = swell::test::ChannelMeans(Read(words[0]));
    std::printf("%.9g %.9g %.9g\n", mean[0], mean[1], mean[2]);
  } else {
    std::fputs(kUsage, stderr);
    return 2;
  }
  return 0;
}
