// swell_watertight: sends many rays through the edges and vertices of closed meshes and counts
// those that slip through.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "src/stats/isa.h"
#include "tests/bvh/watertight.h"

namespace swell::test {
namespace {

struct Arguments {
  uint64_t rays = 100'000'000;
  uint32_t threads = 2;
  uint32_t detail = 4;
  std::string isa = "auto";
  std::vector<std::string> traversals = {"auto", "packet", "single"};
  bool one_lane = false;
};

// Batch i has the rays of seed i, so that the threads do not matter.
Slips CountAll(const ClosedSurface& surface, const Bvh& bvh, const Arguments& arguments,
               uint64_t batches) {
  constexpr size_t kBatch = 4096;
  const Width width = arguments.one_lane ? Width::kOneLane : Width::kWide;
  std::vector<NamedTraversal> traversals;
  for (const NamedTraversal& named : kAllTraversals) {
    const auto& wanted = arguments.traversals;
    if (std::count(wanted.begin(), wanted.end(), named.name) > 0) traversals.push_back(named);
  }
  std::atomic<uint64_t> next{0};
  std::vector<Slips> slips(arguments.threads);
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < arguments.threads; ++i) {
    threads.emplace_back([&, i] {
      for (uint64_t batch = next++; batch < batches; batch = next++) {
        const SurfaceRays rays =
            RaysThroughEdges(surface, kBatch, static_cast<uint32_t>(1000 + batch));
        slips[i].Add(CountSlips(surface, bvh, width, rays, traversals));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  Slips all;
  for (const Slips& some : slips) all.Add(some);
  return all;
}

Result<uint64_t> Run(const Arguments& arguments) {
  if (Status s = SelectIsa(arguments.isa); !s) return s.error();
  const std::vector<ClosedSurface> surfaces = ClosedSurfaces(arguments.detail);
  const uint64_t batches = (arguments.rays / surfaces.size() + 4095) / 4096;
  Slips all;
  for (const ClosedSurface& surface : surfaces) {
    const Result<Bvh> bvh = BuildBvh(surface.scene);
    if (!bvh) return bvh.error();
    const Slips slips = CountAll(surface, *bvh, arguments, batches);
    std::printf("%-10s %9zu triangles %12llu rays %8llu slipped %s\n", surface.name.c_str(),
                surface.scene.triangle_count(), static_cast<unsigned long long>(slips.rays),
                static_cast<unsigned long long>(slips.slipped), slips.example.c_str());
    std::fflush(stdout);
    all.Add(slips);
  }
  std::printf("watertight: %llu of %llu rays slipped through (%s, %zu traversals)\n",
              static_cast<unsigned long long>(all.slipped),
              static_cast<unsigned long long>(all.rays),
              IsaInUse(arguments.one_lane ? Width::kOneLane : Width::kWide).name,
              arguments.traversals.size());
  return all.slipped;
}

}  // namespace
}  // namespace swell::test

int main(int argc, char** argv) {
  using namespace swell::test;
  Arguments arguments;
  CLI::App app("Counts rays that slip through the edges and vertices of closed meshes.");
  app.add_option("--rays", arguments.rays,
                 "rays in all; each by every traversal, closest and any hit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--nthreads", arguments.threads, "threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--detail", arguments.detail, "of the meshes: triangles grow with its square")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  app.add_option("--traversal", arguments.traversals, "ways to trace them")
      ->delimiter(',')
      ->check(CLI::IsMember({"auto", "packet", "single"}))
      ->capture_default_str();
  app.add_option("--isa", arguments.isa, "instruction set of the kernels")->capture_default_str();
  app.add_flag("--one-lane", arguments.one_lane, "the kernels of --engine megakernel");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = app.exit(error) == 0;
    return is_help ? 0 : 2;
  }
  const swell::Result<uint64_t> slipped = Run(arguments);
  if (slipped) return *slipped == 0 ? 0 : 1;
  std::fprintf(stderr, "swell_watertight: %s\n", slipped.error().message.c_str());
  return 1;
}
