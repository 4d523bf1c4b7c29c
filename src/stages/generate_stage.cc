// units -> rays, paths: fills the free rows of every window with camera rays.
#include <algorithm>

#include "kernels/generate_rays.h"
#include "kernels/lane_count.h"
#include "src/stages/count_bounces.h"
#include "src/stages/stages.h"

namespace swell {
namespace {

// Refilling a few rows at a time would cost more calls than the empty lanes cost.
bool WantsRefill(const RenderContext& context, const Window& window) {
  if (window.rays == 0) return true;
  return context.regenerate && window.free_slots * 8 >= window.capacity;
}

// Starts as many paths as the window has rows and the units have work; returns how many.
uint32_t FillWindow(const RenderContext& context, Units& units, UnitCursor& cursor, Wave& wave,
                    Window& window) {
  uint32_t started = 0;
  while (window.free_slots > 0) {
    if (cursor.done()) {
      cursor = {};
      if (!units.Next(cursor.unit)) break;
    }
    const uint32_t count = std::min(window.free_slots, cursor.unit.pixel_count - cursor.pixel);
    window.free_slots -= count;
    GenerateRaysArgs args{context.camera,
                          context.filter,
                          context.settings.seed,
                          cursor.unit.first_sample + cursor.sample,
                          cursor.unit.pixels + cursor.pixel,
                          &wave.slots[window.first + window.free_slots],
                          count,
                          context.settings.sampler};
    GenerateRays(context.width, args, wave.rays.Columns(window.first + window.rays),
                 wave.paths.Columns(window.first));
    window.rays += count;
    started += count;
    cursor.pixel += count;
    if (cursor.pixel == cursor.unit.pixel_count) {
      cursor.pixel = 0;
      ++cursor.sample;
    }
  }
  return started;
}

}  // namespace

bool GenerateStage(const RenderContext& context, Units& units, UnitCursor& cursor, Wave& wave,
                   StageStats& stats) {
  BounceCounts camera{};
  uint32_t live = 0;
  {
    StageTimer timer(context, stats, Stage::kGenerate, camera);
    for (Window& window : wave.windows) {
      window.fresh =
          WantsRefill(context, window) ? FillWindow(context, units, cursor, wave, window) : 0;
      camera[0] += window.fresh;
      live += window.rays;
      timer.CountRows(window.fresh, LaneCount(context.width), sizeof(uint32_t) * 2,
                      Table<RayFields>::kRowBytes + Table<PathFields>::kRowBytes);
    }
    wave.bounces.fill(0);
    for (const Window& window : wave.windows) AddRayBounces(wave, window, wave.bounces);
  }
  stats.paths += camera[0];
  return live > 0;
}

}  // namespace swell
