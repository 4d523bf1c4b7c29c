// What a kernel may see of the scene: pointers, counts and plain values. Owned by src/scene.
#ifndef SWELL_KERNELS_SCENE_VIEW_H_
#define SWELL_KERNELS_SCENE_VIEW_H_

#include <cstdint>

#include "kernels/columns.h"
#include "kernels/image_view.h"
#include "kernels/sampler.h"
#include "kernels/texture_view.h"

namespace swell {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;

// ShapeRecord::flags
inline constexpr uint32_t kShapeFlipNormal =
    1u << 0;  // geometric normal = -(e1 x e2) (or inward, sphere)
inline constexpr uint32_t kShapeIsSphere = 1u << 1;
// The mesh has normals, and its geometric normal is that side of e1 x e2 to which they point;
// kShapeFlipNormal does not count.
inline constexpr uint32_t kShapeNormalsOrient = 1u << 2;

// A mesh or one sphere: what all its primitives share. Gathered as words.
struct ShapeRecord {
  uint32_t material;       // index of materials, or kMixedMaterial | row of mixes
  uint32_t first_light;    // light of its first primitive; kNone: the shape does not emit
  uint32_t first_prim;     // its primitives are [first_prim, first_prim + count)
  uint32_t normal_offset;  // vertex index + this = row of normals (modulo 2^32); kNone: no normals
  uint32_t uv_offset;      // likewise, row of uvs
  uint32_t flags;
  uint32_t sphere;  // row of spheres, for kShapeIsSphere
  uint32_t prim_count;
};
static_assert(sizeof(ShapeRecord) == 32, "gathered with a stride of 8 words");

// An ellipsoid: the unit sphere of its own space under an affine map. Row-major 3x4 matrices.
struct SphereRecord {
  float object_to_world[12];
  float world_to_object[12];
};

// A copy of an object: world point = to_world * p + centre, object point = to_object * (p -
// centre). The difference comes first, so that far from the world's origin rays lose no more than
// near it. Row-major 3x3 matrices. Gathered as words.
struct InstanceRecord {
  float to_object[9];  // the inverse of to_world
  float centre[3];     // the object's origin, world space
  uint32_t object;     // row of BvhView::objects
  float to_world[9];
};
static_assert(sizeof(InstanceRecord) == 22 * 4, "gathered with a stride of 22 words");
inline constexpr uint32_t kMaxInstances = 1u << 26;  // the gathers' offsets are 31 bits

enum LightType : uint32_t {
  kTriangleLight = 0,
  kSphereLight = 1,         // a similar image of the unit sphere: sampled by its cone of directions
  kEllipsoidLight = 2,      // any other affine image: sampled by area of the unit sphere
  kPointLight = 3,          // radiance is the intensity [W/sr]
  kDistantLight = 4,        // radiance is the irradiance on a facing plane
  kInfiniteLight = 5,       // constant radiance from every direction
  kSpotLight = 6,           // a point light that fades out around its axis
  kGoniometricLight = 7,    // a point light times an image of its directions
  kProjectionLight = 8,     // a point light times a slide
  kImageInfiniteLight = 9,  // radiance by an image of the sky
};
inline constexpr uint32_t kLightTwoSided = 1u << 0;
inline constexpr uint32_t kLightInward = 1u << 1;    // spheres: emits to the inside
inline constexpr uint32_t kLightPictured = 1u << 2;  // radiance is to be multiplied by an image
inline constexpr uint32_t kLightUnseen = 1u << 3;    // of a surface that all rays pass

// One light. Gathered as words, so every field is 32 bits wide.
struct LightRecord {
  uint32_t type;
  uint32_t flags;
  float radiance[3];  // emitted radiance (intensity, irradiance: see LightType)
  float select_pdf;   // probability with which the alias table picks this light
  float area;         // triangle: area; sphere: radius; world units
  float p[3];  // triangle: 1st vertex; sphere: centre; point: position; distant: direction TO the
               // light
  float e1[3], e2[3];  // triangle: edges from the 1st vertex; spot: e1 = cosines at which it begins
                       // to fade and has faded
  float n[3];          // triangle: unit normal of the emitting side; spot: unit axis
  uint32_t prim;       // the primitive that emits; kNone for lights without one
  uint32_t sphere;     // row of spheres, for sphere and ellipsoid lights
  uint32_t image;      // row of LightsView::images; kNone: none
  uint32_t trail;      // three bits per depth of the light tree: which of the siblings it is in
  uint32_t unused;
};
static_assert(sizeof(LightRecord) == 24 * 4, "gathered with a stride of 24 words");

// Nodes of a light tree stand in rows of siblings, so many each.
inline constexpr uint32_t kLightSiblings = 8;
inline constexpr uint32_t kLightTrailBits = 3;

// LightNode::child: a row of lights or the first of a row of nodes, and
inline constexpr uint32_t kLightLeaf = 1u << 31;  // it is a light
inline constexpr uint32_t kLightNodeTwoSided = 1u << 30;
inline constexpr uint32_t kLightNodeNarrow = 1u << 29;  // cos_e is that of less than a right angle
inline constexpr uint32_t kLightNodeFlags = kLightLeaf | kLightNodeTwoSided | kLightNodeNarrow;
inline constexpr uint32_t kNoLightNode = ~(kLightNodeTwoSided | kLightNodeNarrow);  // fills up rows

// What bounds the lights of one side. Gathered in fours of words.
struct alignas(16) LightNode {
  float centre[3];  // of the box around the lights
  float radius;     // half the diagonal of that box
  float axis[3];    // unit; every light's own axes lie within an angle o of it
  float cos_o, sin_o;
  float cos_e;      // lights shine to within an angle e of one of their axes
  float intensity;  // sum over the lights [W/sr]
  uint32_t child;
};
static_assert(sizeof(LightNode) == 12 * 4, "gathered with a stride of 12 words");

// How lights are drawn for --lightsampler bvh: one of those at infinity, each with the same
// probability, or one of the tree's, by what it may send to the point.
struct LightTreeView {
  const LightNode* nodes;   // null: lights are drawn by the alias table
  uint32_t root;            // as LightNode::child
  bool any;                 // some light has a place
  const uint32_t* distant;  // the lights without a place
  uint32_t distant_count;
  float distant_pdf;  // of each
};

struct LightsView {
  const LightRecord* records;
  uint32_t count;
  const float* alias_threshold;  // Vose's alias table over select_pdf: keep i if u < threshold
  const uint32_t* alias;         // else take alias[i]
  const ImageLightView* images;
  const uint32_t* infinite;  // the lights at infinity that directions can find
  uint32_t infinite_count;
  bool any_area;      // some primitive emits
  bool any_pictured;  // some light has an image
  bool any_unseen;    // some light is kLightUnseen
  LightTreeView tree;
};

// Two materials in one surface: each hit is of one of them, the second with probability `amount`.
inline constexpr uint32_t kMixedMaterial = 1u << 31;
struct MixRecord {
  uint32_t material[2];  // as ShapeRecord::material
  float amount;
  uint32_t program;  // of TexturesView, which gives the amount; kNoTexture: constant
};
static_assert(sizeof(MixRecord) == 16, "gathered with a stride of 4 words");

struct MaterialsView {
  const float* params;   // kMaterialWords floats per material, see ParamSpec
  const uint32_t* kind;  // index into the registry of material kinds
  uint32_t count;
  const MixRecord* mixes;
};

// Everything about surfaces and light. The BVH has its own view (bvh_node.h).
struct SceneView {
  const float* positions;  // x, y, z per vertex, world space or that of its object
  const float* normals;    // x, y, z per row, likewise, unit
  const float* uvs;        // u, v per row
  const float* colors;     // r, g, b, alpha of the first color_count vertices
  // x, y, z, side per row: along growing u, and 1 or -1 if v grows to the side of normal x along or
  // to the other.
  const float* tangents;
  // Of each shape; null if none has any, as of most scenes. Vertex index + this = row of tangents,
  // or of uvs for second coordinates (modulo 2^32); kNone: none.
  const uint32_t* tangent_offsets;
  const uint32_t* second_uv_offsets;
  const uint32_t* indices;     // 3 vertices per triangle
  const uint32_t* prim_shape;  // row of shapes, for every primitive
  const ShapeRecord* shapes;
  const SphereRecord* spheres;  // their world is that of their object
  const InstanceRecord* instances;
  uint32_t triangle_count;  // primitives below this are triangles, the rest spheres
  uint32_t sphere_count;
  uint32_t instance_count;
  uint32_t color_count;
  LightsView lights;
  MaterialsView materials;
  TexturesView textures;
};

enum class CameraType : uint32_t { kPerspective, kOrthographic };

// Maps a film position (pixels, y down) to a ray. Camera space: x right, y up, z forward.
struct CameraView {
  CameraType type;
  float
      raster_to_screen[4];  // screen x = r[0] * px + r[1]; y = r[2] * py + r[3]; on the plane z = 1
  float camera_to_world[12];  // row-major 3x4
  float lens_radius;          // 0: a pinhole
  float focal_distance;
};

// Importance-sampled separable pixel filter: the offset at equal steps of probability. `weight` is
// the filter's value over the density, constant but for filters with negative lobes.
inline constexpr uint32_t kFilterBins = 1024;
struct FilterView {
  const float* quantiles_x;  // kFilterBins + 1 offsets from the pixel's centre, in pixels
  const float* quantiles_y;
  const float* weight_x;  // kFilterBins values
  const float* weight_y;
};

// How directions are drawn from a cosine (lecture, "Sampling Lambertian scattering").
enum class DiffuseSampling : uint32_t {
  kDisk,
  kNormalPlusSphere,
  kNormalPlusRejectedSphere,
  kNormalPlusGaussian,
};

// What a render may choose and every path must know.
struct PathSettings {
  uint32_t seed;
  uint32_t max_depth;       // surface scatterings; a camera ray sees emission at depth 0
  uint32_t roulette_start;  // first bounce after which paths may be ended at random
  DiffuseSampling diffuse_sampling;
  SamplerView sampler = {};
};

}  // namespace swell

#endif  // SWELL_KERNELS_SCENE_VIEW_H_
