// One kind of rays in one scene, swell and its peers in alternation: rates, their ratio, the
// target.
#ifndef SWELL_BENCH_TRAVERSAL_CELLS_H_
#define SWELL_BENCH_TRAVERSAL_CELLS_H_

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/spread.h"
#include "bench/traversal/compare_hits.h"
#include "bench/traversal/run.h"

namespace swell::bench {

// A peer's tree of the scene, in one of its modes.
struct PeerTree {
  const Peer* peer;
  PeerSceneOptions options;
  std::unique_ptr<PeerScene> scene;
};

// The engines worth the repetitions: swell's own, and the best of the peers' by a short trial.
struct Shortlist {
  Engine swell_auto;
  std::vector<Engine> swell_fixed;
  std::vector<Engine> peers;   // in their default mode
  std::vector<Engine> robust;  // in their robust mode
};
Shortlist ChooseEngines(const RaySet& set, const Bvh& bvh, const std::vector<PeerTree>& trees,
                        bool cpu_time);

struct EngineTimes {
  std::string name;
  std::vector<double> seconds;  // by repetition
  PerfCounts counts_per_ray;    // over all repetitions
};

struct Cell {
  std::string scene;
  const RaySetSpec* set;
  uint32_t rows;
  uint32_t threads;
  EngineTimes swell, fixed, peer, robust;  // of the last three the best
  std::vector<EngineTimes> all_fixed;      // those that are not far behind
  std::vector<EngineTimes> all;            // every engine that took part
  std::optional<double> target;            // ratio to the peer; empty: not counted

  double MraysPerSecond(const EngineTimes& engine) const;  // median
  Spread RatioTo(const EngineTimes& engine) const;         // swell's rate over the engine's
  bool auto_ok() const { return RatioTo(fixed).median >= 0.95; }
  bool at_target() const { return target && RatioTo(peer).median >= *target; }
};

struct CellOptions {
  uint32_t threads = 1;
  uint32_t repetitions = 10;
  bool cpu_time = false;      // see PassOptions
  double pass_seconds = 0.1;  // a pass repeats for so long: for the clock and for threads to start
};

// The engines take turns; each repetition starts with the next one.
Cell MeasureCell(const std::string& scene, const RaySet& set, const Shortlist& engines,
                 const CellOptions& options);

// The ratio to reach; empty for scenes and rays that are not counted.
std::optional<double> TargetOf(const std::string& scene, const RaySetSpec& set);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_CELLS_H_
