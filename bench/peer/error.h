// Pictures in, how far they lie from one of many samples out.
#ifndef SWELL_BENCH_PEER_ERROR_H_
#define SWELL_BENCH_PEER_ERROR_H_

#include "src/film/film.h"

namespace swell::bench {

// Means over all pixels and channels.
struct PictureError {
  double squared = 0;   // of the difference
  double relative = 0;  // of the difference over the true value: few bright pixels weigh less
};

// The mean of two pictures with as many samples each but other seeds, and what it is off by itself.
struct TruePicture {
  TruePicture(const Image& a, const Image& b);

  // Without the error that this picture itself has.
  PictureError ErrorOf(const Image& image) const;

  Image mean;
  PictureError own;  // error of `mean`
  double floor = 0;  // added to the square of a true value, so that black ones can be divided by
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_ERROR_H_
