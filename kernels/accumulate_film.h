// Adds ended paths to the film in exact fixed point: integer sums, so no order of adding can
// matter.
#ifndef SWELL_KERNELS_ACCUMULATE_FILM_H_
#define SWELL_KERNELS_ACCUMULATE_FILM_H_

#include "kernels/records.h"

namespace swell {

// A sum is a 128-bit two's complement integer of units of 2^-kFilmFractionBits.
inline constexpr int kFilmFractionBits = 64;
// A sample of this magnitude or more is dropped and counted like a non-finite one: 2^22 of them
// fit.
inline constexpr float kFilmLargestSample = 1.0995116e12f;  // 2^40

struct FilmPixel {
  uint64_t low[3];  // r, g, b
  uint64_t high[3];
};

struct FilmView {
  FilmPixel* pixels;    // of the crop window, row by row
  uint32_t x0, y0;      // the crop window's corner in the full frame
  uint32_t width;       // of the crop window
  float max_component;  // samples are scaled down to this largest channel; infinity: never
};

// Adds paths[rows[i]].radiance for i in [0, count); returns how many were dropped (not finite or
// too large). Scalar: 128-bit carries have no lanes.
uint64_t AccumulateFilm(const PathsIn& paths, const uint32_t* rows, size_t count,
                        const FilmView& film);

}  // namespace swell

#endif  // SWELL_KERNELS_ACCUMULATE_FILM_H_
