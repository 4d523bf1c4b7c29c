// Measures IntersectRays: closest hits of recorded rays, by traversal and width.
#include "kernels/intersect_rays.h"

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

void Intersect(benchmark::State& state, const WaveSource& source, Traversal traversal,
               Width width) {
  const RayWave& wave = RaysOf(source);
  const BvhView bvh = wave.scene->bvh.view();
  const RaysIn rays = wave.rays.ReadColumns();
  Table<HitFields> hits(wave.rows);
  LaneUse use;
  for (auto _ : state) {
    use = IntersectRays(width, bvh, traversal, rays.org, rays.dir, hits.Columns(), wave.rows);
    benchmark::ClobberMemory();
  }
  Report(state, wave.rows, use);
}

void Add(const WaveSource& source) {
  for (const NamedTraversal& t : kTraversals) {
    for (Width width : kWidths) {
      const std::string name = "IntersectRays/" + source.label + "/" + t.name + "/" + NameOf(width);
      benchmark::RegisterBenchmark(name.c_str(), Intersect, source, t.traversal, width);
    }
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
