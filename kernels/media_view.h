// What is between surfaces, as kernels see it: media that absorb, and what shapes divide them.
#ifndef SWELL_KERNELS_MEDIA_VIEW_H_
#define SWELL_KERNELS_MEDIA_VIEW_H_

#include <cstdint>

namespace swell {

inline constexpr uint32_t kVacuum = 0;  // the medium that does nothing, always the first

// The media on both sides of every shape; where they are equal, light keeps the one that it is in.
struct SidesView {
  const uint32_t* inside;
  const uint32_t* outside;
};

struct MediaView {
  const float* absorption;  // red, green and blue of each medium, per unit of the world's length
  SidesView surfaces;       // of shapes that scatter light
  SidesView borders;        // of shapes that are nothing but the border of a medium
  uint32_t camera;          // the medium that the camera stands in
  bool any_border;
};

}  // namespace swell

#endif  // SWELL_KERNELS_MEDIA_VIEW_H_
