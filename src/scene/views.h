// What kernels see of camera and filter, derived from what the scene file said.
#ifndef SWELL_SCENE_VIEWS_H_
#define SWELL_SCENE_VIEWS_H_

#include <vector>

#include "src/scene/scene.h"

namespace swell {

// The camera of a frame of width x height pixels.
CameraView MakeCameraView(const Camera& camera, uint32_t width, uint32_t height);

// Width of a pixel of that camera as textures are to be filtered: an eighth of it, which is where
// pbrt-v4 ends with many samples; filtered any wider, pictures would not converge to detail.
PixelFootprint MakePixelFootprint(const CameraView& camera);

// Tables for importance sampling of a pixel filter.
struct FilterTables {
  std::vector<float> quantiles_x, quantiles_y;  // kFilterBins + 1
  std::vector<float> weight_x, weight_y;        // kFilterBins
  FilterView view() const {
    return {quantiles_x.data(), quantiles_y.data(), weight_x.data(), weight_y.data()};
  }
};
FilterTables MakeFilterTables(const Filter& filter);

}  // namespace swell

#endif  // SWELL_SCENE_VIEWS_H_
