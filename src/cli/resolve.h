// What the command line and the scene file together decide.
#ifndef SWELL_CLI_RESOLVE_H_
#define SWELL_CLI_RESOLVE_H_

#include <array>
#include <span>
#include <string>
#include <vector>

#include "kernels/material.h"
#include "src/base/result.h"
#include "src/cli/options.h"
#include "src/film/film.h"
#include "src/scene/scene.h"

namespace swell {

// Pixels of a crop window (x0 x1 y0 y1, fractions): from the first whole pixel at or after each
// edge, as in pbrt, so that windows that share an edge neither overlap nor leave a gap. An error if
// it holds no pixel.
Result<PixelBounds> CropPixels(uint32_t width, uint32_t height, const std::array<float, 4>& window);

// The scene's request with the command line's choices in it.
RenderRequest Override(const RenderRequest& request, const RenderCommand& command);

// Where the image goes if the command line names no file: the film's filename if it is an .exr or
// .png, else the scene file's name with .exr in the current folder.
std::string DefaultOutfile(const std::string& film_filename, const std::string& scene_file);

// What reports call a material: its name, or its kind and index ("diffuse#3") if it has none or
// shares it.
std::vector<std::string> MaterialLabels(const std::vector<Material>& materials,
                                        std::span<const MaterialInfo* const> kinds);

}  // namespace swell

#endif  // SWELL_CLI_RESOLVE_H_
