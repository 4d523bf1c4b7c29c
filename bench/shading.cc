// A run of a sorted wave in, its continued paths and shadow rays out.
#include "bench/shading.h"

#include "kernels/material.h"
#include "kernels/sort_hits.h"

namespace swell::bench {

uint32_t KindOf(const RayWave& wave, const Run& run) {
  if (run.material >= kMissRun) return kMaterialKindCount;
  return wave.scene->tables.view.materials.kind[run.material];
}

void ShadeRun(Width width, const RayWave& wave, const SortedWave& sorted, const Run& run,
              const PathSettings& settings, Shaded& shaded) {
  const SceneView& scene = wave.scene->tables.view;
  const ShadeArgs args{&scene,
                       settings,
                       scene.materials.params + size_t{run.material} * kMaterialWords,
                       &sorted.rows[run.first],
                       run.count,
                       wave.rays.ReadColumns(),
                       wave.hits.ReadColumns(),
                       wave.paths.ReadColumns(),
                       shaded.next.Columns(run.first),
                       shaded.shadow_rays.Columns(),
                       shaded.shadow_count};
  shaded.shadow_count = kMaterialKinds[KindOf(wave, run)]->shade(width, args);
}

}  // namespace swell::bench
