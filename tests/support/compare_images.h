// Two images in, one figure of how far apart they are out.
#ifndef SWELL_TESTS_SUPPORT_COMPARE_IMAGES_H_
#define SWELL_TESTS_SUPPORT_COMPARE_IMAGES_H_

#include <array>
#include <cstdint>

#include "src/film/film.h"

namespace swell::test {

// All sums are taken in double. Images that are compared must have the same size, and pixels.

std::array<double, 3> ChannelMeans(const Image& image);

// Root of the mean squared difference over all pixels and channels.
double Rmse(const Image& image, const Image& reference);

// Mean over all pixels and channels of (image - reference)^2 / (reference^2 + epsilon).
double RelativeMse(const Image& image, const Image& reference, double epsilon = 0.01);

// Peak signal to noise ratio in decibels; infinity for equal images.
double Psnr(const Image& image, const Image& reference, double peak = 1.0);

// The means of blocks of `block` x `block` pixels from the top left corner on; blocks at the right
// and bottom edges may be smaller.
Image BlockMeans(const Image& image, uint32_t block);

// The largest difference of a value, and whether all floats are the same to the bit.
double LargestDifference(const Image& image, const Image& reference);
bool SameBits(const Image& image, const Image& reference);

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_COMPARE_IMAGES_H_
