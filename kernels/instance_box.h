// An instance and its object in, the instance's box in the world out; builder and kernels agree on
// it to the bit, because a hit may not lie before it (see kernels/instance-inl.h).
#ifndef SWELL_KERNELS_INSTANCE_BOX_H_
#define SWELL_KERNELS_INSTANCE_BOX_H_

#include <cmath>

#include "kernels/bvh_node.h"

namespace swell {

// The image of a box of middle m and half extents h lies within |to_world| h of the image of m. The
// two sums are off by at most 4 r reach, with r = 2^-24 and reach the sum of the absolute terms;
// the margin is 16 r reach, so that 12 r reach is left for the rounding of the slabs (5 r, see
// triangle-inl.h).
inline void InstanceBox(const InstanceRecord& instance, const ObjectRecord& object,
                        float (&bounds)[6]) {
  float middle[3], half[3], reach = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float* row = instance.to_world + 3 * k;
    const float x = row[0] * object.middle[0];
    const float y = row[1] * object.middle[1];
    const float z = row[2] * object.middle[2];
    middle[k] = ((x + y) + z) + instance.centre[k];
    half[k] = (std::fabs(row[0]) * object.half[0] + std::fabs(row[1]) * object.half[1]) +
              std::fabs(row[2]) * object.half[2];
    const float sum =
        ((std::fabs(x) + std::fabs(y)) + (std::fabs(z) + std::fabs(instance.centre[k]))) + half[k];
    reach = reach < sum ? sum : reach;
  }
  for (int k = 0; k < 3; ++k) {
    const float margin = half[k] + reach * kBoxMargin;
    bounds[k] = middle[k] - margin;
    bounds[k + 3] = middle[k] + margin;
  }
}

}  // namespace swell

#endif  // SWELL_KERNELS_INSTANCE_BOX_H_
