// Counts and sizes of a scene's arrays.
#include "src/cli/scene_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "src/cli/resolve.h"
#include "src/scene/objects.h"
#include "src/stats/report.h"

namespace swell {
namespace {

constexpr const char* kLightNames[] = {"triangle",   "sphere",     "ellipsoid", "point",
                                       "distant",    "infinite",   "spot",      "goniometric",
                                       "projection", "environment"};
constexpr const char* kFilterNames[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value + 0.0);  // never "-0"
  return text;
}

std::string Seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f s", value);
  return text;
}

std::string Line(const char* name, const std::string& value) {
  std::string text = std::string("  ") + name;
  text.append(text.size() < 20 ? 20 - text.size() : 1, ' ');
  return text + value + "\n";
}

template <class T> uint64_t Bytes(const std::vector<T>& column) {
  return column.size() * sizeof(T);
}

std::string BoundsText(const Scene& scene) {
  const Bounds bounds = WorldBounds(scene);
  if (bounds.empty()) return "empty";
  std::string text;
  for (size_t axis = 0; axis < 3; ++axis) {
    text += std::string(axis == 0 ? "" : ", ") + "xyz"[axis] + " " + Number(bounds.low[axis]) +
            " to " + Number(bounds.high[axis]);
  }
  return text;
}

// "5 (3 diffuse, 2 mirror)"
std::string CountsText(const std::map<std::string, uint64_t>& counts) {
  uint64_t sum = 0;
  std::string parts;
  for (const auto& [name, count] : counts) {
    sum += count;
    parts += (parts.empty() ? "" : ", ") + FormatCount(count) + " " + name;
  }
  return FormatCount(sum) + (parts.empty() ? "" : " (" + parts + ")");
}

std::string GeometryText(const Scene& scene) {
  const auto meshes = std::count_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& s) {
    return (s.record.flags & kShapeIsSphere) == 0;
  });
  const PrimCounts drawn = CountDrawn(scene);
  const bool instanced = !scene.instances.empty();
  // How many there are, and how many the picture shows of them.
  const auto count = [&](uint64_t unique, uint64_t shown) {
    return FormatCount(unique) +
           (instanced ? " unique, " + FormatCount(shown) + " with instances" : "");
  };
  std::string instances;
  if (!scene.objects.empty()) {
    instances = Line("objects", FormatCount(scene.objects.size())) +
                Line("instances", FormatCount(scene.instances.size()));
  }
  return Line("meshes", FormatCount(static_cast<uint64_t>(meshes))) + instances +
         Line("triangles", count(scene.triangle_count(), drawn.triangles)) +
         Line("spheres", count(scene.spheres.size(), drawn.spheres)) +
         Line("vertices", FormatCount(scene.positions.size() / 3)) +
         Line("normals", FormatCount(scene.normals.size() / 3)) +
         Line("uvs", FormatCount(scene.uvs.size() / 2)) + Line("bounds", BoundsText(scene));
}

std::string MaterialsAndLights(const Scene& scene, const SceneTables& tables,
                               std::span<const MaterialInfo* const> kinds) {
  std::map<std::string, uint64_t> materials, lights;
  for (const Material& m : scene.materials) {
    ++materials[m.kind < kinds.size() ? kinds[m.kind]->name : "unknown"];
  }
  if (!scene.mixes.empty()) materials["mix"] = scene.mixes.size();
  for (const LightRecord& light : tables.lights) {
    ++lights[light.type < std::size(kLightNames) ? kLightNames[light.type] : "unknown"];
  }
  std::string text =
      Line("materials", CountsText(materials)) +
      Line("lights", CountsText(lights) + (lights.empty() ? "; the picture will be black" : ""));
  const std::vector<std::string> labels = MaterialLabels(scene.materials, kinds);
  for (size_t i = 0; i < labels.size(); ++i) {
    const uint32_t kind = scene.materials[i].kind;
    text += Line("", labels[i] + ": " + (kind < kinds.size() ? kinds[kind]->name : "unknown"));
  }
  return text;
}

std::string CameraText(const Camera& camera) {
  const Affine& m = camera.camera_to_world;
  const bool perspective = camera.type == CameraType::kPerspective;
  std::string text = perspective ? "perspective, fov " + Number(camera.fov_degrees) + " degrees"
                                 : std::string("orthographic");
  text += ", at " + Number(m[3]) + " " + Number(m[7]) + " " + Number(m[11]);
  text += ", looking along " + Number(m[2]) + " " + Number(m[6]) + " " + Number(m[10]);
  if (camera.lens_radius > 0) {
    text += ", lens radius " + Number(camera.lens_radius) + " focused at " +
            Number(camera.focal_distance);
  }
  return Line("camera", text);
}

std::string FilmText(const RenderRequest& r) {
  const Result<PixelBounds> crop = CropPixels(r.width, r.height, r.crop_window);
  std::string text = std::to_string(r.width) + "x" + std::to_string(r.height);
  if (!crop) {
    text += ", crop window without pixels";
  } else if (crop->width() != r.width || crop->height() != r.height) {
    text += ", pixels " + std::to_string(crop->x0) + " to " + std::to_string(crop->x1) + " by " +
            std::to_string(crop->y0) + " to " + std::to_string(crop->y1);
  }
  text += ", " + std::string(kFilterNames[static_cast<uint32_t>(r.filter.type)]) + " filter of " +
          Number(r.filter.radius_x) + "x" + Number(r.filter.radius_y) + " pixels";
  if (!r.filename.empty()) text += ", file '" + r.filename + "'";
  return Line("film", text) +
         Line("sampling", std::to_string(r.samples_per_pixel) + " samples per pixel of '" +
                              kSamplers[static_cast<size_t>(r.sampler)].name + "', seed " +
                              std::to_string(r.seed) + ", depth " + std::to_string(r.max_depth));
}

std::string MemoryText(const Scene& scene, const SceneTables& tables, const TreeSummary& tree) {
  const RenderRequest& r = scene.request;
  const Result<PixelBounds> crop = CropPixels(r.width, r.height, r.crop_window);
  const uint64_t pixels = crop ? uint64_t{crop->width()} * crop->height() : 0;
  const std::pair<const char*, uint64_t> parts[] = {
      {"vertices", Bytes(scene.positions)},
      {"normals, uvs", Bytes(scene.normals) + Bytes(scene.uvs)},
      {"triangles", Bytes(scene.indices) + Bytes(scene.prim_shape)},
      {"shapes, spheres", Bytes(scene.shapes) + Bytes(scene.spheres) + Bytes(tables.shapes)},
      {"instances", Bytes(scene.instances) + Bytes(scene.objects)},
      {"materials", Bytes(scene.materials) + Bytes(tables.params) + Bytes(tables.kinds)},
      {"lights", Bytes(scene.lights) + Bytes(tables.lights) + Bytes(tables.alias_threshold) +
                     Bytes(tables.alias)},
      {"tree", tree.bytes},
      {"film", pixels * sizeof(FilmPixel)},
  };
  std::string text;
  uint64_t sum = 0;
  for (const auto& [name, bytes] : parts) {
    sum += bytes;
    text += Line(name, FormatBytes(bytes));
  }
  return text + Line("together", FormatBytes(sum));
}

}  // namespace

std::string SceneText(const Scene& scene, const SceneTables& tables,
                      std::span<const MaterialInfo* const> kinds, const TreeSummary& tree,
                      double import_seconds) {
  std::string text = "Scene\n" + GeometryText(scene);
  text += MaterialsAndLights(scene, tables, kinds);
  text += "Picture\n" + CameraText(scene.camera) + FilmText(scene.request);
  text += "Tree\n" + Line("nodes", FormatCount(tree.nodes)) +
          Line("triangle blocks", FormatCount(tree.blocks)) +
          Line("depth", FormatCount(tree.depth));
  text += "Memory\n" + MemoryText(scene, tables, tree);
  text += "Time\n" + Line("import", Seconds(import_seconds)) + Line("build", Seconds(tree.seconds));
  text += "Warnings\n";
  if (scene.warnings.empty()) text += "  none\n";
  for (const std::string& warning : scene.warnings) text += "  " + warning + "\n";
  return text;
}

}  // namespace swell
