// Splits lights in two until each is alone, and writes what kernels read.
#include "src/scene/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace swell {
namespace {

constexpr size_t kBuckets = 12;  // as pbrt-v4's and the paper's examples have

double Extent(const LightBounds& b, size_t axis) { return b.box.high[axis] - b.box.low[axis]; }
double Centre(const LightBounds& b, size_t axis) {
  return (b.box.low[axis] + b.box.high[axis]) / 2;
}

double SurfaceArea(const LightBounds& b) {
  const double x = Extent(b, 0), y = Extent(b, 1), z = Extent(b, 2);
  return 2 * (x * y + y * z + z * x);
}

// Equation 2's terms of one side. Lights on a line or in a point have no area: their extent counts.
double Cost(const LightBounds& b, double least_area) {
  return b.intensity * OrientationMeasure(b) * std::max(SurfaceArea(b), least_area);
}

struct Split {
  size_t axis = 0;
  size_t bucket = 0;  // the last of the first side
  double cost = std::numeric_limits<double>::infinity();
};

struct Interval {
  double low, high;
  // The bucket of a centre; all of one place are in the first.
  size_t Bucket(double centre) const {
    if (!(high > low)) return 0;
    const double at = (centre - low) / (high - low) * kBuckets;
    return std::min(static_cast<size_t>(std::max(at, 0.0)), kBuckets - 1);
  }
};

Interval Centres(std::span<const BoundedLight> lights, size_t axis) {
  Interval interval{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const BoundedLight& light : lights) {
    interval.low = std::min(interval.low, Centre(light.bounds, axis));
    interval.high = std::max(interval.high, Centre(light.bounds, axis));
  }
  return interval;
}

// The best split along one axis; `scale` keeps from slicing thin boxes along their short sides.
Split BestAlong(std::span<const BoundedLight> lights, size_t axis, const Interval& centres,
                double scale, double least_area) {
  std::array<LightBounds, kBuckets> buckets;
  std::array<size_t, kBuckets> counts{};
  for (const BoundedLight& light : lights) {
    const size_t bucket = centres.Bucket(Centre(light.bounds, axis));
    buckets[bucket] = Union(buckets[bucket], light.bounds);
    ++counts[bucket];
  }
  std::array<double, kBuckets> below{};
  LightBounds sum;
  size_t count = 0;
  for (size_t i = 0; i + 1 < kBuckets; ++i) {
    if (counts[i] != 0) sum = Union(sum, buckets[i]);
    count += counts[i];
    below[i] = count == 0 ? std::numeric_limits<double>::infinity() : Cost(sum, least_area);
  }
  Split best{axis};
  sum = LightBounds{};
  for (size_t i = kBuckets - 1; i > 0; --i) {
    if (counts[i] != 0) sum = Union(sum, buckets[i]);
    if (sum.box.empty()) continue;
    const double cost = scale * (below[i - 1] + Cost(sum, least_area));
    if (cost < best.cost) best = {axis, i - 1, cost};
  }
  return best;
}

// A binary tree's node; a leaf has one light.
struct Side {
  LightBounds bounds;
  uint32_t light = 0;
  uint32_t height = 0;  // levels below; 0: a leaf
  std::unique_ptr<Side> sides[2];
};

class Divider {
 public:
  static std::unique_ptr<Side> Divide(std::span<BoundedLight> lights, uint32_t depth) {
    auto node = std::make_unique<Side>();
    for (const BoundedLight& light : lights) node->bounds = Union(node->bounds, light.bounds);
    if (lights.size() == 1) {
      node->light = lights[0].light;
      return node;
    }
    const size_t middle = Divide(lights, node->bounds, depth);
    node->sides[0] = Divide(lights.first(middle), depth + 1);
    node->sides[1] = Divide(lights.subspan(middle), depth + 1);
    node->height = 1 + std::max(node->sides[0]->height, node->sides[1]->height);
    return node;
  }

 private:
  // Orders the lights so that the first `result` are one side. Where no split is found, or the tree
  // could become too deep, both sides are equally many.
  static size_t Divide(std::span<BoundedLight> lights, const LightBounds& bounds, uint32_t depth) {
    const auto levels = static_cast<uint32_t>(std::bit_width(lights.size() - 1));
    double longest = 0;
    for (size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, Extent(bounds, axis));
    Split best;
    if (depth + levels + 1 < kMaxLightTreeDepth) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const Interval centres = Centres(lights, axis);
        if (!(centres.high > centres.low)) continue;
        const double scale = longest / std::max(Extent(bounds, axis), 1e-6 * longest);
        const Split split = BestAlong(lights, axis, centres, scale, 1e-6 * longest * longest);
        if (split.cost < best.cost) best = split;
      }
    }
    if (!std::isfinite(best.cost)) return lights.size() / 2;
    const Interval centres = Centres(lights, best.axis);
    const auto second = std::partition(lights.begin(), lights.end(), [&](const BoundedLight& l) {
      return centres.Bucket(Centre(l.bounds, best.axis)) <= best.bucket;
    });
    return static_cast<size_t>(second - lights.begin());
  }
};

LightNode MakeNode(const LightBounds& b, uint32_t child) {
  LightNode node{};
  double radius2 = 0;
  for (size_t i = 0; i < 3; ++i) {
    node.centre[i] = static_cast<float>(Centre(b, i));
    node.axis[i] = static_cast<float>(b.axis[i]);
    // The rounded centre moves; coordinates far from 0 round coarsely.
    const double half = std::max(b.box.high[i] - static_cast<double>(node.centre[i]),
                                 static_cast<double>(node.centre[i]) - b.box.low[i]);
    radius2 += half * half;
  }
  constexpr double kGrow = 1 + 1e-6, kSlack = 2e-3;  // cosines of small angles round coarsely
  node.radius = static_cast<float>(std::sqrt(radius2) * kGrow);
  node.cos_o = static_cast<float>(std::cos(b.theta_o));
  node.sin_o = static_cast<float>(std::sin(b.theta_o));
  node.cos_e = static_cast<float>(std::cos(b.theta_e) - kSlack);
  node.intensity = static_cast<float>(b.intensity);
  node.child = child | (b.two_sided ? kLightNodeTwoSided : 0u) |
               (b.theta_e < std::numbers::pi / 2 - 1e-6 ? kLightNodeNarrow : 0u);
  return node;
}

// Writes what is below a side of the binary tree as rows of siblings.
class Widener {
 public:
  Widener(LightTree& tree, std::span<uint32_t> trails) : tree_(tree), trails_(trails) {}

  // Returns what LightNode::child says of these lights.
  uint32_t Widen(const Side& side, uint32_t trail, uint32_t shift) {
    if (side.height == 0) {
      trails_[side.light] = trail;
      return side.light | kLightLeaf;
    }
    const std::vector<const Side*> row = Siblings(side);
    const auto first = static_cast<uint32_t>(tree_.nodes.size());
    LightNode nothing{};
    nothing.child = kNoLightNode;
    tree_.nodes.resize(first + kLightSiblings, nothing);
    for (uint32_t k = 0; k < row.size(); ++k) {
      const uint32_t child = Widen(*row[k], trail | k << shift, shift + kLightTrailBits);
      tree_.nodes[first + k] = MakeNode(row[k]->bounds, child);
    }
    return first;
  }

 private:
  // The highest is divided first: of the three levels below a side, none is left. To divide the
  // brightest first is noisier, and so is not to divide sides whose lights would fill one row.
  static std::vector<const Side*> Siblings(const Side& side) {
    std::vector<const Side*> row = {&side};
    while (row.size() < kLightSiblings) {
      const auto highest =
          std::max_element(row.begin(), row.end(),
                           [](const Side* a, const Side* b) { return a->height < b->height; });
      const Side& divided = **highest;
      if (divided.height == 0) break;
      *highest = divided.sides[0].get();
      row.push_back(divided.sides[1].get());
    }
    return row;
  }

  LightTree& tree_;
  std::span<uint32_t> trails_;
};

}  // namespace

LightTree BuildLightTree(std::span<BoundedLight> lights, std::span<uint32_t> trails) {
  LightTree tree;
  if (lights.empty()) return tree;
  tree.nodes.reserve(2 * lights.size());
  tree.root = Widener(tree, trails).Widen(*Divider::Divide(lights, 0), 0, 0);
  return tree;
}

}  // namespace swell
