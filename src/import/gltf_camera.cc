// Cameras of a glTF file -> the scene's.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/suggest.h"
#include "src/import/gltf_view.h"

namespace swell {
namespace {

constexpr uint32_t kShortSide = 768, kMostLongSide = 4 * kShortSide;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Candidate {
  int camera;
  const GltfPlacedNode* node;
  std::string name, node_name;
};

std::vector<Candidate> FindCameras(const tinygltf::Model& model,
                                   const std::vector<GltfPlacedNode>& nodes) {
  std::vector<Candidate> found;
  for (const GltfPlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(placed.node)];
    if (node.camera < 0 || static_cast<size_t>(node.camera) >= model.cameras.size()) continue;
    found.push_back(
        {node.camera, &placed, model.cameras[static_cast<size_t>(node.camera)].name, node.name});
  }
  return found;
}

const Candidate* Choose(const std::vector<Candidate>& found, const std::string& wanted) {
  if (wanted.empty()) return found.empty() ? nullptr : &found[0];
  const auto find = [&](const auto& matches) -> const Candidate* {
    const auto at = std::find_if(found.begin(), found.end(), matches);
    return at == found.end() ? nullptr : &*at;
  };
  const Candidate* named =
      find([&](const Candidate& c) { return c.name == wanted || c.node_name == wanted; });
  if (named != nullptr) return named;
  return find([&](const Candidate& c) { return std::to_string(c.camera) == wanted; });
}

// Pixels of the longer side, for a frame `aspect` times as wide as high.
uint32_t LongSide(double aspect) {
  return static_cast<uint32_t>(
      std::lround(std::min(kShortSide * std::max(aspect, 1.0 / aspect), double{kMostLongSide})));
}

void SetLens(const tinygltf::Camera& source, Scene* scene) {
  Camera& camera = scene->camera;
  double aspect = 4.0 / 3.0;
  if (source.type == "orthographic") {
    const double x = source.orthographic.xmag, y = source.orthographic.ymag;
    if (x != 0.0 && y != 0.0 && std::isfinite(x / y)) aspect = std::abs(x / y);
    camera.type = CameraType::kOrthographic;
    const auto half_x = static_cast<float>(std::abs(x)), half_y = static_cast<float>(std::abs(y));
    camera.screen_window = {-half_x, half_x, -half_y, half_y};
  } else {
    if (source.perspective.aspectRatio > 0.0) aspect = source.perspective.aspectRatio;
    const double half = std::clamp(source.perspective.yfov / 2, 1e-4, 1.56);
    const double shorter = std::min(aspect, 1.0) * std::tan(half);  // "yfov" spans the height
    camera.fov_degrees = static_cast<float>(2.0 * std::atan(shorter) * kDegrees);
  }
  aspect = std::clamp(aspect, 1e-3, 1e3);
  scene->request.width = aspect < 1.0 ? kShortSide : LongSide(aspect);
  scene->request.height = aspect < 1.0 ? LongSide(aspect) : kShortSide;
}

}  // namespace

bool SetGltfCamera(const GltfFile& file, const std::vector<GltfPlacedNode>& nodes,
                   const std::string& wanted, Diagnostics* diagnostics, Place place, Scene* scene) {
  const std::vector<Candidate> found = FindCameras(file.model(), nodes);
  const Candidate* chosen = Choose(found, wanted);
  if (chosen == nullptr) {
    if (wanted.empty()) return false;
    std::vector<std::string_view> names;
    for (const Candidate& c : found) names.push_back(c.name.empty() ? c.node_name : c.name);
    diagnostics->Fail(
        place, "there is no camera " + Quote(wanted) + DidYouMean(wanted, names) +
                   (names.empty() ? "; the file has no cameras"
                                  : " (known: " + ListOf(names) + ", or 0 to " +
                                        std::to_string(file.model().cameras.size() - 1) + ")"));
    return false;
  }
  scene->camera = Camera{};
  SetLens(file.model().cameras[static_cast<size_t>(chosen->camera)], scene);
  // glTF's cameras look along -z; their nodes' scales do not count.
  const Transform& node = chosen->node->to_world;
  const double signs[3] = {1.0, 1.0, -1.0};
  Transform to_world;
  for (size_t axis = 0; axis < 3; ++axis) {
    Point along{0, 0, 0};
    along[axis] = signs[axis];
    const auto unit = Normalized(MapVector(node, along));
    if (!unit) {
      diagnostics->Fail(place, "the camera's node is scaled to nothing");
      return false;
    }
    for (size_t row = 0; row < 3; ++row) to_world.m[4 * row + axis] = (*unit)[row];
  }
  for (size_t row = 0; row < 3; ++row) to_world.m[4 * row + 3] = node.m[4 * row + 3];
  scene->camera.camera_to_world = ToAffine(to_world);
  for (float value : scene->camera.camera_to_world) {
    if (std::isfinite(value)) continue;
    diagnostics->Fail(place, "the camera is not finitely near");
    return false;
  }
  return true;
}

}  // namespace swell
