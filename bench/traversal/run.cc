// Waves of recorded rays in, the time that an engine takes for them out.
#include "bench/traversal/run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "kernels/intersect_rays.h"
#include "kernels/occlude_rays.h"
#include "src/stages/stages.h"

namespace swell::bench {

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

Pass TimePass(const Engine& engine, size_t rows, uint32_t threads, size_t stride) {
  std::vector<std::unique_ptr<WaveOutput>> outputs;
  for (uint32_t i = 0; i < threads; ++i) outputs.push_back(std::make_unique<WaveOutput>());
  std::vector<PerfCounts> counts(threads);
  std::atomic<size_t> next{0};
  const auto work = [&](uint32_t worker) {
    PerfCounters counters;
    const HitsOut hits = outputs[worker]->hits.Columns();
    const RgbFields<Out> radiance = outputs[worker]->paths.Columns().radiance;
    counters.Start();
    while (true) {
      const size_t first = next.fetch_add(1) * stride * kMostRows;
      if (first >= rows) break;
      engine.trace(first, std::min<size_t>(kMostRows, rows - first), hits, radiance);
    }
    counts[worker] = counters.Stop();
  };

  const auto start = std::chrono::steady_clock::now();
  std::vector<std::thread> others;
  for (uint32_t i = 1; i < threads; ++i) others.emplace_back(work, i);
  work(0);
  for (std::thread& other : others) other.join();
  Pass pass;
  pass.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pass.counts = counts[0];
  for (uint32_t i = 1; i < threads; ++i) pass.counts = pass.counts + counts[i];
  return pass;
}

}  // namespace swell::bench
