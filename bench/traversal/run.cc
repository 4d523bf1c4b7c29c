// Waves of recorded rays in, the time that an engine takes for them out.
#include "bench/traversal/run.h"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "kernels/intersect_rays.h"
#include "kernels/occlude_rays.h"
#include "src/stages/stages.h"

namespace swell::bench {
namespace {

double ThreadCpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Engine SwellEngine(const RaySet& set, const Bvh& bvh, Traversal traversal, std::string name) {
  const BvhView view = bvh.view();
  const Table<ShadowRayFields>& rays = set.rays;
  if (set.shadow()) {
    return {std::move(name), [&rays, view, traversal](size_t first, size_t count, const HitsOut&,
                                                      const RgbFields<Out>& radiance) {
              OccludeRays(Width::kWide, view, traversal, rays.ReadColumns(first), radiance, count);
            }};
  }
  // As a render's stage would have it.
  const Traversal chosen = set.spec->bounce == 0 ? CameraTraversal(traversal) : traversal;
  return {std::move(name), [&rays, view, chosen](size_t first, size_t count, const HitsOut& hits,
                                                 const RgbFields<Out>&) {
            const ShadowRaysIn in = rays.ReadColumns(first);
            IntersectRays(Width::kWide, view, chosen, in.org, in.dir, hits, count);
          }};
}

Engine PeerEngine(const RaySet& set, const PeerScene& scene, size_t way, std::string name) {
  const Table<ShadowRayFields>& rays = set.rays;
  if (set.shadow()) {
    return {std::move(name), [&rays, &scene, way](size_t first, size_t count, const HitsOut&,
                                                  const RgbFields<Out>& radiance) {
              scene.Occlude(way, rays.ReadColumns(first), radiance, count);
            }};
  }
  return {std::move(name), [&rays, &scene, way](size_t first, size_t count, const HitsOut& hits,
                                                const RgbFields<Out>&) {
            const ShadowRaysIn in = rays.ReadColumns(first);
            scene.Intersect(way, in.org, in.dir, hits, count);
          }};
}

Pass TimePass(const Engine& engine, size_t rows, uint32_t threads, const PassOptions& options) {
  const size_t wave_rows = kMostRows * options.stride;  // from one wave to the next
  const size_t waves = (rows + wave_rows - 1) / wave_rows;
  const size_t end = waves * options.repeat;
  std::vector<std::unique_ptr<WaveOutput>> outputs;
  for (uint32_t i = 0; i < threads; ++i) outputs.push_back(std::make_unique<WaveOutput>());
  std::vector<PerfCounts> counts(threads);
  std::chrono::steady_clock::time_point start;
  std::atomic<size_t> next{0};
  std::barrier all_ready(threads);
  std::vector<double> cpu_seconds(threads);
  const auto work = [&](uint32_t worker) {
    PerfCounters counters;
    const HitsOut hits = outputs[worker]->hits.Columns();
    const RgbFields<Out> radiance = outputs[worker]->paths.Columns().radiance;
    all_ready.arrive_and_wait();
    if (worker == 0) start = std::chrono::steady_clock::now();
    const double cpu_start = ThreadCpuSeconds();
    counters.Start();
    for (size_t i = next.fetch_add(1); i < end; i = next.fetch_add(1)) {
      const size_t first = i % waves * wave_rows;
      engine.trace(first, std::min<size_t>(kMostRows, rows - first), hits, radiance);
    }
    counts[worker] = counters.Stop();
    cpu_seconds[worker] = ThreadCpuSeconds() - cpu_start;
  };

  std::vector<std::thread> others;
  for (uint32_t i = 1; i < threads; ++i) others.emplace_back(work, i);
  work(0);
  for (std::thread& other : others) other.join();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  Pass pass;
  pass.seconds = elapsed.count();
  if (options.cpu_time) {
    pass.seconds = std::accumulate(cpu_seconds.begin(), cpu_seconds.end(), 0.0) / threads;
  }
  pass.counts = counts[0];
  for (uint32_t i = 1; i < threads; ++i) pass.counts = pass.counts + counts[i];
  return pass;
}

}  // namespace swell::bench
