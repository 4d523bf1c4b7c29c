// Tiles of pixels in, radiance out, by rtcIntersect1 and rtcOccluded1.
#include "bench/peer/embree_tracer.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <string>

#include "bench/embree_geometry.h"
#include "bench/peer/sampling.h"
#include "bench/peer/triangle_light.h"
#include "src/scene/views.h"

namespace swell::bench {
namespace {

constexpr uint32_t kTileSize = 16;  // pixels
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Embree asks for both; denormal numbers are slow. Swell's kernels run on the same threads without.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};

// A camera position on the film, drawn from the pixel filter.
struct FilterDraw {
  float offset, weight;
};
FilterDraw DrawFilter(const Filter& filter, float radius, const std::vector<float>& quantiles,
                      const std::vector<float>& weights, float u) {
  if (filter.type == FilterType::kBox) return {(2.0f * u - 1.0f) * radius, 1.0f};
  const float at = u * kFilterBins;
  const auto bin = static_cast<uint32_t>(at);
  const float low = quantiles[bin];
  return {low + (at - static_cast<float>(bin)) * (quantiles[bin + 1] - low), weights[bin]};
}

Vec3 TransformVector(const float* m, const Vec3& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
          m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

struct Ray {
  Vec3 org, dir;
};

// The way from a film position to a camera ray.
class CameraRays {
 public:
  CameraRays(const Scene& scene, uint32_t width, uint32_t height)
      : camera_(MakeCameraView(scene.camera, width, height)),
        filter_(scene.request.filter),
        tables_(MakeFilterTables(filter_)) {}

  Ray Make(uint32_t x, uint32_t y, Random& random, float* weight) const {
    const FilterDraw fx =
        DrawFilter(filter_, filter_.radius_x, tables_.quantiles_x, tables_.weight_x, random.Next());
    const FilterDraw fy =
        DrawFilter(filter_, filter_.radius_y, tables_.quantiles_y, tables_.weight_y, random.Next());
    *weight = fx.weight * fy.weight;
    const float* raster = camera_.raster_to_screen;
    const float px = static_cast<float>(x) + 0.5f + fx.offset;
    const float py = static_cast<float>(y) + 0.5f + fy.offset;
    const Vec3 screen = {px * raster[0] + raster[1], py * raster[2] + raster[3], 1.0f};
    const bool perspective = camera_.type == CameraType::kPerspective;
    Vec3 org = perspective ? Vec3{} : Vec3{screen.x, screen.y, 0.0f};
    Vec3 dir = perspective ? screen : Vec3{0.0f, 0.0f, 1.0f};
    if (camera_.lens_radius > 0.0f) {
      const Vec3 focus = org + camera_.focal_distance * dir;
      const float u0 = random.Next(), u1 = random.Next();
      const Vec3 lens = CosineHemisphere(u0, u1);
      org = org + Vec3{camera_.lens_radius * lens.x, camera_.lens_radius * lens.y, 0.0f};
      dir = focus - org;
    }
    const float* m = camera_.camera_to_world;
    return {TransformVector(m, org) + Vec3{m[3], m[7], m[11]}, Normalize(TransformVector(m, dir))};
  }

 private:
  CameraView camera_;
  Filter filter_;
  FilterTables tables_;
};

RTCRay ToRtc(const Vec3& org, const Vec3& dir, float t_max) {
  RTCRay ray;
  ray.org_x = org.x;
  ray.org_y = org.y;
  ray.org_z = org.z;
  ray.dir_x = dir.x;
  ray.dir_y = dir.y;
  ray.dir_z = dir.z;
  ray.tnear = 0.0f;
  ray.tfar = t_max;
  ray.time = 0.0f;
  ray.mask = 0xFFFFFFFFu;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

}  // namespace

struct EmbreeTracer::Surface {
  Vec3 p;
  Vec3 n;   // geometric, outer side
  Vec3 ns;  // shading
  float offset;

  // Off the surface, to the side of w, by some units of the last place of p.
  Vec3 Leave(const Vec3& w) const { return p + (Dot(n, w) > 0.0f ? offset : -offset) * n; }
};

// One path.
class EmbreeTracer::Walk {
 public:
  Walk(const EmbreeTracer& tracer, const PeerOptions& options, Random& random)
      : tracer_(tracer), view_(tracer.view_), options_(options), random_(random) {}

  Rgb Radiance(Ray ray, float weight) {
    throughput_ = {weight, weight, weight};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (uint32_t bounce = 0;; ++bounce) {
      RTCRayHit hit;
      hit.ray = ToRtc(ray.org, ray.dir, kInfinity);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(tracer_.rtc_scene_, &context, &hit);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        AddBackground();
        return radiance_;
      }
      const uint32_t shape_id = view_.prim_shape[hit.hit.primID];
      const ShapeRecord& shape = view_.shapes[shape_id];
      const Surface surface = MakeSurface(hit, ray, shape);
      if (shape.first_light != kNone) {
        AddEmission(shape.first_light + hit.hit.primID - shape.first_prim, surface, ray,
                    hit.ray.tfar);
      }
      if (bounce == options_.max_depth) return radiance_;

      const Bsdf& bsdf = tracer_.bsdfs_[shape_id];
      const Frame frame(surface.ns);
      const Vec3 wo = frame.ToLocal(-ray.dir);
      if (!bsdf.specular && view_.lights.count != 0) AddLight(bsdf, surface, frame, wo);
      if (!Continue(bsdf, surface, frame, wo, bounce + 1, &ray)) return radiance_;
    }
  }

 private:
  Surface MakeSurface(const RTCRayHit& hit, const Ray& ray, const ShapeRecord& shape) const {
    Surface s;
    s.p = ray.org + hit.ray.tfar * ray.dir;
    s.offset = 32.0f * 0x1p-23f * std::max(MaxAbsComponent(s.p), hit.ray.tfar);
    s.n = Normalize({hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z});
    if ((shape.flags & kShapeFlipNormal) != 0) s.n = -s.n;
    s.ns = s.n;
    if (shape.normal_offset != kNone) {
      const uint32_t* index = view_.indices + 3 * size_t{hit.hit.primID};
      const auto normal = [&](int k) {
        return Load3(view_.normals + 3 * size_t{index[k] + shape.normal_offset});
      };
      const float u = hit.hit.u, v = hit.hit.v;
      s.ns = Normalize((1.0f - u - v) * normal(0) + u * normal(1) + v * normal(2));
      if ((shape.flags & kShapeNormalsOrient) != 0 && Dot(s.n, s.ns) < 0.0f) s.n = -s.n;
    }
    return s;
  }

  void AddBackground() {
    for (uint32_t k = 0; k < view_.lights.infinite_count; ++k) {
      const LightRecord& light = view_.lights.records[view_.lights.infinite[k]];
      const float pdf = light.select_pdf * kInvFourPi;
      const float weight = specular_ ? 1.0f : PowerHeuristic(bsdf_pdf_, pdf);
      radiance_ = radiance_ + weight * (throughput_ * Load3(light.radiance));
    }
  }

  void AddEmission(uint32_t index, const Surface& surface, const Ray& ray, float t) {
    const LightRecord& light = view_.lights.records[index];
    const float cos = -Dot(surface.n, ray.dir);
    if (cos <= 0.0f && (light.flags & kLightTwoSided) == 0) return;
    float weight = 1.0f;
    if (!specular_) {
      const float angle = TriangleView(light, ray.org).solid_angle();
      const float by_place = angle > 0.0f ? 1.0f / angle : t * t / (std::abs(cos) * light.area);
      weight = PowerHeuristic(bsdf_pdf_, by_place * light.select_pdf);
    }
    radiance_ = radiance_ + weight * (throughput_ * Load3(light.radiance));
  }

  const LightRecord& PickLight() {
    const LightsView& lights = view_.lights;
    const float scaled = random_.Next() * static_cast<float>(lights.count);
    const uint32_t slot = std::min(static_cast<uint32_t>(scaled), lights.count - 1);
    const bool keep = scaled - static_cast<float>(slot) < lights.alias_threshold[slot];
    return lights.records[keep ? slot : lights.alias[slot]];
  }

  void AddLight(const Bsdf& bsdf, const Surface& surface, const Frame& frame, const Vec3& wo) {
    const LightRecord& light = PickLight();
    Vec3 to_light;  // ends at the light, or is a direction
    float t_max = 1.0f - 1e-4f;
    float pdf = 1.0f;  // solid angle
    float falloff = 1.0f;
    bool is_delta = false;
    const float u0 = random_.Next(), u1 = random_.Next();
    float angle = 0.0f;
    if (light.type == kTriangleLight) {
      const TriangleView seen(light, surface.p);
      angle = seen.solid_angle();
      to_light = seen.Sample(u0, u1);
    } else if (light.type == kPointLight) {
      to_light = Load3(light.p) - surface.p;
      is_delta = true;
    } else {
      to_light = UniformSphere(u0, u1);
      pdf = kInvFourPi;
      t_max = kInfinity;
    }
    const float distance2 = Dot(to_light, to_light);
    const Vec3 wi = (1.0f / std::sqrt(distance2)) * to_light;
    if (light.type == kTriangleLight) {
      float cos = -Dot(Load3(light.n), wi);
      if ((light.flags & kLightTwoSided) != 0) cos = std::abs(cos);
      if (cos <= 0.0f) return;
      pdf = angle > 0.0f ? 1.0f / angle : distance2 / (cos * light.area);
    } else if (is_delta) {
      falloff = 1.0f / distance2;
    }

    const BsdfValue value = Evaluate(bsdf, wo, frame.ToLocal(wi));
    if (value.pdf <= 0.0f) return;
    pdf *= light.select_pdf;
    const float weight = is_delta ? 1.0f : PowerHeuristic(pdf, value.pdf);
    const Rgb gain =
        (weight * falloff / pdf) * (throughput_ * (value.value * Load3(light.radiance)));
    if (MaxAbsComponent(gain) == 0.0f) return;
    RTCRay shadow = ToRtc(surface.Leave(wi), to_light, t_max);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(tracer_.rtc_scene_, &context, &shadow);
    if (shadow.tfar >= 0.0f) radiance_ = radiance_ + gain;
  }

  bool Continue(const Bsdf& bsdf, const Surface& surface, const Frame& frame, const Vec3& wo,
                uint32_t bounce, Ray* ray) {
    const float u0 = random_.Next(), u1 = random_.Next(), u2 = random_.Next();
    const BsdfSample sample = Sample(bsdf, wo, u0, u1, u2);
    if (sample.pdf <= 0.0f) return false;
    throughput_ = throughput_ * sample.weight;
    eta_scale_ *= sample.eta_scale;
    const float brightest = MaxComponent(throughput_);
    if (brightest <= 0.0f) return false;
    if (bounce > options_.roulette_start) {
      const float survive = std::min(1.0f, brightest * eta_scale_);
      if (random_.Next() >= survive) return false;
      throughput_ = (1.0f / survive) * throughput_;
    }
    specular_ = bsdf.specular;
    bsdf_pdf_ = sample.pdf;
    ray->dir = frame.ToWorld(sample.wi);
    ray->org = surface.Leave(ray->dir);
    return true;
  }

  const EmbreeTracer& tracer_;
  const SceneView& view_;
  const PeerOptions& options_;
  Random& random_;
  Rgb radiance_, throughput_;
  float bsdf_pdf_ = 1.0f;
  float eta_scale_ = 1.0f;
  bool specular_ = true;  // no light sampling could have found the ray's direction
};

EmbreeTracer::EmbreeTracer(const Scene& scene, const SceneTables& tables)
    : scene_(scene), view_(tables.view) {}

Result<std::unique_ptr<EmbreeTracer>> EmbreeTracer::Make(const Scene& scene,
                                                         const SceneTables& tables) {
  if (!scene.spheres.empty()) return Error{"the peer renders triangles only, not spheres"};
  for (const LightRecord& light : tables.lights) {
    if (light.type == kDistantLight) return Error{"the peer has no distant lights"};
  }
  std::unique_ptr<EmbreeTracer> tracer(new EmbreeTracer(scene, tables));
  for (const Shape& shape : scene.shapes) {
    Result<Bsdf> bsdf = MakeBsdf(scene.materials[shape.record.material]);
    if (!bsdf) return bsdf.error();
    tracer->bsdfs_.push_back(*bsdf);
  }
  tracer->device_ = rtcNewDevice(nullptr);
  if (tracer->device_ == nullptr) return Error{"Embree cannot start"};
  tracer->rtc_scene_ = MakeEmbreeScene(tracer->device_, scene);
  const RTCError failed = rtcGetDeviceError(tracer->device_);
  if (failed != RTC_ERROR_NONE) {
    return Error{"Embree fails with error " + std::to_string(static_cast<int>(failed))};
  }
  return tracer;
}

EmbreeTracer::~EmbreeTracer() {
  if (rtc_scene_ != nullptr) rtcReleaseScene(rtc_scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

PeerImage EmbreeTracer::Render(const PeerOptions& options) const {
  PeerImage result;
  Image& image = result.image;
  image.width = options.width;
  image.height = options.height;
  image.rgb.resize(size_t{3} * options.width * options.height);
  const CameraRays camera(scene_, options.width, options.height);
  const auto render_tile = [&](const tbb::blocked_range2d<uint32_t>& tile) {
    const FlushDenormals flush;
    for (uint32_t y = tile.rows().begin(); y != tile.rows().end(); ++y) {
      for (uint32_t x = tile.cols().begin(); x != tile.cols().end(); ++x) {
        const uint32_t pixel = y * options.width + x;
        Rgb sum;
        for (uint32_t s = 0; s < options.samples_per_pixel; ++s) {
          Random random(pixel, s, options.seed);
          float weight;
          const Ray ray = camera.Make(x, y, random, &weight);
          sum = sum + Walk(*this, options, random).Radiance(ray, weight);
        }
        const Rgb mean =
            (scene_.request.image_scale / static_cast<float>(options.samples_per_pixel)) * sum;
        std::memcpy(&image.rgb[size_t{3} * pixel], &mean, sizeof(mean));
      }
    }
  };
  tbb::task_arena arena(static_cast<int>(options.thread_count));
  const auto start = std::chrono::steady_clock::now();
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range2d<uint32_t>(0, options.height, kTileSize, 0, options.width, kTileSize),
        render_tile, tbb::simple_partitioner());
  });
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace swell::bench
