// A run of a sorted wave in, its continued paths and shadow rays out.
#include "bench/shading.h"

#include "kernels/material.h"
#include "kernels/sort_hits.h"

namespace swell::bench {

uint32_t KindOf(const RayWave& wave, const Run& run) {
  if (run.material >= kMissRun) return kMaterialKindCount;
  return wave.scene->tables.view.materials.kind[run.material];
}

void ShadeAs(Width width, const RayWave& wave, uint32_t kind, const float* params,
             const uint32_t* rows, size_t count, size_t first, const PathSettings& settings,
             Shaded& shaded) {
  const ShadeArgs args{&wave.scene->tables.view,
                       settings,
                       params,
                       rows,
                       count,
                       wave.rays.ReadColumns(),
                       wave.hits.ReadColumns(),
                       wave.paths.ReadColumns(),
                       shaded.next.Columns(first),
                       shaded.shadow_rays.Columns(),
                       shaded.shadow_count};
  shaded.shadow_count = kMaterialKinds[kind]->shade(width, args);
}

void ShadeRun(Width width, const RayWave& wave, const SortedWave& sorted, const Run& run,
              const PathSettings& settings, Shaded& shaded) {
  const float* params =
      wave.scene->tables.view.materials.params + size_t{run.material} * kMaterialWords;
  ShadeAs(width, wave, KindOf(wave, run), params, &sorted.rows[run.first], run.count, run.first,
          settings, shaded);
}

}  // namespace swell::bench
