// The film: exact sums for every pixel of the crop window, safe to add to from all workers.
#ifndef SWELL_FILM_FILM_H_
#define SWELL_FILM_FILM_H_

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/accumulate_film.h"
#include "src/base/result.h"

namespace swell {

// Pixels [x0, x1) x [y0, y1) of a frame.
struct PixelBounds {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  uint32_t width() const { return x1 - x0; }
  uint32_t height() const { return y1 - y0; }
};

// Linear RGB, row by row from the top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

class Film {
 public:
  // The widest and highest frame: a path keeps its pixel in two halves of 32 bits.
  static constexpr uint32_t kLargestFrame = 1u << 16;

  // An error if the crop window is empty or not inside the frame, or if the sums and the images
  // made of them do not fit into the memory that is available.
  static Result<Film> Make(uint32_t frame_width, uint32_t frame_height, const PixelBounds& crop,
                           float max_component);

  // Adds ended paths; returns how many samples were dropped. May be called by several threads at
  // once: bands of rows are locked one after the other.
  uint64_t Add(const PathsIn& paths, const uint32_t* rows, size_t count);

  // Samples added or dropped so far; may be asked while others add.
  uint64_t samples_added() const { return samples_added_->load(std::memory_order_relaxed); }

  // The mean over `samples_per_pixel` samples, times `scale` (finite, not negative). Correctly
  // rounded from the exact sum: one rounding, to nearest even. Not while others add.
  Image Resolve(uint64_t samples_per_pixel, float scale) const;

  const PixelBounds& crop() const { return crop_; }
  uint32_t frame_width() const { return frame_width_; }
  uint32_t frame_height() const { return frame_height_; }
  size_t bytes() const { return pixels_.size() * sizeof(FilmPixel); }
  // The sums, row by row of the crop window.
  const std::vector<FilmPixel>& pixels() const { return pixels_; }

 private:
  Film() = default;

  uint32_t frame_width_ = 0, frame_height_ = 0;
  PixelBounds crop_;
  float max_component_ = 0;
  std::vector<FilmPixel> pixels_;
  std::unique_ptr<std::atomic_flag[]> band_locks_;
  std::unique_ptr<std::atomic<uint64_t>> samples_added_ =
      std::make_unique<std::atomic<uint64_t>>(0);
};

// sum * scale / count in units of 2^-kFilmFractionBits, rounded once, to the nearest float, halves
// to even. `scale` is finite and not negative, `count` not 0.
float ResolveSum(__int128 sum, uint64_t count, float scale);

}  // namespace swell

#endif  // SWELL_FILM_FILM_H_
