// Images and the lights made of them, as kernels see them: texels in tiles, level after level.
#ifndef SWELL_KERNELS_IMAGE_VIEW_H_
#define SWELL_KERNELS_IMAGE_VIEW_H_

#include <cstdint>

namespace swell {

// How a channel is stored. Bytes are codes of a table; halves are IEEE binary16 without infinities.
enum class TexelFormat : uint32_t { kByte, kHalf, kFloat };

// How an image goes on beyond its edges. kAsOther: as along the other axis.
enum class TextureWrap : uint32_t { kRepeat, kBlack, kClamp, kOctahedral, kMirror, kAsOther };
enum class TextureFilter : uint32_t { kPoint, kBilinear, kTrilinear };

inline constexpr uint32_t kTileShift = 2;  // a tile has 4 x 4 texels, row by row
inline constexpr uint32_t kTileSide = 1u << kTileShift;
inline constexpr uint32_t kMaxImageSide = 65536;
inline constexpr uint32_t kMaxImageLevels = 17;

struct ImageLevel {
  uint32_t width, height;
  uint32_t tiles_across;
  uint32_t first;  // word of its first tile
};

// Images have 1 channel or 3. A texel of 3 takes one word of bytes, two of halves, three of floats;
// a texel of 1 is a byte, a half or a word.
struct ImageView {
  const uint32_t* words;
  const float* decode;  // 256 values of codes, for kByte
  TexelFormat format;
  uint32_t channels;
  uint32_t level_count;  // level 0 is the largest
  ImageLevel levels[kMaxImageLevels];
};

enum class ImageMapping : uint32_t {
  kEqualArea,   // the sphere of directions to a square (Clarberg 2008), z up in the middle
  kLatLong,     // u: angle about z from x to y, v: angle from z
  kProjection,  // a slide in front of the light, which looks along z
  kSurface,     // texture coordinates of the surface that emits
};

// How a surface that emits an image looks it up: bilinear, or the nearest texel for kPoint.
struct SurfaceLookup {
  TextureWrap wrap = TextureWrap::kClamp;      // along s
  TextureWrap wrap_t = TextureWrap::kAsOther;  // along t
  TextureFilter filter = TextureFilter::kBilinear;
  uint32_t second_uvs = 0;  // whether by the mesh's second coordinates
};

// A light whose radiance (or intensity) is that of its LightRecord times an image.
struct ImageLightView {
  ImageView image;
  ImageMapping mapping;
  float light_from_world[9];  // directions, row-major
  float world_from_light[9];
  float jacobian;        // |determinant of light_from_world|
  float half_width[2];   // kProjection: of the slide at distance 1 along z
  SurfaceLookup lookup;  // kSurface
  // kEqualArea and kLatLong of infinite lights: cells of equal steps in u and v, drawn by row, then
  // by column.
  uint32_t rows, columns;      // 0: not drawn
  const float* row_cdf;        // rows + 1, from 0 to 1
  const float* column_cdf;     // columns + 1 for each row
  const float* row_cosine;     // rows + 1; kLatLong: at the edges of rows
  const float* inverse_angle;  // rows; 1 / solid angle of a row's cell
};

}  // namespace swell

#endif  // SWELL_KERNELS_IMAGE_VIEW_H_
