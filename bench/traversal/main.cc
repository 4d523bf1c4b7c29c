// swell_bench_traversal: scenes in, tables of swell's traversal and build beside its peers' out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/scenes.h"
#include "bench/traversal/tables.h"
#include "src/stats/isa.h"
#include "src/stats/machine.h"

namespace swell::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes = {"cornell", "pillars", "valley-1m", "valley-4m"};
  std::vector<std::string> rays_of;  // names of kRaySets; none: all
  std::vector<uint32_t> thread_counts = {1, 2};
  uint32_t rays = 1u << 20;
  uint32_t repetitions = 10;
  std::string data_folder;
  std::string json_file;
  std::string isa = "auto";
  bool cpu_time = false;
  bool quick = false;
  bool builds = true;
  bool cells = true;
  bool hits = true;
};

void Say(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

void Print(const std::string& title, const std::string& table) {
  std::printf("%s\n%s\n", title.c_str(), table.c_str());
  std::fflush(stdout);
}

// The scans and scene files of a folder, with the names they go by.
std::vector<std::pair<std::string, std::string>> DataScenes(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> scenes;
  const std::string dragon = folder + "/meshes/stanford-dragon-871k.ply";
  if (std::filesystem::exists(dragon)) scenes.push_back({"dragon", dragon});
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/bench", none)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".pbrt") continue;
    const std::string stem = path.stem();
    scenes.push_back({stem == "glassroom" ? "room" : stem + ".pbrt", path});
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::vector<PeerTree> BuildPeerTrees(const Scene& scene,
                                     const std::vector<std::unique_ptr<Peer>>& peers,
                                     uint32_t threads) {
  std::vector<PeerTree> trees;
  for (const auto& peer : peers) {
    for (bool robust : {false, true}) {
      for (bool high : {false, true}) {
        const PeerSceneOptions options{high, robust, threads};
        trees.push_back({peer.get(), options, peer->Attach(scene, options)});
        trees.back().scene->Build();
      }
    }
  }
  return trees;
}

const PeerScene& RobustScene(const std::vector<PeerTree>& trees) {
  return *std::find_if(trees.begin(), trees.end(), [](const PeerTree& tree) {
            return tree.options.robust && !tree.options.high_quality;
          })->scene;
}

class Comparison {
 public:
  explicit Comparison(const Arguments& arguments) : arguments_(arguments), peers_(LoadPeers()) {}

  // Prints the tables of one scene.
  Status Run(const std::string& name, const std::string& source) {
    Say(name + ": building");
    const Result<std::unique_ptr<BuiltScene>> scene = BuildScene(source);
    if (!scene) return scene.error();
    const Scene& geometry = (*scene)->scene;
    if (geometry.triangle_count() == 0 || !geometry.spheres.empty() || !geometry.objects.empty()) {
      return Error{source + ": is not of triangles alone; the peers would trace another scene"};
    }
    if (arguments_.builds) {
      if (Status s = RunBuilds(name, geometry); !s) return s;
    }
    if (!arguments_.cells && !arguments_.hits) return Done{};
    const auto trees = BuildPeerTrees(
        (*scene)->scene, peers_,
        *std::max_element(arguments_.thread_counts.begin(), arguments_.thread_counts.end()));
    std::vector<Cell> cells;
    std::vector<HitRow> hits;
    for (const RaySetSpec& spec : kRaySets) {
      const auto& wanted = arguments_.rays_of;
      if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), spec.name) == wanted.end()) {
        continue;
      }
      Say(name + ": recording " + spec.title);
      const Result<RaySet> set = RecordRays(**scene, spec, arguments_.rays);
      if (!set) {
        Say(name + ": " + set.error().message);
        continue;
      }
      if (arguments_.hits) RunHits(name, **scene, *set, RobustScene(trees), hits);
      if (arguments_.cells) RunCells(name, **scene, *set, trees, cells);
    }
    if (!cells.empty()) Print("Millions of rays a second", CellTable(cells));
    if (!cells.empty()) Print("Hardware events per ray", CounterTable(cells));
    if (!hits.empty()) Print("Hits that differ from the peer's robust mode", HitTable(hits));
    figures_.cells.insert(figures_.cells.end(), cells.begin(), cells.end());
    figures_.hits.insert(figures_.hits.end(), hits.begin(), hits.end());
    return Done{};
  }

  const Figures& figures() const { return figures_; }
  std::string PeerNames() const {
    std::string names;
    for (const auto& peer : peers_) names += (names.empty() ? "" : ", ") + peer->name();
    return names;
  }

 private:
  Status RunBuilds(const std::string& name, const Scene& scene) {
    std::vector<BuildRow> rows;
    for (uint32_t threads : arguments_.thread_counts) {
      Say(name + ": timing builds, " + std::to_string(threads) + " threads");
      const uint32_t repetitions = std::min(arguments_.repetitions, 5u);
      Result<BuildRow> row = MeasureBuilds(name, scene, *peers_[0], threads, repetitions);
      if (!row) return row.error();
      rows.push_back(std::move(*row));
    }
    Print("Builds", BuildTable(rows));
    figures_.builds.insert(figures_.builds.end(), rows.begin(), rows.end());
    return Done{};
  }

  void RunHits(const std::string& name, const BuiltScene& scene, const RaySet& set,
               const PeerScene& robust, std::vector<HitRow>& hits) {
    Say(name + ": comparing hits of " + set.spec->title);
    hits.push_back({name, set.spec, CompareHits(scene.scene, set, scene.bvh, robust)});
    const Differences& differences = hits.back().differences;
    if (!differences.example.empty()) Say("  for example: " + differences.example);
  }

  void RunCells(const std::string& name, const BuiltScene& scene, const RaySet& set,
                const std::vector<PeerTree>& trees, std::vector<Cell>& cells) {
    Say(name + ": trying the interfaces on " + set.spec->title);
    const Shortlist engines = ChooseEngines(set, scene.bvh, trees, arguments_.cpu_time);
    for (uint32_t threads : arguments_.thread_counts) {
      Say(name + ": timing " + set.spec->title + ", " + std::to_string(threads) + " threads");
      CellOptions options{threads, arguments_.repetitions, arguments_.cpu_time};
      if (arguments_.quick) options.pass_seconds = 0;
      cells.push_back(MeasureCell(name, set, engines, options));
    }
  }

  const Arguments& arguments_;
  const std::vector<std::unique_ptr<Peer>> peers_;
  Figures figures_;
};

// The last line; what the program's exit code says.
bool Judge(const Arguments& arguments, const Figures& figures) {
  uint64_t counted = 0, reached = 0, unexplained = 0;
  for (const Cell& cell : figures.cells) {
    counted += cell.target.has_value();
    reached += cell.at_target();
  }
  for (const HitRow& row : figures.hits) {
    unexplained += row.differences.other + row.differences.traversals_differ;
  }
  if (arguments.quick) {
    std::printf("traversal: %llu unexplained differences of hits\n",
                static_cast<unsigned long long>(unexplained));
    return unexplained == 0 && !figures.hits.empty();
  }
  std::printf("traversal: %llu of %llu cells at target\n", static_cast<unsigned long long>(reached),
              static_cast<unsigned long long>(counted));
  return reached == counted;
}

Result<bool> RunAll(Arguments arguments) {
  if (Status s = SelectIsa(arguments.isa); !s) return s.error();
  if (arguments.quick) {
    arguments.scenes = {"cornell", "small-pillars"};
    arguments.rays = std::min(arguments.rays, 1u << 13);
    arguments.thread_counts = {2};
    arguments.repetitions = 1;
  }
  Comparison comparison(arguments);
  for (const std::string& name : arguments.scenes) {
    if (Status s = comparison.Run(name, name); !s) return s.error();
  }
  if (!arguments.data_folder.empty()) {
    for (const auto& [name, path] : DataScenes(arguments.data_folder)) {
      if (Status s = comparison.Run(name, path); !s) Say("left out: " + s.error().message);
    }
  }
  if (!arguments.json_file.empty()) {
    std::ofstream file(arguments.json_file);
    file << ToJson(comparison.figures());
    if (!file.flush()) return Error{arguments.json_file + ": cannot be written"};
  }
  const Machine machine = DescribeMachine(Width::kWide);
  std::printf("%s, %s, %u threads, %s; %s; %u repetitions%s\n",
              machine.cpu.value_or("unknown CPU").c_str(), machine.isa.c_str(), machine.threads,
              machine.compiler.c_str(), comparison.PeerNames().c_str(), arguments.repetitions,
              arguments.cpu_time ? ", by CPU time" : "");
  if (!AnyCounted(comparison.figures().cells)) {
    std::printf("hardware events: this machine does not count them\n");
  }
  return Judge(arguments, comparison.figures());
}

}  // namespace
}  // namespace swell::bench

int main(int argc, char** argv) {
  using namespace swell::bench;
  Arguments arguments;
  CLI::App app("Traces the same recorded rays with swell and with Embree, in alternation.");
  std::vector<std::string> names;
  for (const RaySetSpec& spec : kRaySets) names.push_back(spec.name);
  std::vector<std::string> isas = swell::UsableIsaNames();
  isas.insert(isas.begin(), "auto");
  app.add_option("--scenes", arguments.scenes,
                 "cornell, pillars, valley-1m, valley-4m (the counted ones), small-pillars, room, "
                 "bigmesh or scene files")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--rays-of", arguments.rays_of, "kinds of rays; all")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--threads", arguments.thread_counts, "numbers of threads")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--rays", arguments.rays, "rays of each kind")
      ->check(CLI::Range(1u, 1u << 26))
      ->capture_default_str();
  app.add_option("--reps", arguments.repetitions, "repetitions of each engine")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--data", arguments.data_folder,
                 "folder with scans; extra rows that are not counted");
  app.add_option("--json", arguments.json_file, "also write all figures to this file");
  app.add_option("--isa", arguments.isa, "instruction set of swell's kernels")
      ->check(CLI::IsMember(isas))
      ->capture_default_str();
  app.add_flag("--cpu-time", arguments.cpu_time,
               "time by the threads' CPU clocks: for tuning on a machine that is not idle");
  app.add_flag("--quick", arguments.quick, "a smoke test: two small scenes, equal hits asserted");
  app.add_flag("!--no-builds", arguments.builds, "leave out the timing of builds");
  app.add_flag("!--no-cells", arguments.cells, "leave out the timing of rays");
  app.add_flag("!--no-hits", arguments.hits, "leave out the comparison of hits");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = app.exit(error) == 0;
    return is_help ? 0 : 2;
  }
  const swell::Result<bool> reached = RunAll(arguments);
  if (reached) return *reached ? 0 : 1;
  std::fprintf(stderr, "swell_bench_traversal: %s\n", reached.error().message.c_str());
  return 1;
}
