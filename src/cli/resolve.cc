// Defaults and overrides of a render.
#include "src/cli/resolve.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace swell {
namespace {

bool IsImageName(const std::string& name) {
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return false;
  const std::string ending = name.substr(dot);
  return ending == ".exr" || ending == ".png";
}

uint32_t FirstPixel(uint32_t size, float edge) {
  // 0.3 as a float lies a little above 0.3: less than its rounding is no further pixel.
  constexpr double kRounding = 1e-7;
  return static_cast<uint32_t>(std::ceil(size * std::max(edge - kRounding, 0.0)));
}

}  // namespace

Result<PixelBounds> CropPixels(uint32_t width, uint32_t height,
                               const std::array<float, 4>& window) {
  const PixelBounds bounds{FirstPixel(width, window[0]), FirstPixel(height, window[2]),
                           FirstPixel(width, window[1]), FirstPixel(height, window[3])};
  if (bounds.x0 < bounds.x1 && bounds.y0 < bounds.y1) return bounds;
  return Error{"the crop window holds no pixel of the frame of " + std::to_string(width) + "x" +
               std::to_string(height)};
}

RenderRequest Override(const RenderRequest& request, const RenderCommand& command) {
  RenderRequest chosen = request;
  if (command.resolution) {
    chosen.width = (*command.resolution)[0];
    chosen.height = (*command.resolution)[1];
  }
  if (command.crop_window) chosen.crop_window = *command.crop_window;
  if (command.samples_per_pixel) chosen.samples_per_pixel = *command.samples_per_pixel;
  if (command.seed) chosen.seed = *command.seed;
  if (command.sampler) chosen.sampler = *command.sampler;
  if (command.light_sampler) chosen.light_sampler = *command.light_sampler;
  if (command.max_depth) chosen.max_depth = *command.max_depth;
  chosen.max_depth = std::min(chosen.max_depth, kMaxDepth);  // no path lives that long
  return chosen;
}

std::string DefaultOutfile(const std::string& film_filename, const std::string& scene_file) {
  if (IsImageName(film_filename)) return film_filename;
  std::string name = scene_file.substr(scene_file.rfind('/') + 1);  // npos + 1 is 0
  const size_t dot = name.rfind('.');
  if (dot != std::string::npos && dot > 0) name.resize(dot);
  return name + ".exr";
}

std::vector<std::string> MaterialLabels(const std::vector<Material>& materials,
                                        std::span<const MaterialInfo* const> kinds) {
  std::map<std::string, int> uses;
  for (const Material& material : materials) ++uses[material.name];
  std::vector<std::string> labels;
  for (size_t i = 0; i < materials.size(); ++i) {
    const Material& material = materials[i];
    const bool own_name = !material.name.empty() && uses[material.name] == 1;
    const std::string base = !material.name.empty()         ? material.name
                             : material.kind < kinds.size() ? kinds[material.kind]->name
                                                            : "material";
    labels.push_back(own_name ? base : base + "#" + std::to_string(i));
  }
  return labels;
}

}  // namespace swell
