// Names of the pairs of sample dimensions that a path uses: two for the camera, then four a bounce.
#ifndef SWELL_KERNELS_DIMENSIONS_H_
#define SWELL_KERNELS_DIMENSIONS_H_

#include <cstdint>

namespace swell {

inline constexpr uint32_t kPairFilm = 0;
inline constexpr uint32_t kPairLens = 1;
inline constexpr uint32_t kPairFirstBounce = 2;

// Added to kPairFirstBounce + kPairsPerBounce * bounce.
inline constexpr uint32_t kPairScatter = 0;     // the BSDF's direction
inline constexpr uint32_t kPairLightPoint = 1;  // the point on the light
inline constexpr uint32_t kPairChoices = 2;     // x: the BSDF's component, y: which light
inline constexpr uint32_t kPairRoulette = 3;    // x: does the path go on
inline constexpr uint32_t kPairsPerBounce = 4;

}  // namespace swell

#endif  // SWELL_KERNELS_DIMENSIONS_H_
