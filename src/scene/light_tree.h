// Bounds of lights in, a tree that picks lights by what they may send to a point out.
#ifndef SWELL_SCENE_LIGHT_TREE_H_
#define SWELL_SCENE_LIGHT_TREE_H_

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/scene_view.h"
#include "src/scene/light_bounds.h"

namespace swell {

// How deep the binary tree may be. Rows of eight siblings take in three of its levels, so that a
// light's way through them is one word of bits.
inline constexpr uint32_t kMaxLightTreeDepth = 30;

struct LightTree {
  std::vector<LightNode> nodes;  // rows of siblings
  uint32_t root = 0;             // as LightNode::child
};

struct BoundedLight {
  LightBounds bounds;
  uint32_t light;  // row of LightsView::records
};

// A binary tree over the lights, one a leaf, split where the surface area orientation heuristic
// (Conty Estevez & Kulla 2018, section 4.4) is least, then widened. Writes every light's way from
// the root to trails[light], as in LightRecord. Lights change their order.
LightTree BuildLightTree(std::span<BoundedLight> lights, std::span<uint32_t> trails);

}  // namespace swell

#endif  // SWELL_SCENE_LIGHT_TREE_H_
