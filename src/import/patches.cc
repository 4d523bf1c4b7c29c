// Bilinear patches -> two triangles each where they are flat, a grid of them where they are not.
#include <algorithm>
#include <cmath>

#include "src/import/append_mesh.h"
#include "src/import/shapes.h"

namespace swell {
namespace {

constexpr uint32_t kPatchSteps = 16;  // per side of a bilinear patch that is not flat

// Patches without uv have pbrt's own, from 0 to 1 over each, so none can share vertices.
std::vector<uint32_t> SplitVertices(Scene& scene, const MeshStart& start,
                                    const std::vector<uint32_t>& patches) {
  const auto corners_of = [&](std::vector<float>& values, size_t first) {
    const std::vector<float> rows(values.begin() + static_cast<ptrdiff_t>(first), values.end());
    values.resize(first);
    for (const uint32_t corner : patches) {
      values.insert(values.end(), &rows[3 * size_t{corner}], &rows[3 * size_t{corner}] + 3);
    }
  };
  corners_of(scene.positions, start.positions);
  if (scene.normals.size() > start.normals) corners_of(scene.normals, start.normals);
  std::vector<uint32_t> split(patches.size());
  for (uint32_t i = 0; i < split.size(); ++i) {
    split[i] = i;
    scene.uvs.insert(scene.uvs.end(), {i % 2 * 1.0f, i / 2 % 2 * 1.0f});
  }
  return split;
}

}  // namespace

void AddBilinearPatches(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                        const MeshStart& start, const std::vector<uint32_t>& corners) {
  const bool has_uvs = scene.uvs.size() > start.uvs;
  const std::vector<uint32_t> patches = has_uvs ? corners : SplitVertices(scene, start, corners);
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const bool normals = scene.normals.size() > start.normals;
  const size_t normal_row = start.normals / 3, uv_row = start.uvs / 2;
  constexpr double kFlat = 1e-6;  // height over diagonal
  for (size_t p = 0; p + 3 < patches.size(); p += 4) {
    const uint32_t* corner = &patches[p];
    std::array<Point, 4> at;
    for (size_t k = 0; k < 4; ++k) at[k] = Row3(scene.positions, first + corner[k]);
    const Point diagonal = Minus(at[3], at[0]), across = Minus(at[2], at[1]);
    const Point normal = Cross(diagonal, across);
    const double height = std::abs(Dot(normal, Minus(at[1], at[0])));
    const double size =
        std::sqrt(Dot(normal, normal) * std::max(Dot(diagonal, diagonal), Dot(across, across)));
    if (height <= kFlat * size) {
      const uint32_t a = first + corner[0], b = first + corner[1], c = first + corner[2],
                     d = first + corner[3];
      scene.indices.insert(scene.indices.end(), {a, b, d, a, d, c});
      continue;
    }
    diagnostics.Warn(placement.place, placement.name + ": a curved patch is divided into " +
                                          std::to_string(2 * kPatchSteps * kPatchSteps) +
                                          " triangles");
    const auto base = static_cast<uint32_t>(scene.positions.size() / 3);
    for (uint32_t j = 0; j <= kPatchSteps; ++j) {
      for (uint32_t i = 0; i <= kPatchSteps; ++i) {
        const double u = static_cast<double>(i) / kPatchSteps;
        const double v = static_cast<double>(j) / kPatchSteps;
        const double weight[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
        const auto blend = [&](std::vector<float>& values, size_t first_row, size_t width) {
          for (size_t c = 0; c < width; ++c) {
            double sum = 0.0;
            for (size_t k = 0; k < 4; ++k) {
              sum += weight[k] * values[(first_row + corner[k]) * width + c];
            }
            values.push_back(static_cast<float>(sum));
          }
        };
        blend(scene.positions, first, 3);
        if (normals) blend(scene.normals, normal_row, 3);
        blend(scene.uvs, uv_row, 2);
        if (i == kPatchSteps || j == kPatchSteps) continue;
        const uint32_t a = base + j * (kPatchSteps + 1) + i, b = a + kPatchSteps + 1;
        scene.indices.insert(scene.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
      }
    }
  }
  AppendMesh(scene, diagnostics, placement, start, static_cast<double>(patches.size() / 4));
}

}  // namespace swell
