// Lights of a glTF file -> those of the scene.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/import/gltf_values.h"
#include "src/import/gltf_view.h"

namespace swell {
namespace {

constexpr double kMostIntensity = 1e30;

LightRecord MakeLight(const tinygltf::Light& source) {
  LightRecord light{};
  light.prim = kNone;
  light.sphere = kNone;
  light.image = kNone;
  const double intensity = std::clamp(source.intensity, 0.0, kMostIntensity);
  for (size_t c = 0; c < 3; ++c) {
    const double color = source.color.size() == 3 ? std::clamp(source.color[c], 0.0, 1.0) : 1.0;
    light.radiance[c] = static_cast<float>(color * intensity);
  }
  return light;
}

void SetCone(const tinygltf::Light& source, LightRecord* light) {
  const double outer = std::clamp(source.spot.outerConeAngle, 1e-4, std::numbers::pi / 2);
  const double inner = std::clamp(source.spot.innerConeAngle, 0.0, outer);
  light->e1[0] = static_cast<float>(std::cos(inner));
  light->e1[1] = static_cast<float>(std::cos(outer));
}

}  // namespace

void AddGltfLights(const GltfFile& file, const std::vector<GltfPlacedNode>& nodes,
                   Diagnostics* diagnostics, Place place, Scene* scene) {
  const tinygltf::Model& model = file.model();
  for (const GltfPlacedNode& placed : nodes) {
    const auto& extensions = model.nodes[static_cast<size_t>(placed.node)].extensions;
    const tinygltf::Value* named = FindExtension(extensions, "KHR_lights_punctual");
    if (named == nullptr) continue;
    const int index = IndexOf(named, "light");
    if (index < 0 || static_cast<size_t>(index) >= model.lights.size()) {
      return diagnostics->Fail(
          place, "node " + std::to_string(placed.node) + " has a light that is not there");
    }
    const tinygltf::Light& source = model.lights[static_cast<size_t>(index)];
    LightRecord light = MakeLight(source);
    const Point at = MapPoint(placed.to_world, {0, 0, 0});
    const auto axis = Normalized(MapVector(placed.to_world, {0, 0, -1}));
    if (!axis) {
      diagnostics->Warn(place, "a light's node is scaled to nothing; the light is left out");
      continue;
    }
    const double towards = source.type == "directional" ? -1.0 : 0.0;
    for (size_t c = 0; c < 3; ++c) {
      light.p[c] = static_cast<float>(towards != 0.0 ? towards * (*axis)[c] : at[c]);
      light.n[c] = static_cast<float>((*axis)[c]);
    }
    if (source.type == "directional") {
      light.type = kDistantLight;
    } else if (source.type == "spot") {
      light.type = kSpotLight;
      SetCone(source, &light);
    } else if (source.type == "point") {
      light.type = kPointLight;
    } else {
      return diagnostics->Fail(
          place, "unknown light " + Quote(source.type) + " (known: directional, point, spot)");
    }
    const bool finite = std::all_of(std::begin(light.p), std::end(light.p),
                                    [](float value) { return std::isfinite(value); });
    if (!finite) return diagnostics->Fail(place, "a light is not finitely near");
    scene->lights.push_back(light);
  }
}

}  // namespace swell
