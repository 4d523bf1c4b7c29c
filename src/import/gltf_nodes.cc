// The node hierarchy of a glTF file -> what it places in the world.
#include "src/import/gltf_nodes.h"

#include <cmath>

#include "src/import/diagnostics.h"
#include "src/import/gltf_limits.h"

namespace swell {
namespace {

using Nodes = std::vector<tinygltf::Node>;
constexpr int kRoot = -1;

std::string NameOf(const Nodes& nodes, int node) {
  const std::string& name = nodes[static_cast<size_t>(node)].name;
  return "node " + std::to_string(node) + (name.empty() ? "" : " " + Quote(name));
}

bool IsNode(const Nodes& nodes, int node) {
  return node >= 0 && static_cast<size_t>(node) < nodes.size();
}

Result<std::vector<int>> FindParents(const Nodes& nodes) {
  std::vector<int> parents(nodes.size(), kRoot);
  for (size_t i = 0; i < nodes.size(); ++i) {
    for (int child : nodes[i].children) {
      const std::string name = NameOf(nodes, static_cast<int>(i));
      if (!IsNode(nodes, child)) {
        return Error{name + " has the child " + std::to_string(child) + ", which is not there"};
      }
      int& parent = parents[static_cast<size_t>(child)];
      if (parent != kRoot) {
        return Error{NameOf(nodes, child) + " is a child of both " + NameOf(nodes, parent) +
                     " and " + name + "; give it one parent"};
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

// With one parent each, nodes from which no root is reached lie on a cycle or below one.
Status CheckForest(const Nodes& nodes, const std::vector<int>& parents) {
  std::vector<uint32_t> depth(nodes.size(), 0);  // 0: not known
  std::vector<int> way;
  for (size_t i = 0; i < nodes.size(); ++i) {
    way.clear();
    int node = static_cast<int>(i);
    while (node != kRoot && depth[static_cast<size_t>(node)] == 0) {
      way.push_back(node);
      if (way.size() > nodes.size()) {
        return Error{NameOf(nodes, static_cast<int>(i)) +
                     " is below itself; the hierarchy must not be cyclic"};
      }
      node = parents[static_cast<size_t>(node)];
    }
    uint32_t level = node == kRoot ? 0 : depth[static_cast<size_t>(node)];
    for (size_t k = way.size(); k-- > 0;) {
      depth[static_cast<size_t>(way[k])] = ++level;
      if (level <= kMaxGltfNodeDepth) continue;
      return Error{NameOf(nodes, way[k]) + " lies more than " + std::to_string(kMaxGltfNodeDepth) +
                   " nodes deep"};
    }
  }
  return Done{};
}

Transform LocalTransform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {  // by columns
    Transform local;
    for (size_t row = 0; row < 3; ++row) {
      for (size_t col = 0; col < 4; ++col) local.m[4 * row + col] = node.matrix[4 * col + row];
    }
    return local;
  }
  Point translation{0, 0, 0}, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};
  for (size_t i = 0; i < 3; ++i) {
    if (node.translation.size() == 3) translation[i] = node.translation[i];
    if (node.scale.size() == 3) scale[i] = node.scale[i];
  }
  for (size_t i = 0; i < 4 && node.rotation.size() == 4; ++i) rotation[i] = node.rotation[i];
  return FromParts(translation, rotation, scale);
}

Result<std::vector<int>> FindRoots(const tinygltf::Model& model, const std::vector<int>& parents) {
  std::vector<int> roots;
  if (!model.scenes.empty()) {
    const int chosen = model.defaultScene < 0 ? 0 : model.defaultScene;
    if (static_cast<size_t>(chosen) >= model.scenes.size()) {
      return Error{"there is no scene " + std::to_string(chosen)};
    }
    roots = model.scenes[static_cast<size_t>(chosen)].nodes;
  } else {
    for (size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] == kRoot) roots.push_back(static_cast<int>(i));
    }
  }
  std::vector<bool> seen(model.nodes.size());
  for (int root : roots) {
    if (!IsNode(model.nodes, root)) {
      return Error{"the scene names node " + std::to_string(root) + ", which is not there"};
    }
    if (parents[static_cast<size_t>(root)] != kRoot || seen[static_cast<size_t>(root)]) {
      return Error{"the scene names " + NameOf(model.nodes, root) +
                   ", which it has already or which is a child of another node"};
    }
    seen[static_cast<size_t>(root)] = true;
  }
  return roots;
}

}  // namespace

Transform FromParts(const Point& translation, const std::array<double, 4>& rotation,
                    const Point& scale) {
  const double length =
      std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
  const bool usable = std::isfinite(length) && length > 0.0;
  const double x = usable ? rotation[0] / length : 0.0, y = usable ? rotation[1] / length : 0.0;
  const double z = usable ? rotation[2] / length : 0.0, w = usable ? rotation[3] / length : 1.0;
  const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                       2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                       2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
  Transform map;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 3; ++col) map.m[4 * row + col] = r[3 * row + col] * scale[col];
    map.m[4 * row + 3] = translation[row];
  }
  return map;
}

Result<std::vector<GltfPlacedNode>> PlaceNodes(const GltfFile& file) {
  const tinygltf::Model& model = file.model();
  const Result<std::vector<int>> parents = FindParents(model.nodes);
  if (!parents) return parents.error();
  if (Status forest = CheckForest(model.nodes, *parents); !forest) return forest.error();
  const Result<std::vector<int>> roots = FindRoots(model, *parents);
  if (!roots) return roots.error();

  std::vector<GltfPlacedNode> placed, open;
  for (size_t i = roots->size(); i-- > 0;) open.push_back({(*roots)[i], Transform{}});
  while (!open.empty()) {
    GltfPlacedNode next = open.back();
    open.pop_back();
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(next.node)];
    next.to_world = next.to_world * LocalTransform(node);
    placed.push_back(next);
    for (size_t i = node.children.size(); i-- > 0;) {
      open.push_back({node.children[i], next.to_world});
    }
  }
  return placed;
}

}  // namespace swell
