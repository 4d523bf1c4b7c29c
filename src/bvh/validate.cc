// A tree and its scene in, what is wrong with the tree out.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "kernels/records.h"
#include "src/bvh/bvh.h"
#include "src/bvh/covers.h"
#include "src/bvh/prim_boxes.h"

namespace swell {
namespace {

class Validator {
 public:
  Validator(const Bvh& bvh, const Scene& scene) : bvh_(bvh), scene_(scene) {
    std::fill_n(all_.lower, 3, -bvh.max_abs_coord);
    std::fill_n(all_.upper, 3, bvh.max_abs_coord);
  }

  std::string Run() {
    const size_t prims = scene_.triangle_count() + scene_.spheres.size();
    visited_.assign(bvh_.nodes.size(), 0);
    seen_.assign(prims + scene_.instances.size(), 0);
    whole_.assign(scene_.triangle_count(), 0);
    slots_.assign(bvh_.blocks.size(), 0);
    if (bvh_.nodes.size() == 0) return "there is no root";
    if (bvh_.objects.size() != scene_.objects.size()) return "objects are lost";
    FindOwners();
    CheckView();
    VisitNode(0, 1, nullptr);
    CheckInstances();
    for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
      if (used_[i]) VisitObject(i);
    }
    for (size_t i = 0; i < prims && wrong_.empty(); ++i) {
      const bool drawn = owner_[i] == kWorld || used_[owner_[i]];
      if (seen_[i] != (drawn ? 1 : 0))
        Say("primitive " + std::to_string(i) + " is not in its leaves");
    }
    CheckCovers();
    for (size_t i = 0; i < visited_.size(); ++i) {
      if (visited_[i] != 1) Say("node " + std::to_string(i) + " is not reached once");
    }
    for (size_t i = 0; i < slots_.size(); ++i) CheckSlots(i);
    if (depth_ != bvh_.depth) Say("the depth is " + std::to_string(depth_));
    return wrong_;
  }

 private:
  static constexpr uint32_t kWorld = kNone;

  // Which object claims a primitive, and which objects have instances.
  void FindOwners() {
    owner_.assign(scene_.triangle_count() + scene_.spheres.size(), kWorld);
    used_.assign(scene_.objects.size(), false);
    for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& object = scene_.objects[i];
      const size_t sphere = scene_.triangle_count() + object.first_sphere;
      std::fill_n(owner_.begin() + object.first_triangle, object.triangle_count, i);
      std::fill_n(owner_.begin() + static_cast<ptrdiff_t>(sphere), object.sphere_count, i);
    }
    for (const InstanceRecord& instance : scene_.instances) used_[instance.object] = true;
  }

  void CheckInstances() {
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      const InstanceRecord& instance = scene_.instances[i];
      const bool can_be_hit = InstanceBox3(instance, bvh_.objects[instance.object]).has_value();
      if (seen_[owner_.size() + i] != (can_be_hit ? 1 : 0)) Say("an instance is not in one leaf");
    }
  }

  void VisitObject(uint32_t index) {
    const ObjectRecord& object = bvh_.objects[index];
    current_ = index;
    Box3 box;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = object.middle[k] - object.half[k];
      box.upper[k] = object.middle[k] + object.half[k];
    }
    VisitNode(object.root, 1, &box);
  }

  void See(uint32_t prim) {
    ++seen_[prim];
    if (owner_[prim] != current_) Say("a primitive is in another object's tree");
  }

  void Say(const std::string& what) {
    if (wrong_.empty()) wrong_ = what;
  }

  static bool IsInside(const Box3& inner, const Box3& outer) {
    for (int k = 0; k < 3; ++k) {
      if (!(inner.lower[k] >= outer.lower[k] && inner.upper[k] <= outer.upper[k])) return false;
    }
    return true;
  }

  void CheckInside(const Box3& inner, const Box3* outer, const std::string& name) {
    if (outer == nullptr || IsInside(inner, *outer)) return;
    Say(name + " leaves its parent's box");
  }

  // What kernels see beside nodes and blocks.
  void CheckView() {
    if (bvh_.triangle_count != scene_.triangle_count() ||
        bvh_.sphere_count != scene_.spheres.size() || bvh_.spheres != scene_.spheres.data() ||
        bvh_.instances != scene_.instances.data()) {
      Say("the tree is of another scene");
    }
    if (bvh_.sphere_boxes.size() != 6 * scene_.spheres.size())
      return Say("boxes of spheres are lost");
    for (size_t i = 0; i < scene_.spheres.size(); ++i) {
      const Box3 box = SphereBox(scene_.spheres[i]);
      const float* own = &bvh_.sphere_boxes[6 * i];
      if (!std::equal(own, own + 3, box.lower) || !std::equal(own + 3, own + 6, box.upper)) {
        Say("a sphere's box is another one");
      }
    }
  }

  void CheckCovers() {
    std::sort(parts_.begin(), parts_.end(),
              [](const Part& a, const Part& b) { return a.prim < b.prim; });
    std::vector<Box3> boxes;
    for (size_t i = 0; i < parts_.size();) {
      const uint32_t prim = parts_[i].prim;
      boxes.clear();
      for (; i < parts_.size() && parts_[i].prim == prim; ++i) boxes.push_back(parts_[i].box);
      if (whole_[prim] == 0) CheckCover(prim, boxes);
    }
  }

  // A triangle in several leaves: every part of it is in one, with the whole triangle's margin. An
  // eighth of it is for the roundings of the cuts, see kernels/triangle-inl.h.
  void CheckCover(uint32_t prim, const std::vector<Box3>& boxes) {
    const float* vertex[3];
    float most = 0.0f;
    for (size_t k = 0; k < 3; ++k) {
      vertex[k] = &scene_.positions[3 * size_t{scene_.indices[3 * size_t{prim} + k]}];
      for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::fabs(vertex[k][axis]));
    }
    if (!Covers(boxes, vertex[0], vertex[1], vertex[2], most * (kBoxMargin * 0.875))) {
      Say("triangle " + std::to_string(prim) + " is not covered by its leaves");
    }
  }

  // The first `count` entries name the children, the others the empty slots, and the number of
  // children is the node's.
  static bool IsOrder(uint32_t order, uint32_t count) {
    uint32_t named = 0;
    for (uint32_t k = 0; k < kBvhWidth; ++k) {
      named |= 1u << ((order >> (kOrderBits * k)) % kBvhWidth);
      if (k + 1 == count && named != (1u << count) - 1) return false;
    }
    return named == (1u << kBvhWidth) - 1 && order >> kChildCountShift == count;
  }

  // Leaves that share a block test its first slots, each up to its own last one.
  void CheckSlots(size_t index) {
    const uint32_t(&prims)[kBlockWidth] = bvh_.blocks[index].prim;
    for (uint32_t i = 0; i < kBlockWidth; ++i) {
      if (prims[i] == kNoPrim) CheckPoint(bvh_.blocks[index], i);
      const bool twice = std::find(prims, prims + i, prims[i]) != prims + i;
      if ((prims[i] == kNoPrim) != (i >= slots_[index]) || (twice && prims[i] != kNoPrim)) {
        Say("block " + std::to_string(index) + " has other triangles than its leaves");
      }
    }
  }

  void VisitNode(uint32_t index, uint32_t level, const Box3* outer) {
    if (index >= bvh_.nodes.size() || ++visited_[index] > 1) return Say("a bad or shared node");
    if (level > kMaxBvhDepth) return Say("the tree is too deep");
    depth_ = std::max(depth_, level);
    const BvhNode& node = bvh_.nodes[index];
    if (ChildCount(node) > kBvhWidth) return Say("too many children");
    for (const uint32_t order : node.order) {
      if (!IsOrder(order, ChildCount(node)))
        Say("an octant's order does not list every slot once, children first");
    }
    for (uint32_t i = 0; i < kBvhWidth; ++i) {
      const bool empty = node.child[i] == kEmptyChild;
      if (empty != (i >= ChildCount(node))) Say("empty children are not the last ones");
      Box3 box;
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = node.bounds[k][i];
        box.upper[k] = node.bounds[k + 3][i];
        if (empty && !(box.lower[k] > box.upper[k])) Say("an empty child has a box");
      }
      if (empty) continue;
      CheckInside(box, outer, "a node");
      CheckInside(box, &all_, "a node");
      VisitChild(node.child[i], level, box);
    }
  }

  void VisitChild(uint32_t child, uint32_t level, const Box3& box) {
    if ((child & kLeafBit) == 0) return VisitNode(child, level + 1, &box);
    if ((child & kSphereLeafBit) != 0) {
      const uint32_t row = child & kSphereIndexMask;
      return (child & kInstanceLeafBit) != 0 ? VisitInstance(row, box) : VisitSphere(row, box);
    }
    const uint32_t index = LeafBlock(child);
    if (index >= bvh_.blocks.size()) return Say("a bad block");
    slots_[index] = std::max(slots_[index], LeafCount(child));
    const TriangleBlock& block = bvh_.blocks[index];
    for (uint32_t i = 0; i < LeafCount(child); ++i) {
      const uint32_t prim = block.prim[i];
      if (prim == kNoPrim) return Say("a leaf's count is wrong");
      if (prim >= scene_.triangle_count()) return Say("a bad triangle");
      See(prim);
      seen_[prim] = 1;  // parts of it may be in many leaves
      CheckVertices(block, i);
      const Box3 whole = TriangleBox(scene_, prim);
      if (IsInside(whole, box)) {
        whole_[prim] = 1;
      } else {
        parts_.push_back({prim, box});
      }
    }
  }

  void CheckVertices(const TriangleBlock& block, uint32_t i) {
    if (!CanBeHit(scene_, block.prim[i])) return CheckPoint(block, i);
    for (size_t k = 0; k < 3; ++k) {
      const size_t vertex = scene_.indices[3 * size_t{block.prim[i]} + k];
      for (size_t axis = 0; axis < 3; ++axis) {
        const float* position = &scene_.positions[3 * vertex + axis];
        if (std::memcmp(position, &block.vertex[k][axis][i], sizeof(float)) != 0) {
          Say("a block has other vertices than its triangles");
        }
      }
    }
  }

  // Of rows that no ray may hit.
  void CheckPoint(const TriangleBlock& block, uint32_t i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const float at = block.vertex[0][axis][i];
      if (!(std::fabs(at) <= bvh_.max_abs_coord && at == block.vertex[1][axis][i] &&
            at == block.vertex[2][axis][i])) {
        Say("a row of a block that no ray may hit is not a point");
      }
    }
  }

  void VisitSphere(uint32_t sphere, const Box3& box) {
    if (sphere >= scene_.spheres.size()) return Say("a bad sphere");
    See(static_cast<uint32_t>(scene_.triangle_count()) + sphere);
    CheckInside(SphereBox(scene_.spheres[sphere]), &box, "a sphere");
  }

  void VisitInstance(uint32_t row, const Box3& box) {
    if (row >= scene_.instances.size() || current_ != kWorld) return Say("a bad instance");
    ++seen_[owner_.size() + row];
    const InstanceRecord& instance = scene_.instances[row];
    const auto own = InstanceBox3(instance, bvh_.objects[instance.object]);
    if (!own) return Say("an instance that cannot be hit is in the tree");
    CheckInside(*own, &box, "an instance");
  }

  struct Part {
    uint32_t prim;
    Box3 box;
  };

  const Bvh& bvh_;
  const Scene& scene_;
  Box3 all_;  // as far as bvh_.max_abs_coord
  std::vector<uint32_t> visited_, seen_, whole_, slots_;
  std::vector<Part> parts_;      // boxes of leaves that do not hold all of a triangle
  std::vector<uint32_t> owner_;  // of primitives
  std::vector<bool> used_;       // objects
  uint32_t current_ = kWorld;    // whose tree is visited
  uint32_t depth_ = 0;
  std::string wrong_;
};

}  // namespace

std::string ValidateBvh(const Bvh& bvh, const Scene& scene) { return Validator(bvh, scene).Run(); }

}  // namespace swell
