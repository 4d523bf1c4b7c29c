// All lights of a scene -> the probabilities with which they are drawn: an alias table, a light
// tree.
#include "src/scene/weigh_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "src/scene/light_tree.h"
#include "src/scene/objects.h"

namespace swell {
namespace {

// Area of an ellipsoid by Thomsen's formula (relative error below 1.1 %), enough to weigh a light.
double EllipsoidArea(const float* m) {
  const auto length = [&](int c) { return std::hypot(m[c], m[c + 4], m[c + 8]); };
  const double a = length(0), b = length(1), c = length(2), p = 1.6075;
  const double mean = (std::pow(a * b, p) + std::pow(a * c, p) + std::pow(b * c, p)) / 3.0;
  return 4.0 * std::numbers::pi * std::pow(mean, 1.0 / p);
}

double SceneRadius(const Scene& scene) {
  const Bounds bounds = WorldBounds(scene);
  if (bounds.empty()) return 1.0;
  double d2 = 0;
  for (size_t i = 0; i < 3; ++i) d2 += std::pow(bounds.high[i] - bounds.low[i], 2);
  return std::max(1e-6, std::sqrt(d2) / 2);
}

// Mean radiance or intensity of each light, the largest channel.
std::vector<double> LightLevels(const Scene& scene, const std::vector<LightRecord>& lights) {
  std::vector<double> image_levels;
  for (const ImageLight& image : scene.image_lights) image_levels.push_back(MeanLevel(image));
  image_levels.push_back(1.0);  // of the white one
  std::vector<double> levels;
  for (const LightRecord& light : lights) {
    const float* radiance = light.radiance;
    const double level =
        std::max({std::abs(radiance[0]), std::abs(radiance[1]), std::abs(radiance[2])});
    const bool pictured = (light.flags & kLightPictured) != 0;
    levels.push_back(pictured ? level * image_levels[light.image] : level);
  }
  return levels;
}

// Emitted power, up to a common factor.
double Power(const Scene& scene, const LightRecord& light, double scene_radius, double level) {
  const double pi = std::numbers::pi;
  const double disk = pi * scene_radius * scene_radius;
  const double sides = (light.flags & kLightTwoSided) != 0 ? 2.0 : 1.0;
  switch (light.type) {
    case kTriangleLight:
      return level * pi * light.area * sides;
    case kSphereLight:
      return level * pi * 4 * pi * light.area * light.area * sides;
    case kEllipsoidLight:
      return level * pi * EllipsoidArea(scene.spheres[light.sphere].object_to_world) * sides;
    case kPointLight:
      return level * 4 * pi;
    case kDistantLight:
      return level * disk;
    case kSpotLight:
      return level * 2 * pi * (1.0 - (light.e1[0] + light.e1[1]) / 2.0);
    case kGoniometricLight:
      return level * 4 * pi;
    case kProjectionLight: {
      const ImageLight& image = scene.image_lights[light.image];
      return level * 4 * image.half_width[0] * image.half_width[1];
    }
    case kImageInfiniteLight:
      return level * 4 * pi * disk;
    default:
      return level * 4 * pi * disk;
  }
}

// Vose 1991, "A linear algorithm for generating random numbers with a given distribution".
void MakeAliasTable(const std::vector<double>& probability, SceneTables& tables) {
  const size_t n = probability.size();
  tables.alias_threshold.assign(n, 1.0f);
  tables.alias.resize(n);
  std::iota(tables.alias.begin(), tables.alias.end(), 0u);
  std::vector<double> scaled(n);
  std::vector<uint32_t> small, large;
  for (size_t i = 0; i < n; ++i) {
    scaled[i] = probability[i] * static_cast<double>(n);
    (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const uint32_t low = small.back(), high = large.back();
    small.pop_back();
    tables.alias_threshold[low] = static_cast<float>(scaled[low]);
    tables.alias[low] = high;
    scaled[high] -= 1.0 - scaled[low];
    if (scaled[high] < 1.0) {
      large.pop_back();
      small.push_back(high);
    }
  }
}

bool IsDistant(const LightRecord& light) {
  return light.type == kDistantLight || light.type == kInfiniteLight ||
         light.type == kImageInfiniteLight;
}

// The alias table, by power or for equal probabilities.
void FillAliasTable(const Scene& scene, const std::vector<double>& levels, SceneTables& tables) {
  const size_t count = tables.lights.size();
  const double radius = SceneRadius(scene);
  std::vector<double> probability(count, 1.0);
  for (size_t i = 0; i < count && tables.light_sampler != LightSampler::kUniform; ++i) {
    probability[i] = Power(scene, tables.lights[i], radius, levels[i]);
  }
  const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
  for (size_t i = 0; i < count; ++i) {
    // Lights without power are never picked; if none has any, all are alike.
    probability[i] = total > 0.0 ? probability[i] / total : 1.0 / static_cast<double>(count);
    tables.lights[i].select_pdf = static_cast<float>(probability[i]);
  }
  MakeAliasTable(probability, tables);
}

void ListLights(SceneTables& tables) {
  LightsView& view = tables.view.lights;
  for (uint32_t i = 0; i < tables.lights.size(); ++i) {
    const uint32_t type = tables.lights[i].type;
    if (type <= kEllipsoidLight) view.any_area = true;
    if (IsDistant(tables.lights[i])) tables.distant_lights.push_back(i);
    if (type == kInfiniteLight || type == kImageInfiniteLight) tables.infinite_lights.push_back(i);
  }
  view.infinite = tables.infinite_lights.data();
  view.infinite_count = static_cast<uint32_t>(tables.infinite_lights.size());
}

// The lights with a place as a tree; those without stand beside it, each as likely as the tree.
void PlantLightTree(const Scene& scene, const std::vector<double>& levels, SceneTables& tables) {
  std::vector<BoundedLight> bounded;
  for (uint32_t i = 0; i < tables.lights.size(); ++i) {
    if (IsDistant(tables.lights[i])) continue;
    bounded.push_back({BoundsOf(scene, tables.lights[i], levels[i]), i});
  }
  std::vector<uint32_t> trails(tables.lights.size());
  LightTree tree = BuildLightTree(bounded, trails);
  for (size_t i = 0; i < trails.size(); ++i) tables.lights[i].trail = trails[i];
  tables.light_nodes = std::move(tree.nodes);
  if (tables.light_nodes.empty()) tables.light_nodes.resize(kLightSiblings);  // lanes at rest read

  LightTreeView& view = tables.view.lights.tree;
  view.nodes = tables.light_nodes.data();
  view.root = tree.root;
  view.any = !bounded.empty();
  view.distant = tables.distant_lights.data();
  view.distant_count = static_cast<uint32_t>(tables.distant_lights.size());
  view.distant_pdf = 1.0f / static_cast<float>(view.distant_count + (view.any ? 1u : 0u));
}

}  // namespace

void WeighLights(const Scene& scene, LightSampler sampler, SceneTables& tables) {
  ListLights(tables);
  tables.light_sampler = sampler;
  if (sampler == LightSampler::kAuto) {
    const bool few = tables.lights.size() <= kFewLights && tables.distant_lights.empty();
    const bool use_power = few || tables.lights.size() == 1;
    tables.light_sampler = use_power ? LightSampler::kPower : LightSampler::kBvh;
  }
  const std::vector<double> levels = LightLevels(scene, tables.lights);
  FillAliasTable(scene, levels, tables);
  if (tables.light_sampler == LightSampler::kBvh) PlantLightTree(scene, levels, tables);
}

}  // namespace swell
