// A scene as plain arrays, what the file said about camera, film and sampler, and
// the warnings met while reading. Importers fill it; FinishScene completes it; MakeSceneView shows
// it to kernels.
#ifndef SWELL_SCENE_SCENE_H_
#define SWELL_SCENE_SCENE_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/material.h"
#include "kernels/media_view.h"
#include "kernels/scene_view.h"
#include "src/base/result.h"
#include "src/scene/environment.h"
#include "src/scene/textures.h"

namespace swell {

// Row-major 3x4: x' = m[0] x + m[1] y + m[2] z + m[3].
using Affine = std::array<float, 12>;

using MaterialParams = std::array<float, kMaterialWords>;

struct Material {
  std::string name;   // as in the file, or "" for an unnamed one
  uint32_t kind = 0;  // index of kMaterialKinds
  MaterialParams params{};
  std::vector<MaterialTexture> textures{};
  uint32_t displacement = kNoTexture;  // row of texture_nodes: heights that tilt the normal
  uint32_t normal_map = kNoTexture;    // row of texture_nodes, a kImage
  bool normal_map_follows_v = false;   // as in TextureProgram
  // 20 / Abbe number of what it transmits (KHR_materials_dispersion). Kept for rendering by
  // wavelengths; in RGB one index serves all.
  float dispersion = 0.0f;
};

// Two materials, by index or as kMixedMaterial | index of mixes.
struct Mix {
  std::string name;
  std::array<uint32_t, 2> materials{};
  float amount = 0.5f;                   // of the second
  uint32_t amount_texture = kNoTexture;  // row of texture_nodes, instead of amount
};

// What is between surfaces and takes light away: what is left after a distance d is
// exp(-absorption d), by channel.
struct Medium {
  std::string name;
  std::array<float, 3> absorption{};  // per unit of the world's length
};

// A mesh or a sphere. Its area light, if any, is one light per primitive, made by FinishScene.
struct Shape {
  ShapeRecord record{};  // first_prim .. flags; first_light is filled by FinishScene
  bool emits = false;
  bool two_sided = false;
  std::array<float, 3> radiance{};
  uint32_t alpha = kNoTexture;           // row of texture_nodes: opacity
  uint32_t emission_image = kNoTexture;  // row of image_lights, times radiance
  // Rows of media. Where they are equal, light keeps the medium that it is in, as in pbrt.
  uint32_t inside = kVacuum, outside = kVacuum;
  bool border = false;  // nothing but the border of its media; its alpha is a constant 0
  // As ShapeRecord::uv_offset, of tangents and of second coordinates; kNone: the mesh has none.
  uint32_t tangent_offset = kNone, second_uv_offset = kNone;
};

struct Camera {
  CameraType type = CameraType::kPerspective;
  float fov_degrees = 90.0f;             // of the shorter side of the screen window
  std::array<float, 4> screen_window{};  // x0 x1 y0 y1; all 0: from the resolution
  float frame_aspect_ratio = 0.0f;       // 0: from the resolution
  float lens_radius = 0.0f;              // world units
  float focal_distance = 1e6f;
  Affine camera_to_world{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  uint32_t medium = kVacuum;  // row of media
};

enum class FilterType : uint32_t { kBox, kTriangle, kGaussian, kMitchell, kSinc };

struct Filter {
  FilterType type = FilterType::kGaussian;
  float radius_x = 1.5f, radius_y = 1.5f;  // pixels
  float a = 0.5f, b = 0.0f;                // gaussian: sigma; mitchell: B, C; sinc: tau
};

// How a light is chosen for a shaded point.
enum class LightSampler : uint32_t {
  kAuto,     // kBvh, but kPower where there is nothing to gain
  kUniform,  // each as often
  kPower,    // by emitted power
  kBvh,      // by what it may send to the point: the light tree
};
inline constexpr const char* kLightSamplerNames[] = {"auto", "uniform", "power", "bvh"};
// Of so many lights or fewer, none at infinity, kAuto picks by power: one lamp of two triangles
// gains nothing by a tree. See docs/decisions/0010-many-lights.md.
inline constexpr uint32_t kFewLights = 2;

// What the scene file asks of the render; the command line overrides it.
struct RenderRequest {
  uint32_t width = 1280, height = 720;
  std::array<float, 4> crop_window{0, 1, 0, 1};  // x0 x1 y0 y1, fractions of the frame
  uint32_t samples_per_pixel = 16;
  uint32_t seed = 0;
  uint32_t max_depth = 5;
  SamplerKind sampler = SamplerKind::kSobol;
  float image_scale = 1.0f;    // film exposure: iso / 100 * exposure time
  float max_component = 0.0f;  // clamp of a sample's largest channel; 0: none
  std::string filename;        // "" if the file names none
  Filter filter;
  LightSampler light_sampler = LightSampler::kAuto;
};

// Geometry that is there only where instances place it: a range of triangles and one of spheres, in
// its own space. Its shapes do not emit.
struct Object {
  std::string name;
  uint32_t first_triangle = 0, triangle_count = 0;
  uint32_t first_sphere = 0, sphere_count = 0;
};

struct Scene {
  // Geometry. Triangle i has vertices indices[3 i .. 3 i + 2]; primitives are all triangles, then
  // all spheres; prim_shape has a row for each. What no object claims is in world space.
  std::vector<float> positions;  // x y z
  std::vector<float> normals;    // x y z, unit; only of the meshes that have them
  std::vector<float> uvs;        // u v; likewise
  std::vector<float> colors;     // r g b alpha of the first vertices; there may be none
  std::vector<float> tangents;   // x y z side, as in SceneView; only of meshes that need them
  std::vector<uint32_t> indices;
  std::vector<uint32_t> prim_shape;
  std::vector<Shape> shapes;
  std::vector<SphereRecord> spheres;
  std::vector<Object> objects;  // their ranges ascend and do not overlap
  std::vector<InstanceRecord> instances;

  std::vector<Material> materials;
  std::vector<Mix> mixes;
  std::vector<LightRecord> lights;         // without area lights, which FinishScene makes
  std::vector<ImageLight> image_lights;    // LightRecord::image is a row of these
  std::vector<TextureStep> texture_nodes;  // inputs are earlier nodes
  std::vector<TexelImage> images;          // of textures
  std::vector<Medium> media = {{}};        // kVacuum, and those that absorb
  Camera camera;
  RenderRequest request;

  uint64_t left_out_triangles = 0;    // of the files, as they have no area
  std::vector<std::string> warnings;  // "file:line: ..." each

  size_t triangle_count() const { return indices.size() / 3; }
};

struct MediaTables {
  std::vector<float> absorption;
  std::vector<uint32_t> inside, outside, border_inside, border_outside;
  MediaView view{};  // points into the rest
};

// The tables FinishScene derives; kept apart because importers do not touch them.
struct SceneTables {
  std::vector<LightRecord> lights;
  std::vector<ShapeRecord> shapes;
  std::vector<float> params;    // kMaterialWords per material
  std::vector<uint32_t> kinds;  // index of kMaterialKinds
  std::vector<MixRecord> mixes;
  std::vector<uint32_t> material_order;  // the scene's material of each row of params and kinds
  std::vector<float> alias_threshold;
  std::vector<uint32_t> alias;
  std::vector<SkyTable> skies;  // one per image light; empty but for infinite ones
  std::vector<ImageLightView> image_lights;
  std::vector<uint32_t> infinite_lights;
  LightSampler light_sampler = LightSampler::kPower;  // in effect
  std::vector<LightNode> light_nodes;
  std::vector<uint32_t> distant_lights;
  TextureTables textures;
  MediaTables media;
  std::vector<uint32_t> tangent_offsets, second_uv_offsets;  // of each shape; empty if none has any
  SceneView view{};                                          // points into scene and into this
};

// Empty if no light is ever in a medium.
MediaTables MakeMediaTables(const Scene& scene);

// Makes an area light of every emitting primitive, weighs all lights and builds the alias table;
// and the light tree, if the sampler is kBvh (the alias table is then by power). The result points
// into `scene`, which must outlive it.
SceneTables FinishScene(const Scene& scene, LightSampler light_sampler);
SceneTables FinishScene(const Scene& scene);  // as the scene asks

}  // namespace swell

#endif  // SWELL_SCENE_SCENE_H_
