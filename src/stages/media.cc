// Sizes what the kernels of media need, and brings the media of rays from row to row.
#include "src/stages/media.h"

#include <algorithm>

#include "kernels/absorb_light.h"
#include "kernels/enter_media.h"

namespace swell {
namespace {

// kKeptMedium for those that pass no border.
const uint32_t* MediaBehind(const RenderContext& context, Wave& wave, const Window& window,
                            const PassingRays& passing) {
  uint32_t* entered = &wave.entered[window.first];
  EnterMedia(context.width, EnterMediaArgs{&context.scene,
                                           context.media->borders,
                                           passing.org,
                                           passing.dir,
                                           passing.hits,
                                           passing.through,
                                           nullptr,
                                           {},
                                           nullptr,
                                           passing.count,
                                           entered});
  return entered;
}

}  // namespace

void AbsorbToHits(const RenderContext& context, Wave& wave, const Window& window) {
  const RaysOut rays = wave.rays.Columns(window.first);
  uint32_t* medium = &wave.path_medium[window.first];
  for (uint32_t i = window.rays - window.fresh; i < window.rays; ++i) {
    medium[rays.path[i]] = context.media->camera;
  }
  AbsorbLight(context.width, AbsorbLightArgs{context.media->absorption,
                                             medium,
                                             rays.path,
                                             wave.hits.ReadColumns(window.first).t,
                                             nullptr,
                                             {},
                                             window.rays,
                                             rays.throughput});
}

void CrossBorders(const RenderContext& context, Wave& wave, const Window& window,
                  const PassingRays& passing) {
  if (!context.media->any_border) return;
  const uint32_t* entered = MediaBehind(context, wave, window, passing);
  const uint32_t* path = wave.rays.ReadColumns(window.first).path;
  uint32_t* medium = &wave.path_medium[window.first];
  for (size_t k = 0; k < passing.count; ++k) {
    if (entered[k] == kKeptMedium) continue;
    const uint32_t at = passing.through[k];
    medium[path[passing.row == nullptr ? at : passing.row[at]]] = entered[k];
  }
}

void AbsorbBehind(const RenderContext& context, Wave& wave, const Window& window,
                  const uint32_t* row, const float* distance, size_t count) {
  const RaysOut rays = wave.rays.Columns(window.first);
  const RgbFields<Out> left = wave.next.Columns(window.first).throughput;
  uint32_t* medium = &wave.entered[window.first];
  for (size_t k = 0; k < count; ++k) {
    medium[k] = wave.path_medium[window.first + rays.path[row[k]]];
    left.r[k] = left.g[k] = left.b[k] = 1.0f;
  }
  AbsorbLight(context.width,
              AbsorbLightArgs{
                  context.media->absorption, medium, nullptr, distance, nullptr, {}, count, left});
  for (size_t k = 0; k < count; ++k) {
    rays.throughput.r[row[k]] *= left.r[k];
    rays.throughput.g[row[k]] *= left.g[k];
    rays.throughput.b[row[k]] *= left.b[k];
  }
}

void AbsorbShadowRays(const RenderContext& context, Wave& wave, const Window& window,
                      const float* nearest, size_t count) {
  const ShadowRaysIn shadow = wave.shadow_rays.ReadColumns(window.first);
  AbsorbLight(context.width,
              AbsorbLightArgs{context.media->absorption, &wave.shadow_medium[window.first], nullptr,
                              shadow.t_max, nearest, shadow.dir, count,
                              wave.shadow_rays.Columns(window.first).radiance});
}

void CrossShadowBorders(const RenderContext& context, Wave& wave, const Window& window,
                        const PassingRays& passing) {
  const uint32_t* entered =
      context.media->any_border ? MediaBehind(context, wave, window, passing) : nullptr;
  uint32_t* medium = &wave.shadow_medium[window.first];
  for (size_t k = 0; k < passing.count; ++k) {
    const bool crosses = entered != nullptr && entered[k] != kKeptMedium;
    medium[k] = crosses ? entered[k] : medium[passing.through[k]];
  }
}

void EnterMediaStage(const RenderContext& context, Wave& wave) {
  if (context.media == nullptr) return;
  for (const Window& window : wave.windows) {
    const RaysIn rays = wave.rays.ReadColumns(window.first);
    const RaysIn next = wave.next.ReadColumns(window.first);
    const ShadowRaysIn shadow = wave.shadow_rays.ReadColumns(window.first);
    uint32_t* row_of_path = &wave.keys[window.first];  // the sort's scratch is free by now
    for (uint32_t i = 0; i < window.rays; ++i) row_of_path[rays.path[i]] = i;
    uint32_t* medium = &wave.path_medium[window.first];
    uint32_t* entered = &wave.entered[window.first];
    EnterMediaArgs args{&context.scene,
                        context.media->surfaces,
                        rays.org,
                        rays.dir,
                        wave.hits.ReadColumns(window.first),
                        row_of_path,
                        shadow.path,
                        shadow.dir,
                        medium,
                        window.shadow_rays,
                        &wave.shadow_medium[window.first]};
    EnterMedia(context.width, args);
    args.path = next.path;
    args.leaving = next.dir;
    args.count = window.rays;
    args.after = entered;
    EnterMedia(context.width, args);
    for (uint32_t i = 0; i < window.rays; ++i) medium[next.path[i]] = entered[i];
  }
}

}  // namespace swell
