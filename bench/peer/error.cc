// Sums squared differences of pictures.
#include "bench/peer/error.h"

#include <cstddef>

namespace swell::bench {
namespace {

// Of `scale` times the difference of a and b, relative to `truth`.
PictureError MeanSquares(const Image& a, const Image& b, double scale, const Image& truth,
                         double floor) {
  PictureError sum;
  for (size_t i = 0; i < truth.rgb.size(); ++i) {
    const double difference = scale * (double{a.rgb[i]} - b.rgb[i]);
    const double value = truth.rgb[i];
    sum.squared += difference * difference;
    sum.relative += difference * difference / (value * value + floor);
  }
  const auto count = static_cast<double>(truth.rgb.size());
  return {sum.squared / count, sum.relative / count};
}

}  // namespace

TruePicture::TruePicture(const Image& a, const Image& b) : mean(a) {
  constexpr double kFloor = 1e-2;  // of the mean value
  double sum = 0;
  for (size_t i = 0; i < mean.rgb.size(); ++i) {
    mean.rgb[i] = 0.5f * (a.rgb[i] + b.rgb[i]);
    sum += mean.rgb[i];
  }
  const double dark = kFloor * sum / static_cast<double>(mean.rgb.size());
  floor = dark * dark;
  own = MeanSquares(a, b, 0.5, mean, floor);
}

PictureError TruePicture::ErrorOf(const Image& image) const {
  const PictureError error = MeanSquares(image, mean, 1.0, mean, floor);
  return {error.squared - own.squared, error.relative - own.relative};
}

}  // namespace swell::bench
