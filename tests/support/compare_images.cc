// Images in, means and distances out.
#include "tests/support/compare_images.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "src/base/check.h"

namespace swell::test {
namespace {

void CheckComparable(const Image& image, const Image& reference) {
  SWELL_CHECK(image.width == reference.width && image.height == reference.height);
  SWELL_CHECK(image.rgb.size() == size_t{3} * image.width * image.height);
  SWELL_CHECK(image.rgb.size() == reference.rgb.size() && !image.rgb.empty());
}

// The mean of term(a, b) over all values of both images.
template <class Term> double MeanOf(const Image& image, const Image& reference, const Term& term) {
  CheckComparable(image, reference);
  double sum = 0;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    sum += term(double{image.rgb[i]}, double{reference.rgb[i]});
  }
  return sum / static_cast<double>(image.rgb.size());
}

double SquaredDifference(double a, double b) { return (a - b) * (a - b); }

}  // namespace

std::array<double, 3> ChannelMeans(const Image& image) {
  CheckComparable(image, image);
  std::array<double, 3> means = {};
  for (size_t i = 0; i < image.rgb.size(); ++i) means[i % 3] += image.rgb[i];
  for (double& mean : means) mean /= static_cast<double>(image.rgb.size() / 3);
  return means;
}

double Rmse(const Image& image, const Image& reference) {
  return std::sqrt(MeanOf(image, reference, SquaredDifference));
}

double RelativeMse(const Image& image, const Image& reference, double epsilon) {
  return MeanOf(image, reference,
                [&](double a, double b) { return SquaredDifference(a, b) / (b * b + epsilon); });
}

double Psnr(const Image& image, const Image& reference, double peak) {
  const double mse = MeanOf(image, reference, SquaredDifference);
  if (mse == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(peak * peak / mse);
}

Image BlockMeans(const Image& image, uint32_t block) {
  CheckComparable(image, image);
  SWELL_CHECK(block > 0);
  Image means{(image.width + block - 1) / block, (image.height + block - 1) / block, {}};
  means.rgb.reserve(size_t{3} * means.width * means.height);
  for (uint32_t top = 0; top < image.height; top += block) {
    for (uint32_t left = 0; left < image.width; left += block) {
      const uint32_t bottom = std::min(top + block, image.height);
      const uint32_t right = std::min(left + block, image.width);
      for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (uint32_t y = top; y < bottom; ++y) {
          for (uint32_t x = left; x < right; ++x) {
            sum += image.rgb[3 * (size_t{y} * image.width + x) + c];
          }
        }
        means.rgb.push_back(static_cast<float>(sum / (double(bottom - top) * (right - left))));
      }
    }
  }
  return means;
}

double LargestDifference(const Image& image, const Image& reference) {
  CheckComparable(image, reference);
  double largest = 0;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    const double difference = std::abs(double{image.rgb[i]} - double{reference.rgb[i]});
    // Written so that NaN counts as infinitely far.
    if (!(difference <= largest)) {
      largest = std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
    }
  }
  return largest;
}

bool SameBits(const Image& image, const Image& reference) {
  return image.width == reference.width && image.height == reference.height &&
         image.rgb.size() == reference.rgb.size() &&
         std::memcmp(image.rgb.data(), reference.rgb.data(), image.rgb.size() * sizeof(float)) == 0;
}

}  // namespace swell::test
