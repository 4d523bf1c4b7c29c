// The data model: every record that crosses a stage, each declared once. Every field is 32 bits
// wide.
#ifndef SWELL_KERNELS_RECORDS_H_
#define SWELL_KERNELS_RECORDS_H_

#include "kernels/columns.h"

namespace swell {

inline constexpr uint32_t kNoPrim = 0xFFFFFFFFu;

template <template <class> class C> struct Vec3Fields { C<float> x, y, z; };
template <template <class> class C> struct RgbFields { C<float> r, g, b; };

// RayFields::state: the bounce in the low bits, flags above.
inline constexpr uint32_t kBounceMask = 0xFFFFu;  // 0 for a camera ray
inline constexpr uint32_t kSpecularRay = 1u
                                         << 16;  // no light sampling could have found its direction
inline constexpr uint32_t kEndedRay = 1u << 17;  // the path goes no further; the row is empty
// The top bits say which side of what surface the ray left (kernels/normal_code-inl.h).
inline constexpr uint32_t kNormalCodeShift = 20;

// One segment of a path, on its way to its next hit. Streamed from stage to stage.
template <template <class> class C> struct RayFields {
  Vec3Fields<C> org;        // world space, already moved off its surface by the rounding bound
  Vec3Fields<C> dir;        // world space, unit length
  C<uint32_t> path;         // row of paths which this segment extends
  RgbFields<C> throughput;  // product of f * cos / pdf and roulette weights so far
  C<float> bsdf_pdf;        // solid-angle density with which dir was drawn; unused if kSpecularRay
  C<float> eta_scale;       // product of squared relative indices crossed (for roulette)
  C<uint32_t> state;        // bounce and flags, see above
};

// The closest hit of a ray, row for row.
template <template <class> class C> struct HitFields {
  C<float> t;            // distance in units of the ray's dir; infinity for a miss
  C<uint32_t> prim;      // triangles first, then spheres; kNoPrim for a miss
  C<float> u, v;         // barycentric weights of the triangle's 2nd and 3rd vertex; 0 for spheres
  C<uint32_t> instance;  // kNone: the primitive is not instanced (or a miss)
};

// A question to the scene: is anything between org and org + t_max * dir? If not, path gets
// radiance.
template <template <class> class C> struct ShadowRayFields {
  Vec3Fields<C> org;      // world space, moved off its surface
  Vec3Fields<C> dir;      // world space, any length
  C<float> t_max;         // in units of dir: 1 to a point, infinity to a direction
  RgbFields<C> radiance;  // what the path gains if nothing is hit
  C<uint32_t> path;       // row of paths
};

// What a path keeps from camera to film. Stays in its row for the path's whole life.
template <template <class> class C> struct PathFields {
  C<uint32_t> pixel;      // x | y << 16, in the full frame
  C<uint32_t> sample;     // index within the pixel
  RgbFields<C> radiance;  // sum so far, in bounce order
};

using RaysIn = RayFields<In>;
using RaysOut = RayFields<Out>;
using HitsIn = HitFields<In>;
using HitsOut = HitFields<Out>;
using ShadowRaysIn = ShadowRayFields<In>;
using ShadowRaysOut = ShadowRayFields<Out>;
using PathsIn = PathFields<In>;
using PathsOut = PathFields<Out>;

// Rows [first, first + count) of a selection that share one material.
struct Run {
  uint32_t material;
  uint32_t first;
  uint32_t count;
};

// Lanes that carried a row (or node, or primitive) against lanes issued.
struct LaneUse {
  uint64_t active = 0;
  uint64_t issued = 0;
};

}  // namespace swell

#endif  // SWELL_KERNELS_RECORDS_H_
