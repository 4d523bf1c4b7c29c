// Scenes in, seconds and bytes of building their trees out.
#include "bench/traversal/builds.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "src/bvh/bvh.h"
#include "src/stats/peak_rise.h"

namespace swell::bench {
namespace {

// Times `build` and notes the most memory that was resident meanwhile.
void Measure(const std::function<void()>& build, BuildTimes& times) {
  const std::optional<int64_t> peak = PeakRise([&] {
    const auto start = std::chrono::steady_clock::now();
    build();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    times.seconds.push_back(elapsed.count());
  });
  if (peak) times.peak = std::max(times.peak.value_or(0), *peak);
}

}  // namespace

Spread BuildRow::Ratio() const {
  std::vector<double> ratios;
  for (size_t i = 0; i < swell.seconds.size(); ++i) {
    ratios.push_back(peer.seconds[i] / swell.seconds[i]);
  }
  return SpreadOf(ratios);
}

Result<BuildRow> MeasureBuilds(const std::string& name, const Scene& scene, const Peer& peer,
                               uint32_t threads, uint32_t repetitions) {
  BuildRow row{name,
               threads,
               scene.triangle_count(),
               scene.positions.size() * sizeof(float) + scene.indices.size() * sizeof(uint32_t),
               {},
               {}};
  tbb::task_arena arena(static_cast<int>(threads));
  for (uint32_t repetition = 0; repetition < repetitions; ++repetition) {
    Result<Bvh> bvh = Bvh();
    const auto build_swell = [&] {
      Measure([&] { arena.execute([&] { bvh = BuildBvh(scene); }); }, row.swell);
    };
    const auto build_peer = [&] {
      const auto tree = peer.Attach(scene, {false, false, threads});
      Measure([&] { tree->Build(); }, row.peer);
      row.peer.bytes = tree->bytes().after;
    };
    if (repetition % 2 == 0) build_swell();
    build_peer();
    if (repetition % 2 == 1) build_swell();
    if (!bvh) return bvh.error();
    row.swell.bytes = static_cast<int64_t>(bvh->bytes());
  }
  return row;
}

}  // namespace swell::bench
