// Figures in, aligned columns and JSON out.
#include "bench/traversal/tables.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/stats/machine.h"
#include "src/stats/text_table.h"

namespace swell::bench {
namespace {

using nlohmann::json;

std::string Number(uint64_t n) { return std::to_string(n); }

std::string Quartiles(const Spread& spread) {
  return Format("%.2f [%.2f, %.2f]", spread.median, spread.lower, spread.upper);
}

template <class T> json OrNull(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

json ToJson(const Spread& spread) {
  return {{"least", spread.least},
          {"lower", spread.lower},
          {"median", spread.median},
          {"upper", spread.upper},
          {"most", spread.most}};
}

json ToJson(const EngineTimes& engine) {
  json counts = json::object();
  for (uint32_t i = 0; i < kPerfEventCount; ++i) {
    counts[kPerfEventNames[i]] = OrNull(engine.counts_per_ray[i]);
  }
  return {{"engine", engine.name}, {"seconds", engine.seconds}, {"per_ray", counts}};
}

json ToJson(const Cell& cell) {
  json engines = json::array();
  for (const EngineTimes& engine : cell.all) engines.push_back(ToJson(engine));
  return {{"scene", cell.scene},
          {"rays_of", cell.set->name},
          {"threads", cell.threads},
          {"rows", cell.rows},
          {"swell", cell.swell.name},
          {"best_fixed", cell.fixed.name},
          {"best_peer", cell.peer.name},
          {"best_robust", cell.robust.name},
          {"swell_mrays_per_second", cell.MraysPerSecond(cell.swell)},
          {"peer_mrays_per_second", cell.MraysPerSecond(cell.peer)},
          {"ratio", ToJson(cell.RatioTo(cell.peer))},
          {"ratio_to_robust", ToJson(cell.RatioTo(cell.robust))},
          {"ratio_to_fixed", ToJson(cell.RatioTo(cell.fixed))},
          {"target", OrNull(cell.target)},
          {"engines", engines}};
}

json ToJson(const HitRow& row) {
  const Differences& d = row.differences;
  return {{"scene", row.scene},
          {"rays_of", row.set->name},
          {"rows", d.rows},
          {"coplanar", d.coplanar},
          {"shared_edge", d.shared_edge},
          {"below_rounding", d.below_rounding},
          {"distance", d.distance},
          {"other", d.other},
          {"traversals_differ", d.traversals_differ}};
}

json ToJson(const BuildTimes& times) {
  return {{"seconds", times.seconds},
          {"bytes", times.bytes},
          {"peak_bytes", OrNull(times.peak)},
          {"expected_cost", OrNull(times.expected)}};
}

// The best first.
std::string FixedRates(const Cell& cell) {
  std::string text;
  for (const EngineTimes& fixed : cell.all_fixed) {
    const std::string rate = Format("%s %.2f", fixed.name.c_str(), cell.MraysPerSecond(fixed));
    text = fixed.name == cell.fixed.name ? rate + (text.empty() ? "" : ", ") + text
                                         : text + (text.empty() ? "" : ", ") + rate;
  }
  return text;
}

std::string MprimsPerSecond(const BuildRow& row, const BuildTimes& times) {
  const Spread spread = SpreadOf(times.seconds);
  return Format("%.2f", static_cast<double>(row.triangles) / spread.median / 1e6);
}

std::string PeakTimes(const BuildRow& row, const BuildTimes& times) {
  if (!times.peak) return "-";
  return Format("%.1f", static_cast<double>(*times.peak) / static_cast<double>(row.mesh_bytes));
}

std::string BytesPerTriangle(const BuildRow& row, const BuildTimes& times) {
  return Format("%.1f", static_cast<double>(times.bytes) / static_cast<double>(row.triangles));
}

}  // namespace

std::string CellTable(const std::vector<Cell>& cells) {
  TextTable table(2);
  table.Add({"scene", "rays", "threads", "swell", "fixed", "auto/best", "", "peer", "through",
             "ratio", "robust", "target", ""});
  for (const Cell& cell : cells) {
    table.Add({cell.scene, cell.set->name, Number(cell.threads),
               Format("%.2f", cell.MraysPerSecond(cell.swell)), FixedRates(cell),
               Format("%.2f", cell.RatioTo(cell.fixed).median), cell.auto_ok() ? "ok" : "slow",
               Format("%.2f", cell.MraysPerSecond(cell.peer)), cell.peer.name,
               Quartiles(cell.RatioTo(cell.peer)), Format("%.2f", cell.RatioTo(cell.robust).median),
               FormatOr("%.1f", cell.target),
               !cell.target       ? "-"
               : cell.at_target() ? "ok"
                                  : "miss"});
  }
  return table.Text();
}

bool AnyCounted(const std::vector<Cell>& cells) {
  const auto counted = [](const Cell& cell) {
    const PerfCounts& counts = cell.swell.counts_per_ray;
    return std::any_of(counts.begin(), counts.end(), [](const auto& count) { return !!count; });
  };
  return std::any_of(cells.begin(), cells.end(), counted);
}

std::string CounterTable(const std::vector<Cell>& cells) {
  TextTable table(4);
  table.Add({"scene", "rays", "threads", "engine", "Mrays/s", "cycles", "instructions",
             "l1d misses", "llc misses", "branch misses"});
  for (const Cell& cell : cells) {
    for (const EngineTimes* engine : {&cell.swell, &cell.peer}) {
      std::vector<std::string> row = {
          cell.scene, cell.set->name, Number(cell.threads),
          engine == &cell.swell ? "swell " + engine->name : engine->name,
          Format("%.2f", cell.MraysPerSecond(*engine))};
      for (const auto& count : engine->counts_per_ray) {
        row.push_back(FormatOr("%.2f", count));
      }
      table.Add(row);
    }
  }
  return table.Text();
}

std::string HitTable(const std::vector<HitRow>& hits) {
  TextTable table(2);
  table.Add({"scene", "rays", "compared", "differ", "per million", "coplanar", "shared edge",
             "below rounding", "distance", "other", "traversals differ"});
  for (const HitRow& row : hits) {
    const Differences& d = row.differences;
    table.Add({row.scene, row.set->name, Number(d.rows), Number(d.total()),
               Format("%.1f", d.per_million()), Number(d.coplanar), Number(d.shared_edge),
               Number(d.below_rounding), Number(d.distance), Number(d.other),
               Number(d.traversals_differ)});
  }
  return table.Text();
}

std::string BuildTable(const std::vector<BuildRow>& builds) {
  TextTable table(1);
  table.Add({"scene", "threads", "triangles", "swell Mprims/s", "peer", "ratio", "",
             "bytes/triangle", "peer", "", "peak/mesh", "peer", "", "expected cost", "peer"});
  for (const BuildRow& row : builds) {
    const double bytes = static_cast<double>(row.swell.bytes) / static_cast<double>(row.triangles);
    const bool peak_ok =
        row.swell.peak && *row.swell.peak <= 3 * static_cast<int64_t>(row.mesh_bytes);
    table.Add({row.scene, Number(row.threads), Number(row.triangles),
               MprimsPerSecond(row, row.swell), MprimsPerSecond(row, row.peer),
               Quartiles(row.Ratio()), row.Ratio().median >= 1.0 ? "ok" : "miss",
               BytesPerTriangle(row, row.swell), BytesPerTriangle(row, row.peer),
               bytes <= 75 ? "ok" : "miss", PeakTimes(row, row.swell), PeakTimes(row, row.peer),
               !row.swell.peak ? "-"
               : peak_ok       ? "ok"
                               : "miss",
               FormatOr("%.1f", row.swell.expected), FormatOr("%.1f", row.peer.expected)});
  }
  return table.Text();
}

std::string ToJson(const Figures& figures) {
  json cells = json::array(), hits = json::array(), builds = json::array();
  for (const Cell& cell : figures.cells) cells.push_back(ToJson(cell));
  for (const HitRow& row : figures.hits) hits.push_back(ToJson(row));
  for (const BuildRow& row : figures.builds) {
    builds.push_back({{"scene", row.scene},
                      {"threads", row.threads},
                      {"triangles", row.triangles},
                      {"mesh_bytes", row.mesh_bytes},
                      {"ratio", ToJson(row.Ratio())},
                      {"swell", ToJson(row.swell)},
                      {"peer", ToJson(row.peer)}});
  }
  const Machine machine = DescribeMachine(Width::kWide);
  const json document = {{"machine",
                          {{"cpu", OrNull(machine.cpu)},
                           {"isa", machine.isa},
                           {"lanes", machine.lanes},
                           {"threads", machine.threads},
                           {"compiler", machine.compiler},
                           {"git", OrNull(machine.git)}}},
                         {"cells", cells},
                         {"hits", hits},
                         {"builds", builds}};
  return document.dump(1) + "\n";
}

}  // namespace swell::bench
