// Measured cells and builds in, text for people and JSON out.
#ifndef SWELL_BENCH_TRAVERSAL_TABLES_H_
#define SWELL_BENCH_TRAVERSAL_TABLES_H_

#include <string>
#include <vector>

#include "bench/traversal/builds.h"
#include "bench/traversal/cells.h"

namespace swell::bench {

// Differences of one set of rays, with their names.
struct HitRow {
  std::string scene;
  const RaySetSpec* set;
  Differences differences;
};

std::string CellTable(const std::vector<Cell>& cells);
// Hardware events per ray, of swell and of the best peer.
std::string CounterTable(const std::vector<Cell>& cells);
bool AnyCounted(const std::vector<Cell>& cells);
std::string HitTable(const std::vector<HitRow>& hits);
std::string BuildTable(const std::vector<BuildRow>& builds);

struct Figures {
  std::vector<Cell> cells;
  std::vector<HitRow> hits;
  std::vector<BuildRow> builds;
};
std::string ToJson(const Figures& figures);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_TABLES_H_
