// Facts of a scene as JSON.
#include <nlohmann/json.hpp>

#include "src/cli/scene_text.h"

namespace swell {
namespace {

using Json = nlohmann::ordered_json;

template <class Pairs> Json FromPairs(const Pairs& pairs) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) json[name] = value;
  return json;
}

Json FromPeaks(const std::vector<std::pair<std::string, std::optional<uint64_t>>>& peaks) {
  Json json = Json::object();
  for (const auto& [phase, bytes] : peaks) json[phase] = bytes ? Json(*bytes) : Json();
  return json;
}

Json FromBounds(const Bounds& bounds) {
  if (bounds.empty()) return nullptr;
  return {{"low", bounds.low}, {"high", bounds.high}};
}

Json FromTextures(const std::vector<TextureFacts>& textures) {
  Json json = Json::array();
  for (const TextureFacts& t : textures) {
    json.push_back({{"file", t.name.empty() ? Json() : Json(t.name)},
                    {"use", t.use},
                    {"width", t.width},
                    {"height", t.height},
                    {"channels", t.channels},
                    {"format", t.format},
                    {"bytes", t.bytes}});
  }
  return json;
}

Json FromCamera(const Camera& camera) {
  const Affine& m = camera.camera_to_world;
  const bool perspective = camera.type == CameraType::kPerspective;
  return {{"type", perspective ? "perspective" : "orthographic"},
          {"fov_degrees", perspective ? Json(camera.fov_degrees) : Json()},
          {"position", {m[3], m[7], m[11]}},
          {"direction", {m[2], m[6], m[10]}},
          {"up", {m[1], m[5], m[9]}},
          {"lens_radius", camera.lens_radius},
          {"focal_distance", camera.focal_distance}};
}

Json FromFilm(const RenderRequest& request) {
  return {{"width", request.width},
          {"height", request.height},
          {"cropwindow", request.crop_window},
          {"spp", request.samples_per_pixel},
          {"seed", request.seed},
          {"maxdepth", request.max_depth},
          {"file", request.filename.empty() ? Json() : Json(request.filename)}};
}

}  // namespace

std::string SceneJson(const SceneFacts& facts) {
  Json names = Json::array(), warnings = Json::array();
  for (const auto& [label, kind] : facts.material_labels) {
    names.push_back({{"name", label}, {"kind", kind}});
  }
  for (const WarningFacts& warning : facts.warnings) {
    warnings.push_back({{"text", warning.text}, {"count", warning.count}});
  }
  const Json json = {
      {"schema", 1},
      {"meshes", facts.meshes},
      {"objects", facts.objects},
      {"instances", facts.instances},
      {"triangles",
       {{"unique", facts.unique.triangles},
        {"instanced", facts.drawn.triangles},
        {"left_out", facts.left_out}}},
      {"spheres", {{"unique", facts.unique.spheres}, {"instanced", facts.drawn.spheres}}},
      {"vertices", facts.vertices},
      {"normals", facts.normals},
      {"uvs", facts.uvs},
      {"bounds", FromBounds(facts.bounds)},
      {"materials", {{"by_kind", FromPairs(facts.materials)}, {"list", names}}},
      {"lights", {{"by_type", FromPairs(facts.lights)}}},
      {"textures", FromTextures(facts.textures)},
      {"camera", FromCamera(facts.camera)},
      {"film", FromFilm(facts.request)},
      {"tree",
       {{"nodes", facts.tree.nodes},
        {"triangle_blocks", facts.tree.blocks},
        {"depth", facts.tree.depth}}},
      {"memory_bytes", FromPairs(facts.memory)},
      {"memory_bytes_together", facts.memory_bytes},
      {"peak_rss_bytes", FromPeaks(facts.peak_rss_bytes)},
      {"seconds", FromPairs(facts.seconds)},
      {"warnings", warnings}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace swell
