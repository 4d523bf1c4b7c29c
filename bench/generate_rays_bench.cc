// Measures GenerateRays: camera rays of neighbouring pixels.
#include "kernels/generate_rays.h"

#include <numeric>
#include <string>
#include <vector>

#include "bench/cases.h"
#include "src/scene/views.h"

namespace swell::bench {
namespace {

void Generate(benchmark::State& state, Width width) {
  const Scene& scene = SceneOf("cornell").scene;
  const RenderRequest& request = scene.request;
  const FilterTables filter = MakeFilterTables(request.filter);
  std::vector<uint32_t> pixels(kMostRows + kRowPadding), slots(pixels.size());
  for (uint32_t i = 0; i < kMostRows; ++i) pixels[i] = i % 64 | (i / 64) << 16;
  std::iota(slots.begin(), slots.end(), 0u);
  Table<RayFields> rays(kMostRows);
  Table<PathFields> paths(kMostRows);
  GenerateRaysArgs args{MakeCameraView(scene.camera, request.width, request.height),
                        filter.view(),
                        /*seed=*/0,
                        /*sample=*/0,
                        pixels.data(),
                        slots.data(),
                        kMostRows};
  for (auto _ : state) {
    GenerateRays(width, args, rays.Columns(), paths.Columns());
    ++args.sample;
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, kMostRows);
}
BENCHMARK_CAPTURE(Generate, wide, Width::kWide)->Name("GenerateRays/cornell/wide");
BENCHMARK_CAPTURE(Generate, one_lane, Width::kOneLane)->Name("GenerateRays/cornell/one_lane");

}  // namespace
}  // namespace swell::bench
