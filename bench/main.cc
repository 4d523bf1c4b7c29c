// swell_bench: kernels on recorded waves; --wave FILE adds cases on a dump of swell render.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "bench/cases.h"
#include "kernels/lane_count.h"
#include "src/stages/wave_recorder.h"
#include "src/stats/isa.h"
#include "src/stats/machine.h"

namespace swell::bench {
namespace {

std::vector<std::pair<WaveKind, AddCases>>& Registered() {
  static std::vector<std::pair<WaveKind, AddCases>> registered;
  return registered;
}

const std::vector<WaveSource>& SourcesOf(WaveKind kind) {
  static const std::vector<WaveSource> rays = {
      {"cornell_camera", "cornell", 0, ""},  {"cornell_bounce1", "cornell", 1, ""},
      {"cornell_bounce3", "cornell", 3, ""}, {"room_camera", "room", 0, ""},
      {"room_bounce1", "room", 1, ""},       {"room_bounce3", "room", 3, ""},
  };
  static const std::vector<WaveSource> escaped = {
      {"bigmesh_camera", "bigmesh", 0, ""},
      {"bigmesh_bounce1", "bigmesh", 1, ""},
  };
  return kind == WaveKind::kEscapedRays ? escaped : rays;
}

WaveSource SourceOfFile(const std::string& path, bool* shadow_rays) {
  const Result<RecordedWave> wave = ReadWave(path);
  if (!wave) {
    std::fprintf(stderr, "swell_bench: %s\n", wave.error().message.c_str());
    std::exit(1);
  }
  *shadow_rays = wave->stage == Stage::kOcclude;
  return {"file", wave->scene, wave->bounce, path};
}

// Takes "--NAME VALUE" or "--NAME=VALUE" out of the arguments; "" if it is not there.
std::string TakeOption(int* argc, char** argv, const std::string& name) {
  for (int i = 1; i < *argc; ++i) {
    const std::string argument = argv[i];
    const bool joined = argument.rfind(name + "=", 0) == 0;
    if (!joined && (argument != name || i + 1 == *argc)) continue;
    const std::string value = joined ? argument.substr(name.size() + 1) : argv[i + 1];
    const int taken = joined ? 1 : 2;
    std::copy(argv + i + taken, argv + *argc + 1, argv + i);
    *argc -= taken;
    return value;
  }
  return "";
}

void AddAll(const std::string& file) {
  bool shadow_rays = false;
  WaveSource of_file;
  if (!file.empty()) of_file = SourceOfFile(file, &shadow_rays);
  for (const auto& [kind, add] : Registered()) {
    for (const WaveSource& source : SourcesOf(kind)) add(source);
    if (!file.empty() && shadow_rays == (kind == WaveKind::kShadowRays)) add(of_file);
  }
}

}  // namespace

bool ForEachWave(WaveKind kind, AddCases add) {
  Registered().emplace_back(kind, add);
  return true;
}

void ReportRows(benchmark::State& state, Width width, size_t rows) {
  const size_t lanes = LaneCount(width);
  Report(state, rows, {rows, (rows + lanes - 1) / lanes * lanes});
}

}  // namespace swell::bench

int main(int argc, char** argv) {
  using namespace swell;
  const std::string isa = bench::TakeOption(&argc, argv, "--isa");
  if (const Status s = SelectIsa(isa.empty() ? "auto" : isa); !s) {
    std::fprintf(stderr, "swell_bench: %s\n", s.error().message.c_str());
    return 2;
  }
  bench::AddAll(bench::TakeOption(&argc, argv, "--wave"));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("isa", IsaInUse(Width::kWide).name);
  benchmark::AddCustomContext("revision", SourceRevision().value_or("unknown"));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
