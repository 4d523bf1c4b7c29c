// Ended paths from all workers in, one image of correctly rounded means out.
#include "src/film/film.h"

#include <bit>
#include <cmath>
#include <new>
#include <thread>

#include "src/base/available_memory.h"
#include "src/base/check.h"

namespace swell {
namespace {

using Uint128 = unsigned __int128;

// Rows of pixels under one lock: the height of a small tile, so that workers on different tiles
// seldom meet and a tile's paths seldom change the lock.
constexpr uint32_t kBandRows = 16;
// Turns of waiting before the core is given to another thread, maybe the one that holds the lock.
constexpr int kSpins = 64;
// What a pixel takes while it is written: its sums and its resolved floats.
constexpr uint64_t kBytesPerPixel = sizeof(FilmPixel) + 3 * sizeof(float);

void Lock(std::atomic_flag& flag) {
  for (int turn = 0; flag.test_and_set(std::memory_order_acquire); ++turn) {
    while (flag.test(std::memory_order_relaxed)) {
      if (++turn >= kSpins) std::this_thread::yield();
    }
  }
}

void Unlock(std::atomic_flag& flag) { flag.clear(std::memory_order_release); }

std::string SizeForPeople(uint32_t width, uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Error DoesNotFit(const PixelBounds& crop, uint64_t bytes, const std::string& available) {
  return Error{"a film of " + SizeForPeople(crop.width(), crop.height()) + " pixels needs " +
               BytesForPeople(bytes) + " of memory" + available +
               "; lower --resolution or render parts with --cropwindow"};
}

int LeadingZeros(Uint128 value) {
  const uint64_t high = static_cast<uint64_t>(value >> 64);
  return high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(static_cast<uint64_t>(value));
}

// (bits + a part below 1 that is not 0 if `inexact`) * 2^exponent to the nearest float, halves to
// even. If `inexact`, bits must be at least 2^25.
float RoundToFloat(Uint128 bits, bool inexact, int exponent) {
  if (bits == 0) return 0.0f;
  constexpr int kPrecision = 24;
  constexpr int kLowestExponent = -149;  // of the last bit of subnormal floats
  int shift = 128 - LeadingZeros(bits) - kPrecision;
  if (exponent + shift < kLowestExponent) shift = kLowestExponent - exponent;
  if (shift <= 0) return std::ldexp(static_cast<float>(static_cast<uint32_t>(bits)), exponent);
  if (shift > 128) return 0.0f;

  const Uint128 kept = shift == 128 ? 0 : bits >> shift;
  const Uint128 half = Uint128{1} << (shift - 1);
  const Uint128 rest = shift == 128 ? bits : bits & ((half << 1) - 1);
  const bool up = rest > half || (rest == half && (inexact || (kept & 1) != 0));
  return std::ldexp(static_cast<float>(static_cast<uint32_t>(kept) + (up ? 1u : 0u)),
                    exponent + shift);
}

}  // namespace

Result<Film> Film::Make(uint32_t frame_width, uint32_t frame_height, const PixelBounds& crop,
                        float max_component) {
  if (frame_width == 0 || frame_height == 0 || frame_width > kLargestFrame ||
      frame_height > kLargestFrame) {
    return Error{"a frame of " + SizeForPeople(frame_width, frame_height) +
                 " pixels cannot be rendered; width and height must be from 1 to " +
                 std::to_string(kLargestFrame)};
  }
  if (crop.x0 >= crop.x1 || crop.y0 >= crop.y1 || crop.x1 > frame_width || crop.y1 > frame_height) {
    return Error{"the crop window [" + std::to_string(crop.x0) + ", " + std::to_string(crop.x1) +
                 ") x [" + std::to_string(crop.y0) + ", " + std::to_string(crop.y1) +
                 ") has no pixels or is not inside the frame of " +
                 SizeForPeople(frame_width, frame_height) + "; check --cropwindow"};
  }
  const uint64_t pixel_count = uint64_t{crop.width()} * crop.height();
  const uint64_t bytes = pixel_count * kBytesPerPixel;
  const uint64_t available = AvailableMemory();
  if (bytes > available) {
    return DoesNotFit(crop, bytes, " and " + BytesForPeople(available) + " are available");
  }

  Film film;
  film.frame_width_ = frame_width;
  film.frame_height_ = frame_height;
  film.crop_ = crop;
  film.max_component_ = max_component;
  try {
    film.pixels_.resize(pixel_count);
    film.band_locks_ =
        std::make_unique<std::atomic_flag[]>((crop.height() + kBandRows - 1) / kBandRows);
  } catch (const std::bad_alloc&) {
    return DoesNotFit(crop, bytes, ", more than the system gives");
  }
  return film;
}

uint64_t Film::Add(const PathsIn& paths, const uint32_t* rows, size_t count) {
  const FilmView view = {pixels_.data(), crop_.x0, crop_.y0, crop_.width(), max_component_};
  const auto band_of = [&](size_t i) {
    const uint32_t pixel = paths.pixel[rows[i]];
    const uint32_t x = (pixel & 0xFFFFu) - crop_.x0;  // wraps around left of the window
    const uint32_t y = (pixel >> 16) - crop_.y0;
    SWELL_CHECK(x < crop_.width() && y < crop_.height());
    return y / kBandRows;
  };

  uint64_t dropped = 0;
  size_t first = 0;
  while (first < count) {
    const uint32_t band = band_of(first);
    size_t last = first + 1;
    while (last < count && band_of(last) == band) ++last;

    Lock(band_locks_[band]);
    dropped += AccumulateFilm(paths, rows + first, last - first, view);
    Unlock(band_locks_[band]);
    first = last;
  }
  samples_added_->fetch_add(count, std::memory_order_relaxed);
  return dropped;
}

Image Film::Resolve(uint64_t samples_per_pixel, float scale) const {
  SWELL_CHECK(samples_per_pixel > 0);
  SWELL_CHECK(std::isfinite(scale) && scale >= 0);
  Image image{crop_.width(), crop_.height(), std::vector<float>(pixels_.size() * 3)};
  for (size_t i = 0; i < pixels_.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const Uint128 sum = Uint128{pixels_[i].high[c]} << 64 | pixels_[i].low[c];
      image.rgb[3 * i + c] = ResolveSum(static_cast<__int128>(sum), samples_per_pixel, scale);
    }
  }
  return image;
}

float ResolveSum(__int128 sum, uint64_t count, float scale) {
  if (sum == 0 || scale == 0) return 0.0f;
  const Uint128 magnitude = sum < 0 ? -static_cast<Uint128>(sum) : static_cast<Uint128>(sum);
  int exponent;
  const auto factor = static_cast<uint32_t>(std::ldexp(std::frexp(scale, &exponent), 24));
  exponent -= 24 + kFilmFractionBits;

  // The product has up to 152 bits: upper * 2^64 + lower.
  const Uint128 partial = (magnitude & ~uint64_t{0}) * factor;
  Uint128 upper = (magnitude >> 64) * factor + (partial >> 64);
  uint64_t lower = static_cast<uint64_t>(partial);
  exponent += 64;
  // Bring its first bit to the top of `upper`; what stays in `lower` is below one unit, cannot
  // change the integer quotient, and only makes it inexact. The quotient has 64 bits or more.
  if (upper == 0) {
    upper = lower;
    lower = 0;
    exponent -= 64;
  }
  const int zeros = LeadingZeros(upper);
  if (zeros >= 64) {
    upper = upper << 64 | lower;
    lower = 0;
    exponent -= 64;
  }
  const int shift = LeadingZeros(upper);
  if (shift > 0) {
    upper = upper << shift | lower >> (64 - shift);
    lower <<= shift;
    exponent -= shift;
  }
  const Uint128 quotient = upper / count;
  const bool inexact = quotient * count != upper || lower != 0;
  const float result = RoundToFloat(quotient, inexact, exponent);
  return sum < 0 ? -result : result;
}

}  // namespace swell
