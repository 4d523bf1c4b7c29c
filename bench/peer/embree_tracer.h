// The peer: a straightforward path tracer on Embree, one ray at a time, scalar shading, TBB over
// tiles. A scene in, an image out.
#ifndef SWELL_BENCH_PEER_EMBREE_TRACER_H_
#define SWELL_BENCH_PEER_EMBREE_TRACER_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/peer/bsdf.h"
#include "src/base/result.h"
#include "src/film/film.h"
#include "src/scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace swell::bench {

struct PeerOptions {
  uint32_t width = 0, height = 0;
  uint32_t samples_per_pixel = 1;
  uint32_t thread_count = 1;
  uint32_t seed = 0;
  uint32_t max_depth = 5;
  uint32_t roulette_start = 3;
};

struct PeerImage {
  Image image;
  double seconds = 0;  // of the tracing alone
};

class EmbreeTracer {
 public:
  // An error names what the peer cannot render: analytic spheres, unknown materials or lights.
  // Scene and tables must outlive the tracer.
  static Result<std::unique_ptr<EmbreeTracer>> Make(const Scene& scene, const SceneTables& tables);
  ~EmbreeTracer();

  PeerImage Render(const PeerOptions& options) const;

 private:
  struct Surface;
  class Walk;

  EmbreeTracer(const Scene& scene, const SceneTables& tables);

  const Scene& scene_;
  const SceneView view_;
  std::vector<Bsdf> bsdfs_;  // by shape
  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* rtc_scene_ = nullptr;
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_EMBREE_TRACER_H_
