// Shading of recorded waves, for the benchmarks of materials and of what follows them.
#ifndef SWELL_BENCH_SHADING_H_
#define SWELL_BENCH_SHADING_H_

#include "bench/waves.h"
#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell::bench {

// What shading writes.
struct Shaded {
  explicit Shaded(uint32_t rows) : next(rows), shadow_rays(rows) {}
  Table<RayFields> next;
  Table<ShadowRayFields> shadow_rays;
  size_t shadow_count = 0;
};

// The kind (index of kMaterialKinds) of a run; kMaterialKindCount for runs without a material.
uint32_t KindOf(const RayWave& wave, const Run& run);

// Shades `count` rows, readable up to the padding, as if they had a material of `kind`; what it
// writes starts at row `first` of `shaded.next`, its shadow rays are appended.
void ShadeAs(Width width, const RayWave& wave, uint32_t kind, const float* params,
             const uint32_t* rows, size_t count, size_t first, const PathSettings& settings,
             Shaded& shaded);

// Shades one run of a sorted wave to the same rows of `shaded.next`; its shadow rays are appended.
void ShadeRun(Width width, const RayWave& wave, const SortedWave& sorted, const Run& run,
              const PathSettings& settings, Shaded& shaded);

}  // namespace swell::bench

#endif  // SWELL_BENCH_SHADING_H_
