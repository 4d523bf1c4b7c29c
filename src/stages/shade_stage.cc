// runs of one material -> next, shadow rays.
#include <algorithm>

#include "kernels/evaluate_textures.h"
#include "kernels/lane_count.h"
#include "kernels/material.h"
#include "kernels/sort_hits.h"
#include "src/stages/count_bounces.h"
#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"

namespace swell {
namespace {

constexpr size_t kBytesRead = Table<RayFields>::kRowBytes + Table<HitFields>::kRowBytes +
                              2 * sizeof(uint32_t) + sizeof(uint32_t);

// Paths of a run that scatters no more: they end where they are.
void EndRun(Wave& wave, const Window& window, const Run& run) {
  const RaysIn rays = wave.rays.ReadColumns(window.first);
  const RaysOut next = wave.next.Columns(window.first + run.first);
  const uint32_t* rows = &wave.rows[window.first + run.first];
  for (uint32_t i = 0; i < run.count; ++i) {
    next.path[i] = rays.path[rows[i]];
    next.state[i] = kEndedRay;
  }
}

// The columns of one run's textured parameters, by word.
struct RunTextures {
  float* columns[kMaterialWords] = {};
  Vec3Fields<Out> normals{};
};

// Hands out the wave's columns to what the program writes, and fills them.
void EvaluateRun(const RenderContext& context, Wave& wave, const Window& window, const Run& run,
                 uint32_t program_index, RunTextures& textures) {
  const TexturesView& view = context.scene.textures;
  const TextureProgram& program = view.programs[program_index];
  float* next = wave.texture_cells.data();
  const auto take = [&] {
    float* column = next;
    next += wave.texture_stride;
    return column;
  };
  for (uint32_t k = 0; k < program.output_count; ++k) {
    const TextureOutput& output = view.outputs[program.first_output + k];
    for (uint32_t c = 0; c < output.count; ++c) textures.columns[output.word + c] = take();
  }
  if (program.bump != kNoTexture || program.normal_map != kNoTexture) {
    textures.normals.x = take();
    textures.normals.y = take();
    textures.normals.z = take();
  }
  EvaluateTextures(
      context.width,
      EvaluateTexturesArgs{&context.scene, program_index, context.pixel,
                           &wave.rows[window.first + run.first], run.count,
                           wave.rays.ReadColumns(window.first), wave.hits.ReadColumns(window.first),
                           textures.columns, textures.normals});
}

void ShadeRun(const RenderContext& context, Wave& wave, Window& window, const Run& run) {
  const MaterialsView& materials = context.scene.materials;
  ShadeArgs args{&context.scene,
                 context.settings,
                 materials.params + size_t{run.material} * kMaterialWords,
                 &wave.rows[window.first + run.first],
                 run.count,
                 wave.rays.ReadColumns(window.first),
                 wave.hits.ReadColumns(window.first),
                 wave.paths.ReadColumns(window.first),
                 wave.next.Columns(window.first + run.first),
                 wave.shadow_rays.Columns(window.first),
                 window.shadow_rays};
  RunTextures textures;
  const uint32_t* programs = context.scene.textures.material_program;
  if (programs != nullptr && programs[run.material] != kNoTexture) {
    EvaluateRun(context, wave, window, run, programs[run.material], textures);
    args.columns = textures.columns;
    args.normals = {textures.normals.x, textures.normals.y, textures.normals.z};
  }
  const MaterialInfo& kind = *kMaterialKinds[materials.kind[run.material]];
  window.shadow_rays = static_cast<uint32_t>(kind.shade(context.width, args));
}

}  // namespace

void ShadeStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.recorder != nullptr) context.recorder->Offer(Stage::kShade, wave);
  const uint32_t lanes = LaneCount(context.width);
  for (Window& window : wave.windows) {
    window.shadow_rays = 0;
    // In this order: a run's last vector spills into the rows of the next run, which come after it.
    for (uint32_t r = 0; r < window.runs; ++r) {
      const Run& run = wave.runs[window.run_first + r];
      if (run.material >= kMissRun) {
        EndRun(wave, window, run);
        continue;
      }
      BounceCounts bounces{};
      AddRunBounces(wave, window, run, bounces);
      const uint32_t shadow_before = window.shadow_rays;
      const auto start = context.timed ? std::chrono::steady_clock::now()
                                       : std::chrono::steady_clock::time_point();
      ShadeRun(context, wave, window, run);
      StageRow row{.calls = 1, .rows = run.count, .lanes_active = run.count};
      row.lanes_issued = (run.count + lanes - 1) / lanes * lanes;
      row.bytes_read = run.count * kBytesRead;
      row.bytes_written = run.count * Table<RayFields>::kRowBytes +
                          (window.shadow_rays - shadow_before) * Table<ShadowRayFields>::kRowBytes;
      if (context.timed) {
        const auto elapsed = std::chrono::steady_clock::now() - start;
        row.nanoseconds = static_cast<uint64_t>(
            std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
      }
      stats.RecordShade(run.material, bounces, row);
    }
  }
}

}  // namespace swell
