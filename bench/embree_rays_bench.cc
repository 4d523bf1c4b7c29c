// Measures Embree's rtcIntersect1 and rtcOccluded1 on the same recorded rays, from and to the same
// columns: what IntersectRays and OccludeRays are to be compared with.
#include <embree3/rtcore.h>

#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "bench/embree_geometry.h"
#include "bench/cases.h"

namespace swell::bench {
namespace {

// All triangles of a scene as one geometry.
class EmbreeScene {
 public:
  explicit EmbreeScene(const Scene& scene) : device_(rtcNewDevice(nullptr)) {
    scene_ = MakeEmbreeScene(device_, scene);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RTCScene get() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

RTCScene EmbreeOf(const BuiltScene& scene) {
  static std::map<const BuiltScene*, std::unique_ptr<EmbreeScene>> kept;
  std::unique_ptr<EmbreeScene>& entry = kept[&scene];
  if (!entry) entry = std::make_unique<EmbreeScene>(scene.scene);
  return entry->get();
}

RTCRay RayOf(const Vec3Fields<In>& org, const Vec3Fields<In>& dir, float t_max, size_t row) {
  return {org.x[row], org.y[row], org.z[row], 0.0f, dir.x[row], dir.y[row],
          dir.z[row], 0.0f,       t_max,      ~0u,  /*id=*/0,   /*flags=*/0};
}

void Intersect(benchmark::State& state, const WaveSource& source) {
  const RayWave& wave = RaysOf(source);
  const RTCScene scene = EmbreeOf(*wave.scene);
  const RaysIn rays = wave.rays.ReadColumns();
  Table<HitFields> table(wave.rows);
  const HitsOut hits = table.Columns();
  for (auto _ : state) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t row = 0; row < wave.rows; ++row) {
      RTCRayHit hit;
      hit.ray = RayOf(rays.org, rays.dir, std::numeric_limits<float>::infinity(), row);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      hit.hit.primID = kNoPrim;
      hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &hit);
      hits.t[row] = hit.ray.tfar;
      hits.prim[row] = hit.hit.primID;
      hits.u[row] = hit.hit.u;
      hits.v[row] = hit.hit.v;
      hits.instance[row] = kNone;
    }
    benchmark::ClobberMemory();
  }
  ReportRows(state, Width::kOneLane, wave.rows);
}

void Occlude(benchmark::State& state, const WaveSource& source) {
  const ShadowWave& wave = ShadowRaysOf(source);
  const RTCScene scene = EmbreeOf(*wave.scene);
  const ShadowRaysIn rays = wave.shadow_rays.ReadColumns();
  Table<PathFields> table(wave.rows);
  const RgbFields<Out> radiance = table.Columns().radiance;
  for (auto _ : state) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t row = 0; row < wave.rows; ++row) {
      RTCRay ray = RayOf(rays.org, rays.dir, rays.t_max[row], row);
      rtcOccluded1(scene, &context, &ray);
      if (ray.tfar < 0.0f) continue;
      radiance.r[rays.path[row]] += rays.radiance.r[row];
      radiance.g[rays.path[row]] += rays.radiance.g[row];
      radiance.b[rays.path[row]] += rays.radiance.b[row];
    }
    benchmark::ClobberMemory();
  }
  ReportRows(state, Width::kOneLane, wave.rows);
}

[[maybe_unused]] const bool kIntersectAdded =
    ForEachWave(WaveKind::kRays, [](const WaveSource& source) {
      const std::string name = "IntersectRays/" + source.label + "/embree";
      benchmark::RegisterBenchmark(name.c_str(), Intersect, source);
    });
[[maybe_unused]] const bool kOccludeAdded =
    ForEachWave(WaveKind::kShadowRays, [](const WaveSource& source) {
      const std::string name = "OccludeRays/" + source.label + "/embree";
      benchmark::RegisterBenchmark(name.c_str(), Occlude, source);
    });

}  // namespace
}  // namespace swell::bench
