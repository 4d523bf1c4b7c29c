// Textures as kernels see them: programs of steps, each of which makes a colour from earlier ones.
#ifndef SWELL_KERNELS_TEXTURE_VIEW_H_
#define SWELL_KERNELS_TEXTURE_VIEW_H_

#include <cstdint>

#include "kernels/image_view.h"

namespace swell {

enum class TextureOp : uint32_t {
  kConstant,       // value[0..2]
  kImage,          // value[0]: scale
  kScale,          // input 0 times input 1
  kMix,            // input 0 to input 1 by input 2
  kDirectionMix,   // input 1 to input 0 by |cosine| of the normal to value[0..2], in the world
  kBilerp,         // value[0..11]: colours at (0, 0), (0, 1), (1, 0), (1, 1)
  kCheckerboard2,  // input 0 and input 1 in squares
  kCheckerboard3,  // the same in cubes
  kDots,           // input 0 within, input 1 without
  kFbm,            // value[0]: roughness
  kWrinkled,       // value[0]: roughness
  kWindy,
  kMarble,       // value[0]: roughness, value[1]: scale, value[2]: variation
  kStep,         // 1 where input 0's first channel is value[0] or more, else 0
  kVertexColor,  // of the mesh: value[0] 0: the colour, 1: its alpha
};

enum class TextureMapping : uint32_t { kUv, kSpherical, kCylindrical, kPlanar, kUvAffine };

// The value of a texture that is a number is in all three channels.
struct TextureStep {
  TextureOp op = TextureOp::kConstant;
  uint32_t input[3] = {};  // earlier steps
  TextureMapping mapping = TextureMapping::kUv;
  TextureWrap wrap = TextureWrap::kRepeat;     // along s
  TextureWrap wrap_t = TextureWrap::kAsOther;  // along t; any but kOctahedral
  TextureFilter filter = TextureFilter::kBilinear;
  uint32_t image = 0;       // row of TexturesView::images
  uint32_t second_uvs = 0;  // whether kUv and kUvAffine are of the mesh's second coordinates
  uint32_t invert = 0;
  uint32_t octaves = 0;
  float value[12] = {};
  // kUv: scale of u, of v, offset of u, of v. kPlanar: two vectors, then the offsets. kUvAffine:
  // a row-major 2x3 matrix.
  float map[8] = {1, 1, 0, 0};
  float scale_from_world = 1;  // most that texture_from_world stretches
  float texture_from_world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // row-major 3x4
};

inline constexpr uint32_t kMaxTextureSteps = 64;  // of a program

// What becomes of a step's value: words [word, word + count) of the material's parameters.
struct TextureOutput {
  uint32_t step;
  uint32_t word;
  uint32_t count;  // 1: the first channel; 3: all of them
  float min, max;  // values beyond are brought to these
};

inline constexpr uint32_t kNoTexture = 0xFFFFFFFFu;

// Its value is that of its last step.
struct TextureProgram {
  uint32_t first_step, step_count;
  uint32_t first_output, output_count;
  uint32_t bump;        // program of the height by which the surface seems displaced; kNoTexture
  uint32_t normal_map;  // row of steps, a kImage that is no part of the program; kNoTexture
  // Whether the map's second axis points to growing v also where the coordinates are mirrored;
  // else it follows from the others.
  bool normal_map_follows_v;
};

struct TexturesView {
  const TextureStep* steps;
  const TextureOutput* outputs;
  const TextureProgram* programs;
  const ImageView* images;
  const uint32_t* material_program;  // of each material, or kNoTexture; null: no material has one
  const uint32_t* shape_alpha;       // of each shape's opacity, likewise
  bool textured_mixes;               // some mix of materials has a program
};

// How wide a pixel is in the scene, for the filters of textures: as seen from the camera, also
// after bounces.
struct PixelFootprint {
  float camera[3];  // position, world space
  float spread;     // width over distance; a parallel camera's width
  bool parallel;
};

}  // namespace swell

#endif  // SWELL_KERNELS_TEXTURE_VIEW_H_
