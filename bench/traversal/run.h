// An engine and rows in, the seconds and the hardware events of tracing them out.
#ifndef SWELL_BENCH_TRAVERSAL_RUN_H_
#define SWELL_BENCH_TRAVERSAL_RUN_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "bench/record_wave.h"
#include "bench/traversal/peer.h"
#include "bench/traversal/ray_sets.h"
#include "src/bvh/bvh.h"
#include "src/stats/perf_counters.h"

namespace swell::bench {

// Where a thread's hits go: tables of one wave, which stay in its cache as those of a render do.
struct WaveOutput {
  Table<HitFields> hits{kMostRows};
  Table<PathFields> paths{kMostRows};
};

struct Engine {
  std::string name;
  // Traces at most kMostRows rows from row `first` on, a multiple of kMostRows.
  std::function<void(size_t first, size_t count, const HitsOut&, const RgbFields<Out>&)> trace;
};

// The set, the tree and the peer's scene must outlive the engine.
Engine SwellEngine(const RaySet& set, const Bvh& bvh, Traversal traversal, std::string name);
Engine PeerEngine(const RaySet& set, const PeerScene& scene, size_t way, std::string name);

struct PassOptions {
  size_t stride = 1;  // every stride-th wave is traced
  size_t repeat = 1;  // times
  // Instead of the wall's clock, the time that threads had a CPU, shared out over them: other
  // programs count less, idle threads count not at all.
  bool cpu_time = false;
};

struct Pass {
  double seconds = 0;
  PerfCounts counts;  // of all threads
};

// Threads take waves of the rows from one counter.
Pass TimePass(const Engine& engine, size_t rows, uint32_t threads, const PassOptions& options);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_RUN_H_
