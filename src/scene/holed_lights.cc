// Emitting shapes with holes -> lights that are looked up as images are.
#include "src/scene/holed_lights.h"

namespace swell {
namespace {

// The opacity of what emits, if any ray may pass it.
const TextureStep* Opacity(const Scene& scene, const LightRecord& light) {
  if (light.type > kEllipsoidLight) return nullptr;
  const uint32_t alpha = scene.shapes[scene.prim_shape[light.prim]].alpha;
  return alpha == kNoTexture ? nullptr : &scene.texture_nodes[alpha];
}

bool IsZero(const TextureStep& step) {
  return step.op == TextureOp::kConstant && step.value[0] == 0.0f;
}

}  // namespace

void MarkHoles(const Scene& scene, SceneTables& tables) {
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
    const TextureStep* opacity = Opacity(scene, light);
    if (opacity == nullptr) continue;
    if (IsZero(*opacity)) {
      // As in pbrt-v4: such a light shines, but cannot be seen.
      light.flags |= kLightUnseen;
      tables.view.lights.any_unseen = true;
    } else if (light.image == kNone) {
      light.image = row;
      is_used = true;
    }
  }
  if (is_used) tables.image_lights.push_back(MakeImageLightView(white, {}));
}

}  // namespace swell
