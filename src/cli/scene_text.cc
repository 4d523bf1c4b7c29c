// Facts of a scene as tables.
#include "src/cli/scene_text.h"

#include <cmath>
#include <cstdio>

#include "src/cli/resolve.h"
#include "src/stats/report.h"
#include "src/stats/text_table.h"

namespace swell {
namespace {

constexpr const char* kFilterNames[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value + 0.0);  // never "-0"
  return text;
}

std::string Seconds(double value) { return Format("%.3f s", value); }

std::string Line(const std::string& name, const std::string& value) {
  std::string text = "  " + name;
  text.append(text.size() < 20 ? 20 - text.size() : 1, ' ');
  return text + value + "\n";
}

std::string BoundsText(const Bounds& bounds) {
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

std::string GeometryText(const SceneFacts& facts) {
  // How many there are, and how many the picture shows of them.
  const auto count = [&](uint64_t unique, uint64_t shown) {
    return FormatCount(unique) +
           (facts.instances > 0 ? " unique, " + FormatCount(shown) + " with instances" : "");
  };
  std::string instances;
  if (facts.objects > 0) {
    instances = Line("objects", FormatCount(facts.objects)) +
                Line("instances", FormatCount(facts.instances));
  }
  return Line("meshes", FormatCount(facts.meshes)) + instances +
         Line("triangles", count(facts.unique.triangles, facts.drawn.triangles)) +
         (facts.left_out > 0
              ? Line("left out", FormatCount(facts.left_out) + " triangles without area")
              : "") +
         Line("spheres", count(facts.unique.spheres, facts.drawn.spheres)) +
         Line("vertices", FormatCount(facts.vertices)) +
         Line("normals", FormatCount(facts.normals)) + Line("uvs", FormatCount(facts.uvs)) +
         Line("bounds", BoundsText(facts.bounds));
}

std::string MaterialsAndLights(const SceneFacts& facts) {
  std::string text = Line("materials", CountsText(facts.materials));
  text += Line("lights", CountsText(facts.lights) +
                             (facts.lights.empty() ? "; the picture will be black" : ""));
  for (const auto& [label, kind] : facts.material_labels) text += Line("", label + ": " + kind);
  return text;
}

std::string TexturesText(const SceneFacts& facts) {
  if (facts.textures.empty()) return "  none\n";
  TextTable table(2);
  for (const TextureFacts& t : facts.textures) {
    table.Add({t.name.empty() ? "(made here)" : t.name, t.use,
               std::to_string(t.width) + "x" + std::to_string(t.height),
               std::to_string(t.channels) + " x " + t.format, FormatBytes(t.bytes)});
  }
  return table.Text();
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

std::string WarningsText(const SceneFacts& facts) {
  if (facts.warnings.empty()) return "  none\n";
  std::string text;
  for (const WarningFacts& warning : facts.warnings) {
    text += "  " + warning.text;
    if (warning.count > 1) {
      text += " (and " + FormatCount(warning.count - 1) + " more like it)";
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string SceneText(const SceneFacts& facts) {
  std::string text = "Scene\n" + GeometryText(facts) + MaterialsAndLights(facts);
  text += "Textures\n" + TexturesText(facts);
  text += "Picture\n" + CameraText(facts.camera) + FilmText(facts.request);
  text += "Tree\n" + Line("nodes", FormatCount(facts.tree.nodes)) +
          Line("triangle blocks", FormatCount(facts.tree.blocks)) +
          Line("depth", FormatCount(facts.tree.depth));
  text += "Memory\n";
  for (const auto& [part, bytes] : facts.memory) text += Line(part, FormatBytes(bytes));
  text += Line("together", FormatBytes(facts.memory_bytes));
  for (const auto& [phase, bytes] : facts.peak_rss_bytes) {
    if (bytes) text += Line("peak at " + phase, FormatBytes(*bytes));
  }
  text += "Time\n";
  for (const auto& [phase, seconds] : facts.seconds) text += Line(phase, Seconds(seconds));
  return text + "Warnings\n" + WarningsText(facts);
}

}  // namespace swell
