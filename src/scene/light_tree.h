// Bounds of lights in, a tree that picks lights by what they may send to a point out.
#ifndef SWELL_SCENE_LIGHT_TREE_H_
#define SWELL_SCENE_LIGHT_TREE_H_

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/scene_view.h"
#include "src/scene/light_bounds.h"

namespace swell {

// How deep a tree may be: a light's way through it is one word of bits.
inline constexpr uint32_t kMaxLightTreeDepth = 32;

struct LightTree {
  std::vector<LightNode> nodes;  // pairs of siblings
  uint32_t root = 0;             // as LightNode::child
};

struct BoundedLight {
  LightBounds bounds;
  uint32_t light;  // row of LightsView::records
};

// A binary tree over the lights, one a leaf, split where the surface area orientation heuristic
// (Conty Estevez & Kulla 2018, section 4.4) is least. Writes every light's way from the root to
// trails[light]: bit k is the side taken at depth k. Lights change their order.
LightTree BuildLightTree(std::span<BoundedLight> lights, std::span<uint32_t> trails);

}  // namespace swell

#endif  // SWELL_SCENE_LIGHT_TREE_H_
