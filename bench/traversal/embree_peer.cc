// swell's columns of rays in, Embree's hits of them out: single rays, packets and streams.
#include <immintrin.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "bench/traversal/embree_calls.h"
#include "bench/traversal/peer.h"

namespace swell::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// As Embree's manual asks of every thread that traces; restored at the end.
class NoDenormals {
 public:
  NoDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  NoDenormals(const NoDenormals&) = delete;
  ~NoDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
};

struct Columns {
  Vec3Fields<In> org, dir;
  const float* t_max;  // null: infinity
  size_t count;
};

// ---------------------------------------------------------------- single rays
RTCRay RayOf(const Columns& in, size_t row) {
  const float t_max = in.t_max == nullptr ? kInfinity : in.t_max[row];
  return {in.org.x[row], in.org.y[row], in.org.z[row], 0.0f, in.dir.x[row], in.dir.y[row],
          in.dir.z[row], 0.0f,          t_max,         ~0u,  /*id=*/0,      /*flags=*/0};
}

RTCRayHit RayHitOf(const Columns& in, size_t row) {
  RTCRayHit hit;
  hit.ray = RayOf(in, row);
  hit.hit.primID = kNoPrim;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return hit;
}

void Keep(const RTCRayHit& hit, const HitsOut& hits, size_t row) {
  hits.t[row] = hit.ray.tfar;
  hits.prim[row] = hit.hit.primID;
  hits.u[row] = hit.hit.u;
  hits.v[row] = hit.hit.v;
  hits.instance[row] = kNone;
}

// Where a path's radiance goes if its ray is free.
struct Gain {
  const ShadowRaysIn& rays;
  const RgbFields<Out>& radiance;

  void operator()(size_t row, float t_far) const {
    if (t_far < 0.0f) return;
    const uint32_t path = rays.path[row];
    radiance.r[path] += rays.radiance.r[row];
    radiance.g[path] += rays.radiance.g[row];
    radiance.b[path] += rays.radiance.b[row];
  }
};

void IntersectSingle(RTCScene scene, Query& query, const Columns& in, const HitsOut& hits) {
  for (size_t row = 0; row < in.count; ++row) {
    RTCRayHit hit = RayHitOf(in, row);
    Packet<1>::Intersect(nullptr, scene, query, &hit);
    Keep(hit, hits, row);
  }
}

void OccludeSingle(RTCScene scene, Query& query, const Columns& in, const Gain& gain) {
  for (size_t row = 0; row < in.count; ++row) {
    RTCRay ray = RayOf(in, row);
    Packet<1>::Occlude(nullptr, scene, query, &ray);
    gain(row, ray.tfar);
  }
}

// ---------------------------------------------------------------- packets
template <int N> struct alignas(64) Valid {
  Valid(size_t rows) {
    for (int i = 0; i < N; ++i) lanes[i] = static_cast<size_t>(i) < rows ? -1 : 0;
  }
  int lanes[N];
};

template <int N, class T> void Fill(T (&lanes)[N], T value) {
  for (T& lane : lanes) lane = value;
}

template <int N> void Read(const Columns& in, size_t row, typename Packet<N>::Ray& ray) {
  std::memcpy(ray.org_x, in.org.x + row, sizeof(ray.org_x));
  std::memcpy(ray.org_y, in.org.y + row, sizeof(ray.org_y));
  std::memcpy(ray.org_z, in.org.z + row, sizeof(ray.org_z));
  std::memcpy(ray.dir_x, in.dir.x + row, sizeof(ray.dir_x));
  std::memcpy(ray.dir_y, in.dir.y + row, sizeof(ray.dir_y));
  std::memcpy(ray.dir_z, in.dir.z + row, sizeof(ray.dir_z));
  Fill<N>(ray.tnear, 0.0f);
  Fill<N>(ray.time, 0.0f);
  Fill<N>(ray.mask, ~0u);
  Fill<N>(ray.id, 0u);
  Fill<N>(ray.flags, 0u);
  if (in.t_max == nullptr) {
    Fill<N>(ray.tfar, kInfinity);
  } else {
    std::memcpy(ray.tfar, in.t_max + row, sizeof(ray.tfar));
  }
}

template <int N>
void IntersectPackets(RTCScene scene, Query& query, const Columns& in, const HitsOut& hits) {
  for (size_t row = 0; row < in.count; row += N) {
    const Valid<N> valid(in.count - row);
    typename Packet<N>::RayHit packet;
    Read<N>(in, row, packet.ray);
    Fill<N>(packet.hit.primID, kNoPrim);
    Fill<N>(packet.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    Fill<N>(packet.hit.instID[0], RTC_INVALID_GEOMETRY_ID);
    Packet<N>::Intersect(valid.lanes, scene, query, &packet);
    std::memcpy(hits.t + row, packet.ray.tfar, sizeof(packet.ray.tfar));
    std::memcpy(hits.prim + row, packet.hit.primID, sizeof(packet.hit.primID));
    std::memcpy(hits.u + row, packet.hit.u, sizeof(packet.hit.u));
    std::memcpy(hits.v + row, packet.hit.v, sizeof(packet.hit.v));
  }
}

template <int N>
void OccludePackets(RTCScene scene, Query& query, const Columns& in, const Gain& gain) {
  for (size_t row = 0; row < in.count; row += N) {
    const Valid<N> valid(in.count - row);
    typename Packet<N>::Ray packet;
    Read<N>(in, row, packet);
    Packet<N>::Occlude(valid.lanes, scene, query, &packet);
    for (size_t i = 0; i < N && row + i < in.count; ++i) gain(row + i, packet.tfar[i]);
  }
}

// ---------------------------------------------------------------- streams
#if SWELL_EMBREE_MAJOR == 3
constexpr size_t kStreamRows = 256;  // of records; these stay in the L1 cache

void IntersectStream(RTCScene scene, Query& query, const Columns& in, const HitsOut& hits) {
  for (size_t first = 0; first < in.count; first += kStreamRows) {
    const size_t rows = std::min(kStreamRows, in.count - first);
    RTCRayHit stream[kStreamRows];
    for (size_t i = 0; i < rows; ++i) stream[i] = RayHitOf(in, first + i);
    rtcIntersect1M(scene, &query.context, stream, static_cast<unsigned>(rows), sizeof(RTCRayHit));
    for (size_t i = 0; i < rows; ++i) Keep(stream[i], hits, first + i);
  }
}

void OccludeStream(RTCScene scene, Query& query, const Columns& in, const Gain& gain) {
  for (size_t first = 0; first < in.count; first += kStreamRows) {
    const size_t rows = std::min(kStreamRows, in.count - first);
    RTCRay stream[kStreamRows];
    for (size_t i = 0; i < rows; ++i) stream[i] = RayOf(in, first + i);
    rtcOccluded1M(scene, &query.context, stream, static_cast<unsigned>(rows), sizeof(RTCRay));
    for (size_t i = 0; i < rows; ++i) gain(first + i, stream[i].tfar);
  }
}

constexpr size_t kColumnRows = 1024;

// The columns that Embree wants beyond swell's.
struct alignas(64) Scratch {
  float t_far[kColumnRows];
  float normal[3][kColumnRows];
  unsigned geometry[kColumnRows], instance[kColumnRows];
};

struct alignas(64) Constants {
  float zero[kColumnRows] = {};
  unsigned none[kColumnRows] = {};
  unsigned mask[kColumnRows];
  Constants() { std::memset(mask, 0xFF, sizeof(mask)); }
};

float* Mutable(const float* column) { return const_cast<float*>(column); }

// Embree's structure wants pointers to what it only reads.
RTCRayNp RaysOf(const Columns& in, size_t first, Constants& constants, float* t_far) {
  RTCRayNp rays;
  rays.org_x = Mutable(in.org.x + first);
  rays.org_y = Mutable(in.org.y + first);
  rays.org_z = Mutable(in.org.z + first);
  rays.dir_x = Mutable(in.dir.x + first);
  rays.dir_y = Mutable(in.dir.y + first);
  rays.dir_z = Mutable(in.dir.z + first);
  rays.tnear = rays.time = constants.zero;
  rays.tfar = t_far;
  rays.mask = constants.mask;
  rays.id = rays.flags = constants.none;
  return rays;
}

void IntersectColumns(RTCScene scene, Query& query, const Columns& in, const HitsOut& hits) {
  static Constants constants;
  static thread_local Scratch scratch;
  for (size_t first = 0; first < in.count; first += kColumnRows) {
    const size_t rows = std::min(kColumnRows, in.count - first);
    RTCRayHitNp stream;
    stream.ray = RaysOf(in, first, constants, hits.t + first);
    stream.hit.Ng_x = scratch.normal[0];
    stream.hit.Ng_y = scratch.normal[1];
    stream.hit.Ng_z = scratch.normal[2];
    stream.hit.u = hits.u + first;
    stream.hit.v = hits.v + first;
    stream.hit.primID = hits.prim + first;
    stream.hit.geomID = scratch.geometry;
    stream.hit.instID[0] = scratch.instance;
    std::fill_n(hits.t + first, rows, kInfinity);
    std::fill_n(hits.prim + first, rows, kNoPrim);
    std::fill_n(scratch.geometry, rows, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(scratch.instance, rows, RTC_INVALID_GEOMETRY_ID);
    rtcIntersectNp(scene, &query.context, &stream, static_cast<unsigned>(rows));
  }
}

void OccludeColumns(RTCScene scene, Query& query, const Columns& in, const Gain& gain) {
  static Constants constants;
  static thread_local Scratch scratch;
  for (size_t first = 0; first < in.count; first += kColumnRows) {
    const size_t rows = std::min(kColumnRows, in.count - first);
    std::memcpy(scratch.t_far, in.t_max + first, rows * sizeof(float));
    const RTCRayNp stream = RaysOf(in, first, constants, scratch.t_far);
    rtcOccludedNp(scene, &query.context, &stream, static_cast<unsigned>(rows));
    for (size_t i = 0; i < rows; ++i) gain(first + i, scratch.t_far[i]);
  }
}
#endif

// ---------------------------------------------------------------- ways
struct Way {
  const char* name;
  bool coherent;
  void (*intersect)(RTCScene, Query&, const Columns&, const HitsOut&);
  void (*occlude)(RTCScene, Query&, const Columns&, const Gain&);
};

constexpr Way kWays[] = {
    {"single", false, IntersectSingle, OccludeSingle},
    {"packet of 4", false, IntersectPackets<4>, OccludePackets<4>},
    {"packet of 8", false, IntersectPackets<8>, OccludePackets<8>},
    {"packet of 16", false, IntersectPackets<16>, OccludePackets<16>},
    {"coherent packet of 4", true, IntersectPackets<4>, OccludePackets<4>},
    {"coherent packet of 8", true, IntersectPackets<8>, OccludePackets<8>},
    {"coherent packet of 16", true, IntersectPackets<16>, OccludePackets<16>},
#if SWELL_EMBREE_MAJOR == 3
    {"stream", false, IntersectStream, OccludeStream},
    {"coherent stream", true, IntersectStream, OccludeStream},
    {"stream of columns", false, IntersectColumns, OccludeColumns},
    {"coherent stream of columns", true, IntersectColumns, OccludeColumns},
#endif
};

class EmbreeScene : public PeerScene {
 public:
  EmbreeScene(const Scene& scene, const PeerSceneOptions& options) {
    const std::string config = "threads=" + std::to_string(options.build_threads);
    device_ = rtcNewDevice(config.c_str());
    rtcSetDeviceMemoryMonitorFunction(device_, Count, this);
    scene_ = AttachTriangles(device_, scene);
    rtcSetSceneFlags(scene_, options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(
        scene_, options.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  ~EmbreeScene() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void Build() override {
    const int64_t before = bytes_;
    peak_ = before;
    rtcCommitScene(scene_);
    built_ = {bytes_ - before, peak_ - before};
  }
  PeerBytes bytes() const override { return built_; }

  void Intersect(size_t way, const Vec3Fields<In>& org, const Vec3Fields<In>& dir,
                 const HitsOut& hits, size_t count) const override {
    const NoDenormals no_denormals;
    Query query(kWays[way].coherent);
    kWays[way].intersect(scene_, query, {org, dir, nullptr, count}, hits);
  }

  void Occlude(size_t way, const ShadowRaysIn& rays, const RgbFields<Out>& radiance,
               size_t count) const override {
    const NoDenormals no_denormals;
    Query query(kWays[way].coherent);
    kWays[way].occlude(scene_, query, {rays.org, rays.dir, rays.t_max, count}, {rays, radiance});
  }

 private:
  static bool Count(void* self, ssize_t bytes, bool /*post*/) {
    auto& scene = *static_cast<EmbreeScene*>(self);
    const int64_t now = scene.bytes_ += bytes;
    int64_t peak = scene.peak_;
    while (now > peak && !scene.peak_.compare_exchange_weak(peak, now)) continue;
    return true;
  }

  RTCDevice device_;
  RTCScene scene_;
  std::atomic<int64_t> bytes_{0}, peak_{0};
  PeerBytes built_;
};

class EmbreePeer : public Peer {
 public:
  EmbreePeer() {
    for (const Way& way : kWays) ways_.push_back(way.name);
  }
  std::string name() const override { return "Embree " RTC_VERSION_STRING; }
  const std::vector<std::string>& ways() const override { return ways_; }
  std::unique_ptr<PeerScene> Attach(const Scene& scene,
                                    const PeerSceneOptions& options) const override {
    return std::make_unique<EmbreeScene>(scene, options);
  }

 private:
  std::vector<std::string> ways_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Peer* SwellMakePeer() { return new EmbreePeer; }

}  // namespace swell::bench
