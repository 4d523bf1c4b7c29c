// Traces on, round after round, the rays that passed through.
#include "src/stages/holes.h"

#include "kernels/pass_alpha.h"
#include "src/stages/media.h"

namespace swell {
namespace {

// A ray that passes this many surfaces ends there.
constexpr int kMaxPasses = 1024;

void Add(LaneUse& sum, const LaneUse& use) {
  sum.active += use.active;
  sum.issued += use.issued;
}

// Columns of another table, lent to rays on their way and to what they hit.
struct Passing {
  explicit Passing(const std::array<uint32_t*, Table<ShadowRayFields>::kColumns>& words)
      : origin{Floats(words[5]), Floats(words[6]), Floats(words[7])},
        moved(Floats(words[8])),
        hits{Floats(words[0]), words[1], Floats(words[2]), Floats(words[3]), words[4]} {}

  static float* Floats(uint32_t* words) { return reinterpret_cast<float*>(words); }
  HitsIn read_hits() const { return {hits.t, hits.prim, hits.u, hits.v, hits.instance}; }

  Vec3Fields<Out> origin;
  float* moved;
  HitsOut hits;
};

Vec3Fields<In> Read(const Vec3Fields<Out>& v) { return {v.x, v.y, v.z}; }

// org, which the kernel has written elsewhere, is brought by the first pass.
void SendOn(const RaysIn& rays, const uint32_t* through, size_t count, const RaysOut& on) {
  for (size_t k = 0; k < count; ++k) {
    const uint32_t row = through[k];
    on.dir.x[k] = rays.dir.x[row];
    on.dir.y[k] = rays.dir.y[row];
    on.dir.z[k] = rays.dir.z[row];
    on.path[k] = row;
    on.bsdf_pdf[k] = 0.0f;
  }
}

}  // namespace

LaneUse IntersectBehindHoles(const RenderContext& context, Wave& wave, const Window& window) {
  const RaysIn rays = wave.rays.ReadColumns(window.first);
  const HitsOut hits = wave.hits.Columns(window.first);
  const RaysOut on = wave.next.Columns(window.first);  // org, dir, path: its row, bsdf_pdf: its t
  const Passing passing(wave.shadow_rays.Words(window.first));
  uint32_t* through = &wave.rows[window.first];
  LaneUse use;
  size_t count =
      PassAlpha(context.width, PassAlphaArgs{&context.scene, context.pixel, rays.org, rays.dir,
                                             wave.hits.ReadColumns(window.first), nullptr,
                                             window.rays, through, passing.origin, passing.moved});
  if (context.media != nullptr) {
    CrossBorders(context, wave, window,
                 {rays.org, rays.dir, wave.hits.ReadColumns(window.first), through, count});
  }
  SendOn(rays, through, count, on);
  for (int pass = 0; count > 0; ++pass) {
    for (size_t k = 0; k < count; ++k) {
      on.org.x[k] = passing.origin.x[k];
      on.org.y[k] = passing.origin.y[k];
      on.org.z[k] = passing.origin.z[k];
      on.bsdf_pdf[k] += passing.moved[k];
    }
    Add(use, IntersectRays(context.width, context.bvh, context.traversal, Read(on.org),
                           Read(on.dir), passing.hits, count));
    if (context.media != nullptr) {
      AbsorbBehind(context, wave, window, on.path, passing.hits.t, count);
    }
    for (size_t k = 0; k < count; ++k) {
      const uint32_t row = on.path[k];
      hits.t[row] = passing.hits.t[k] + on.bsdf_pdf[k];
      hits.prim[row] = pass < kMaxPasses ? passing.hits.prim[k] : kNoPrim;
      hits.u[row] = passing.hits.u[k];
      hits.v[row] = passing.hits.v[k];
      hits.instance[row] = passing.hits.instance[k];
    }
    if (pass == kMaxPasses) break;
    count = PassAlpha(context.width, PassAlphaArgs{&context.scene, context.pixel, Read(on.org),
                                                   Read(on.dir), passing.read_hits(), nullptr,
                                                   count, through, passing.origin, passing.moved});
    if (context.media != nullptr) {
      CrossBorders(context, wave, window,
                   {Read(on.org), Read(on.dir), passing.read_hits(), through, count, on.path});
    }
    for (size_t k = 0; k < count; ++k) {  // through[k] >= k: rows only move down
      const uint32_t row = through[k];
      on.dir.x[k] = on.dir.x[row];
      on.dir.y[k] = on.dir.y[row];
      on.dir.z[k] = on.dir.z[row];
      on.path[k] = on.path[row];
      on.bsdf_pdf[k] = on.bsdf_pdf[row];
    }
  }
  return use;
}

LaneUse OccludeWithHoles(const RenderContext& context, Wave& wave, const Window& window) {
  const ShadowRaysOut shadow = wave.shadow_rays.Columns(window.first);
  const RgbFields<Out> radiance = wave.paths.Columns(window.first).radiance;
  const HitsOut hits = wave.hits.Columns(window.first);
  const auto spare = wave.rays.Words(window.first);
  const Vec3Fields<Out> origin{Passing::Floats(spare[0]), Passing::Floats(spare[1]),
                               Passing::Floats(spare[2])};
  float* moved = Passing::Floats(spare[3]);
  uint32_t* through = &wave.rows[window.first];
  const auto words = wave.shadow_rays.Words(window.first);
  LaneUse use;
  size_t count = window.shadow_rays;
  for (int pass = 0; count > 0 && pass < kMaxPasses; ++pass) {
    Add(use, IntersectRays(context.width, context.bvh, context.traversal, Read(shadow.org),
                           Read(shadow.dir), hits, count));
    if (context.media != nullptr) AbsorbShadowRays(context, wave, window, hits.t, count);
    for (size_t i = 0; i < count; ++i) {
      if (hits.prim[i] != kNoPrim && hits.t[i] < shadow.t_max[i]) continue;
      const uint32_t path = shadow.path[i];
      radiance.r[path] += shadow.radiance.r[i];
      radiance.g[path] += shadow.radiance.g[i];
      radiance.b[path] += shadow.radiance.b[i];
    }
    count = PassAlpha(context.width,
                      PassAlphaArgs{&context.scene, context.pixel, Read(shadow.org),
                                    Read(shadow.dir), wave.hits.ReadColumns(window.first),
                                    shadow.t_max, count, through, origin, moved});
    if (context.media != nullptr) {
      CrossShadowBorders(context, wave, window,
                         {Read(shadow.org), Read(shadow.dir), wave.hits.ReadColumns(window.first),
                          through, count});
    }
    for (size_t k = 0; k < count; ++k) {
      for (uint32_t* column : words) column[k] = column[through[k]];
      shadow.org.x[k] = origin.x[k];
      shadow.org.y[k] = origin.y[k];
      shadow.org.z[k] = origin.z[k];
      shadow.t_max[k] -= moved[k];
    }
  }
  return use;
}

}  // namespace swell
