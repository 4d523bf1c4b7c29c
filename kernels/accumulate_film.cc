// Ended paths in, the pixels' 128-bit sums out: a float is a mantissa that is shifted into place.
#include "kernels/accumulate_film.h"

#include <bit>

namespace swell {
namespace {

using Int128 = unsigned __int128;

constexpr uint32_t kSignBit = 0x80000000u;
constexpr int kMantissaBits = 23;
constexpr uint32_t kImplicitBit = 1u << kMantissaBits;
// A float with exponent field e is mantissa * 2^(e - 150).
constexpr int kExponentBias = 127 + kMantissaBits;
constexpr uint32_t kLargestSampleBits = std::bit_cast<uint32_t>(kFilmLargestSample);
static_assert(kFilmLargestSample == 1099511627776.0f);

// Fit also holds for infinities and NaNs: their bits without sign are above those of all numbers.
bool Fits(float value) { return (std::bit_cast<uint32_t>(value) & ~kSignBit) < kLargestSampleBits; }

// Exact for multiples of the quantum (every float of magnitude 2^-41 or more); else rounded to the
// nearest, halves away from zero, so that value and -value cancel.
Int128 ToFixedPoint(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const uint32_t exponent = (bits & ~kSignBit) >> kMantissaBits;
  const uint32_t fraction = bits & (kImplicitBit - 1);
  const uint64_t mantissa = exponent == 0 ? fraction : fraction | kImplicitBit;
  const int shift =
      static_cast<int>(exponent == 0 ? 1 : exponent) - kExponentBias + kFilmFractionBits;

  Int128 magnitude;
  if (shift >= 0) {
    magnitude = static_cast<Int128>(mantissa) << shift;
  } else if (shift >= -kMantissaBits - 1) {
    magnitude = (mantissa + (uint64_t{1} << (-shift - 1))) >> -shift;
  } else {
    magnitude = 0;  // below half a quantum
  }
  const Int128 negative = (bits & kSignBit) != 0 ? ~Int128{0} : Int128{0};
  return (magnitude ^ negative) - negative;
}

void AddTo(FilmPixel& pixel, int channel, float value) {
  const Int128 sum =
      (static_cast<Int128>(pixel.high[channel]) << 64 | pixel.low[channel]) + ToFixedPoint(value);

  pixel.low[channel] = static_cast<uint64_t>(sum);
  pixel.high[channel] = static_cast<uint64_t>(sum >> 64);
}

float LargestOf(const float (&rgb)[3]) {
  const float larger = rgb[0] > rgb[1] ? rgb[0] : rgb[1];
  return larger > rgb[2] ? larger : rgb[2];
}

}  // namespace

uint64_t AccumulateFilm(const PathsIn& paths, const uint32_t* rows, size_t count,
                        const FilmView& film) {
  uint64_t dropped = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t row = rows[i];
    const uint32_t position = paths.pixel[row];
    float rgb[3] = {paths.radiance.r[row], paths.radiance.g[row], paths.radiance.b[row]};

    if (!Fits(rgb[0]) || !Fits(rgb[1]) || !Fits(rgb[2])) {
      ++dropped;
      continue;
    }
    const float largest = LargestOf(rgb);
    if (largest > film.max_component) {
      // In double the product is exact, so that the largest channel becomes max_component itself.
      for (float& channel : rgb) {
        channel = static_cast<float>(static_cast<double>(channel) * film.max_component / largest);
      }
    }

    const size_t x = (position & 0xFFFFu) - film.x0;
    const size_t y = (position >> 16) - film.y0;
    FilmPixel& pixel = film.pixels[y * film.width + x];
    for (int channel = 0; channel < 3; ++channel) AddTo(pixel, channel, rgb[channel]);
  }
  return dropped;
}

}  // namespace swell
