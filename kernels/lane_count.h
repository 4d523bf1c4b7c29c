// How many rows the kernels handle at once.
#ifndef SWELL_KERNELS_LANE_COUNT_H_
#define SWELL_KERNELS_LANE_COUNT_H_

#include <cstdint>

#include "kernels/kernel.h"

namespace swell {

// Float lanes of a vector on the target in use: 16 with AVX-512, 8 with AVX2, 4 with SSE4 and NEON.
SWELL_KERNEL(uint32_t, LaneCount);

}  // namespace swell

#endif  // SWELL_KERNELS_LANE_COUNT_H_
