// A scene in, how fast swell and a peer build its tree and how much memory it takes out.
#ifndef SWELL_BENCH_TRAVERSAL_BUILDS_H_
#define SWELL_BENCH_TRAVERSAL_BUILDS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/spread.h"
#include "bench/traversal/peer.h"
#include "src/base/result.h"

namespace swell::bench {

struct BuildTimes {
  std::vector<double> seconds;     // by repetition
  int64_t bytes = 0;               // of the tree with all that traversal needs
  std::optional<int64_t> peak;     // bytes resident above those before the build, the most
  std::optional<double> expected;  // cost of a ray by the surface area heuristic; null: not known
};

struct BuildRow {
  std::string scene;
  uint32_t threads;
  size_t triangles;
  size_t mesh_bytes;  // vertices and indices
  BuildTimes swell, peer;

  Spread Ratio() const;  // swell's primitives per second over the peer's
};

// In alternation; the peer at medium quality.
Result<BuildRow> MeasureBuilds(const std::string& name, const Scene& scene, const Peer& peer,
                               uint32_t threads, uint32_t repetitions);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_BUILDS_H_
