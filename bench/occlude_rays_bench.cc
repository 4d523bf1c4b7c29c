// Measures OccludeRays: any hit of recorded shadow rays, by traversal and width.
#include "kernels/occlude_rays.h"

#include <string>

#include "bench/cases.h"

namespace swell::bench {
namespace {

struct NamedTraversal {
  const char* name;
  Traversal traversal;
};
constexpr NamedTraversal kTraversals[] = {
    {"packet", Traversal::kPacket}, {"single", Traversal::kSingle}, {"auto", Traversal::kAuto}};

void Occlude(benchmark::State& state, const WaveSource& source, Traversal traversal, Width width) {
  const ShadowWave& wave = ShadowRaysOf(source);
  const BvhView bvh = wave.scene->bvh.view();
  Table<PathFields> paths(wave.rows);
  LaneUse use;
  for (auto _ : state) {
    use = OccludeRays(width, bvh, traversal, wave.shadow_rays.ReadColumns(),
                      paths.Columns().radiance, wave.rows);
    benchmark::ClobberMemory();
  }
  Report(state, wave.rows, use);
}

void Add(const WaveSource& source) {
  for (const NamedTraversal& t : kTraversals) {
    for (Width width : kWidths) {
      const std::string name = "OccludeRays/" + source.label + "/" + t.name + "/" + NameOf(width);
      benchmark::RegisterBenchmark(name.c_str(), Occlude, source, t.traversal, width);
    }
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kShadowRays, Add);

}  // namespace
}  // namespace swell::bench
