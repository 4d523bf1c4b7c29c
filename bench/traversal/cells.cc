// Engines in, the times of their alternated repetitions out.
#include "bench/traversal/cells.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace swell::bench {
namespace {

struct Tried {
  Engine engine;
  double seconds;
};

// The best of two passes over waves from all over the set.
Tried Try(Engine engine, size_t rows, bool cpu_time) {
  constexpr size_t kTrialWaves = 16;
  const size_t stride = std::max<size_t>(1, rows / kMostRows / kTrialWaves);
  const double first = TimePass(engine, rows, 1, {stride, 1, cpu_time}).seconds;
  const double second = TimePass(engine, rows, 1, {stride, 1, cpu_time}).seconds;
  return {std::move(engine), std::min(first, second)};
}

// At most `most`, none slower than the best by more than `factor`.
std::vector<Engine> Best(std::vector<Tried> tried, size_t most, double factor) {
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried& a, const Tried& b) { return a.seconds < b.seconds; });
  std::vector<Engine> best;
  for (Tried& one : tried) {
    if (best.size() == most || one.seconds > factor * tried.front().seconds) break;
    best.push_back(std::move(one.engine));
  }
  return best;
}

double MedianSeconds(const EngineTimes& engine) { return SpreadOf(engine.seconds).median; }

// The quickest of [first, first + count).
const EngineTimes& Quickest(const std::vector<EngineTimes>& all, size_t first, size_t count) {
  return *std::min_element(
      all.begin() + static_cast<ptrdiff_t>(first),
      all.begin() + static_cast<ptrdiff_t>(first + count),
      [](const auto& a, const auto& b) { return MedianSeconds(a) < MedianSeconds(b); });
}

// Issue 3: how many times the peer's rays per second each cell is to reach.
struct TargetRow {
  const char* set;
  double of_scene[4];
};
constexpr const char* kTargetScenes[] = {"cornell", "pillars", "valley-1m", "valley-4m"};
constexpr TargetRow kTargets[] = {
    {"camera", {1.2, 1.2, 1.3, 1.3}},  {"bounce1", {1.2, 1.2, 1.3, 1.4}},
    {"bounce3", {1.2, 1.3, 1.5, 2.0}}, {"shadow0", {1.1, 1.2, 1.2, 1.2}},
    {"shadow3", {1.2, 1.3, 1.6, 2.0}},
};

}  // namespace

std::optional<double> TargetOf(const std::string& scene, const RaySetSpec& set) {
  const auto* column = std::find(std::begin(kTargetScenes), std::end(kTargetScenes), scene);
  if (column == std::end(kTargetScenes)) return std::nullopt;
  for (const TargetRow& row : kTargets) {
    if (row.set == std::string(set.name)) return row.of_scene[column - kTargetScenes];
  }
  return std::nullopt;
}

Shortlist ChooseEngines(const RaySet& set, const Bvh& bvh, const std::vector<PeerTree>& trees,
                        bool cpu_time) {
  std::vector<Tried> fixed, plain, robust;
  for (const NamedTraversal& one : kFixedTraversals) {
    fixed.push_back(Try(SwellEngine(set, bvh, one.traversal, one.name), set.rows, cpu_time));
  }
  const bool many = trees.front().peer != trees.back().peer;
  for (const PeerTree& tree : trees) {
    for (size_t way = 0; way < tree.peer->ways().size(); ++way) {
      const std::string name = tree.peer->ways()[way] +
                               (tree.options.high_quality ? ", high" : ", medium") +
                               (many ? ", " + tree.peer->name() : "");
      auto& list = tree.options.robust ? robust : plain;
      list.push_back(Try(PeerEngine(set, *tree.scene, way, name), set.rows, cpu_time));
    }
  }
  return {SwellEngine(set, bvh, Traversal::kAuto, "auto"), Best(fixed, fixed.size(), 2.0),
          Best(plain, 4, 1.10), Best(robust, 2, 1.05)};
}

Cell MeasureCell(const std::string& scene, const RaySet& set, const Shortlist& engines,
                 const CellOptions& options) {
  const auto [threads, repetitions, cpu_time, pass_seconds] = options;
  std::vector<const Engine*> order = {&engines.swell_auto};
  for (const auto* list : {&engines.swell_fixed, &engines.peers, &engines.robust}) {
    for (const Engine& engine : *list) order.push_back(&engine);
  }
  Cell cell{scene, set.spec, set.rows, threads, {}, {}, {}, {}, {}, {}, TargetOf(scene, *set.spec)};
  double least_seconds = INFINITY;
  for (const Engine* engine : order) {
    least_seconds = std::min(least_seconds, TimePass(*engine, set.rows, threads, {}).seconds);
    cell.all.push_back({engine->name, {}, {}});
  }
  const auto repeat = static_cast<size_t>(std::clamp(pass_seconds / least_seconds, 1.0, 1000.0));
  for (uint32_t repetition = 0; repetition < repetitions; ++repetition) {
    for (size_t turn = 0; turn < order.size(); ++turn) {
      const size_t e = (turn + repetition) % order.size();
      // Untimed, so that no engine gains by what the one before it left in the caches.
      TimePass(*order[e], set.rows, threads, {1, 1, cpu_time});
      const Pass pass = TimePass(*order[e], set.rows, threads, {1, repeat, cpu_time});
      EngineTimes& times = cell.all[e];
      times.seconds.push_back(pass.seconds / static_cast<double>(repeat));
      times.counts_per_ray = repetition == 0 ? pass.counts : times.counts_per_ray + pass.counts;
    }
  }
  for (EngineTimes& times : cell.all) {
    for (auto& count : times.counts_per_ray) {
      if (count) *count /= static_cast<double>(set.rows * repeat * repetitions);
    }
  }
  const size_t fixed = 1, peers = fixed + engines.swell_fixed.size(),
               robust = peers + engines.peers.size();
  cell.swell = cell.all[0];
  cell.all_fixed.assign(cell.all.begin() + fixed, cell.all.begin() + static_cast<ptrdiff_t>(peers));
  cell.fixed = Quickest(cell.all, fixed, engines.swell_fixed.size());
  cell.peer = Quickest(cell.all, peers, engines.peers.size());
  cell.robust = Quickest(cell.all, robust, engines.robust.size());
  return cell;
}

double Cell::MraysPerSecond(const EngineTimes& engine) const {
  return rows / MedianSeconds(engine) / 1e6;
}

Spread Cell::RatioTo(const EngineTimes& engine) const {
  std::vector<double> ratios;
  for (size_t i = 0; i < swell.seconds.size(); ++i) {
    ratios.push_back(engine.seconds[i] / swell.seconds[i]);
  }
  return SpreadOf(ratios);
}

}  // namespace swell::bench
