// Small images with known distances in, claims about the figures out.
#include "tests/support/compare_images.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace swell::test {
namespace {

const Image kReference = {2, 1, {0.0f, 1.0f, 2.0f, 1.0f, 1.0f, 4.0f}};
const Image kImage = {2, 1, {0.5f, 1.0f, 2.0f, 1.0f, 0.0f, 4.0f}};

TEST_CASE("ChannelMeans: averages each channel alone") {
  CHECK(ChannelMeans(kReference) == std::array<double, 3>{0.5, 1.0, 3.0});
}

TEST_CASE("Rmse: is the root of the mean square over pixels and channels") {
  CHECK(Rmse(kImage, kReference) == doctest::Approx(std::sqrt(1.25 / 6)).epsilon(1e-15));
  CHECK(Rmse(kImage, kImage) == 0);
}

TEST_CASE("RelativeMse: divides each square by the reference's") {
  const double expected = (0.25 / 0.5 + 1.0 / 1.5) / 6;
  CHECK(RelativeMse(kImage, kReference, 0.5) == doctest::Approx(expected).epsilon(1e-15));
}

TEST_CASE("Psnr: a tenth of the peak is 20 decibels, equality is infinite") {
  const Image black = {1, 1, {0, 0, 0}};
  const Image grey = {1, 1, {0.25f, 0.25f, 0.25f}};
  CHECK(Psnr(grey, black, 2.5) == doctest::Approx(20).epsilon(1e-15));
  CHECK(Psnr(grey, grey) == std::numeric_limits<double>::infinity());
}

TEST_CASE("BlockMeans: edge blocks average only the pixels they have") {
  const Image image = {3, 3, {1, 0, 0, 2, 0, 0, 3, 0, 1,  //
                              4, 0, 0, 5, 0, 0, 6, 0, 2,  //
                              7, 0, 0, 8, 4, 0, 9, 0, 3}};
  const Image means = BlockMeans(image, 2);
  CHECK(means.width == 2);
  CHECK(means.height == 2);
  CHECK(means.rgb == std::vector<float>{3, 0, 0, 4.5f, 0, 1.5f, 7.5f, 2, 0, 9, 0, 3});
}

TEST_CASE("LargestDifference: finds the worst value, and NaN is worst of all") {
  CHECK(LargestDifference(kImage, kReference) == 1);
  Image with_nan = kImage;
  with_nan.rgb[0] = std::nanf("");
  CHECK(LargestDifference(with_nan, kReference) == std::numeric_limits<double>::infinity());
}

TEST_CASE("SameBits: tells zeros of different sign apart") {
  const Image zero = {1, 1, {0.0f, 0.0f, 0.0f}};
  const Image minus_zero = {1, 1, {0.0f, -0.0f, 0.0f}};
  CHECK(SameBits(zero, zero));
  CHECK_FALSE(SameBits(zero, minus_zero));
}

}  // namespace
}  // namespace swell::test
