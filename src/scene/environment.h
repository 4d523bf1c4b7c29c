// Images of lights -> what kernels need to see and draw them.
#ifndef SWELL_SCENE_ENVIRONMENT_H_
#define SWELL_SCENE_ENVIRONMENT_H_

#include <array>
#include <vector>

#include "src/scene/image.h"

namespace swell {

// A light of the scene whose emission is an image.
struct ImageLight {
  TexelImage image;
  ImageMapping mapping = ImageMapping::kEqualArea;
  std::array<float, 9> light_from_world{1, 0, 0, 0, 1, 0, 0, 0, 1};  // directions
  std::array<float, 9> world_from_light{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<float, 2> half_width{1, 1};  // kProjection: of the slide at distance 1
  bool infinite = false;
  SurfaceLookup lookup;  // kSurface
};

// Solid angle of each pixel of a row, for the two mappings of directions; their sum is 4 pi.
double PixelSolidAngle(const TexelImage& image, ImageMapping mapping, uint32_t row);
// Direction of a pixel's centre.
std::array<double, 3> PixelDirection(const TexelImage& image, ImageMapping mapping, uint32_t x,
                                     uint32_t y);

// Cells of equal steps in u and v, drawn by brightness above the mean. Brighter cells get all the
// samples, as the dimmer ones are found by scattering (Karlik et al. 2019, "MIS Compensation").
struct SkyTable {
  uint32_t rows = 0, columns = 0;
  std::vector<float> row_cdf, column_cdf, row_cosine, inverse_angle;
};
SkyTable MakeSkyTable(const TexelImage& image, ImageMapping mapping);

// Mean over the sphere of the largest channel of a directional image, or over the picture.
double MeanLevel(const ImageLight& light);

ImageLightView MakeImageLightView(const ImageLight& light, const SkyTable& table);

}  // namespace swell

#endif  // SWELL_SCENE_ENVIRONMENT_H_
