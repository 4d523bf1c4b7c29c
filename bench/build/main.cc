// swell_bench_build: names of scenes in; speed, cost and memory of swell's tree beside Embree's
// out.
#include <CLI/CLI.hpp>
#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/build/embree_cost.h"
#include "bench/embree_geometry.h"
#include "bench/scenes.h"
#include "bench/spread.h"
#include "src/bvh/expected_cost.h"
#include "src/stats/peak_rise.h"

namespace swell::bench {
namespace {

constexpr double kMostBytes = 75.0;         // per triangle, with everything traversal needs
constexpr double kMostPeak = 3.0;           // times the memory of vertices and indices
constexpr size_t kPeakTriangles = 3000000;  // scenes from this size on have that target
constexpr int kRepetitions = 10;

struct Score {
  int met = 0, of = 0;
  const char* Note(bool holds) {
    ++of;
    met += holds;
    return holds ? "yes" : "NO";
  }
};

double Seconds(const std::function<void()>& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Ratios of primitives per second, swell's over Embree's, each pair in alternation.
Spread BuildRatio(const Scene& scene, int threads, RTCBuildQuality quality) {
  const RTCDevice device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  tbb::task_arena arena(threads);
  std::vector<double> ratios;
  for (int i = 0; i <= kRepetitions; ++i) {
    double swell = 0;
    const auto build_swell = [&] {
      Result<Bvh> bvh = Bvh();
      swell = Seconds([&] { arena.execute([&] { bvh = BuildBvh(scene); }); });
    };
    if (i % 2 == 0) build_swell();
    const RTCScene peer = AttachTriangles(device, scene);
    rtcSetSceneBuildQuality(peer, quality);
    const double embree = Seconds([&] { rtcCommitScene(peer); });
    rtcReleaseScene(peer);
    if (i % 2 == 1) build_swell();
    if (i > 0) ratios.push_back(embree / swell);  // the first one warms up
  }
  rtcReleaseDevice(device);
  return SpreadOf(ratios);
}

void PrintCost(const char* name, const ExpectedCost& cost, size_t triangles) {
  std::printf("  %-14s cost %7.2f = %6.2f nodes + %6.2f blocks; %.3f references a triangle\n", name,
              cost.Total(kBlockCost), cost.nodes, cost.blocks,
              static_cast<double>(cost.reference_count) / static_cast<double>(triangles));
}

void MeasureScene(const std::string& name, const Scene& scene, Score& score) {
  const size_t triangles = scene.triangle_count();
  std::printf("%s, %zu triangles\n", name.c_str(), triangles);
  Result<Bvh> bvh = Bvh();
  const std::optional<int64_t> peak = PeakRise([&] { bvh = BuildBvh(scene); });
  if (!bvh) return;
  const std::string wrong = ValidateBvh(*bvh, scene);
  std::printf("  validated: %s%s%s\n", score.Note(wrong.empty()), wrong.empty() ? "" : ": ",
              wrong.c_str());
  const ExpectedCost own = FindExpectedCost(*bvh);
  const RTCDevice device = rtcNewDevice(nullptr);
  const ExpectedCost medium = FindEmbreeCost(device, scene, RTC_BUILD_QUALITY_MEDIUM);
  const ExpectedCost high = FindEmbreeCost(device, scene, RTC_BUILD_QUALITY_HIGH);
  rtcReleaseDevice(device);
  PrintCost("swell", own, triangles);
  PrintCost("Embree medium", medium, triangles);
  PrintCost("Embree high", high, triangles);

  // Where swell cuts triangles its equal is the quality that does, too.
  const bool cuts = own.reference_count > triangles + triangles / 10;
  const ExpectedCost& peer = cuts ? high : medium;
  const bool is_equal = own.Total(kBlockCost) <= peer.Total(kBlockCost);
  for (const int threads : {1, 2}) {
    const Spread ratio =
        BuildRatio(scene, threads, cuts ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    std::printf(
        "  %d thread%s: %.2f times Embree %s's primitives a second (%.2f to %.2f); at least "
        "1 at no higher cost: %s\n",
        threads, threads == 1 ? "" : "s", ratio.median, cuts ? "high" : "medium", ratio.lower,
        ratio.upper, score.Note(is_equal && ratio.median >= 1.0));
  }
  const double bytes = static_cast<double>(bvh->bytes()) / static_cast<double>(triangles);
  std::printf("  %.1f bytes a triangle; at most %.0f: %s\n", bytes, kMostBytes,
              score.Note(bytes <= kMostBytes));
  const double mesh = static_cast<double>(scene.positions.size() * sizeof(float) +
                                          scene.indices.size() * sizeof(uint32_t));
  // Unknown is at no target.
  const double of_mesh = peak ? static_cast<double>(*peak) / mesh : NAN;
  std::printf("  peak %.2f times vertices and indices", of_mesh);
  if (triangles >= kPeakTriangles) {
    std::printf("; at most %.0f: %s", kMostPeak, score.Note(of_mesh <= kMostPeak));
  }
  std::printf("\n");
}

int Run(const std::vector<std::string>& names) {
  Score score;
  for (const std::string& name : names) {
    const Result<Scene> scene = MakeScene(name);
    if (!scene) {
      std::fprintf(stderr, "swell_bench_build: %s\n", scene.error().message.c_str());
      return 1;
    }
    MeasureScene(name, *scene, score);
  }
  std::printf("build: %d of %d at target\n", score.met, score.of);
  return score.met == score.of ? 0 : 1;
}

}  // namespace
}  // namespace swell::bench

int main(int argc, char** argv) {
  CLI::App app("Builds trees with swell and with Embree, in alternation.");
  std::vector<std::string> names = {"cornell", "pillars", "valley-1m", "valley-4m", "room"};
  app.add_option("scenes", names, "names of scenes or scene files")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return swell::bench::Run(names);
}
