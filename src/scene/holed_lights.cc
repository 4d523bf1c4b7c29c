// Emitting shapes with holes -> lights that are looked up as images are.
#include "src/scene/holed_lights.h"

namespace swell {
namespace {

// Whether light sampling must ask for the opacity of what emits. pbrt-v4 takes an opacity of 0 for
// a light that cannot be seen, not for one that does not shine.
bool HasHoles(const Scene& scene, const LightRecord& light) {
  if (light.type > kEllipsoidLight) return false;
  const uint32_t alpha = scene.shapes[scene.prim_shape[light.prim]].alpha;
  if (alpha == kNoTexture) return false;
  const TextureStep& step = scene.texture_nodes[alpha];
  return step.op != TextureOp::kConstant || step.value[0] != 0.0f;
}

}  // namespace

void AddWhiteImage(const Scene& scene, SceneTables& tables) {
  static const ImageLight white = [] {
    Pixels pixel;
    pixel.width = pixel.height = pixel.channels = 1;
    pixel.values = {1.0f};
    ImageLight light;
    light.image = MakeTexelImage(pixel, Levels::kOne);
    light.mapping = ImageMapping::kSurface;
    return light;
  }();
  const auto row = static_cast<uint32_t>(tables.image_lights.size());
  bool is_used = false;
  for (LightRecord& light : tables.lights) {
    if (!HasHoles(scene, light) || light.image != kNone) continue;
    light.image = row;
    is_used = true;
  }
  if (is_used) tables.image_lights.push_back(MakeImageLightView(white, {}));
}

}  // namespace swell
