// Scene -> the tables that kernels read: materials in run order and one light per emitting
// primitive.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/material.h"
#include "src/scene/holed_lights.h"
#include "src/scene/scene.h"
#include "src/scene/weigh_lights.h"

namespace swell {
namespace {

using Vector = std::array<double, 3>;

Vector Vertex(const Scene& scene, uint32_t index) {
  return {scene.positions[3 * size_t{index}], scene.positions[3 * size_t{index} + 1],
          scene.positions[3 * size_t{index} + 2]};
}
Vector Minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector CrossProduct(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double DotProduct(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
void Put(const Vector& v, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

LightRecord TriangleLight(const Scene& scene, const Shape& shape, uint32_t prim) {
  const uint32_t* index = &scene.indices[3 * size_t{prim}];
  const Vector p0 = Vertex(scene, index[0]);
  const Vector e1 = Minus(Vertex(scene, index[1]), p0);
  const Vector e2 = Minus(Vertex(scene, index[2]), p0);
  Vector n = CrossProduct(e1, e2);
  const double twice_area = std::sqrt(DotProduct(n, n));
  double sign = (shape.record.flags & kShapeFlipNormal) != 0 ? -1.0 : 1.0;
  if ((shape.record.flags & kShapeNormalsOrient) != 0 && shape.record.normal_offset != kNone) {
    Vector sum{};
    for (int k = 0; k < 3; ++k) {
      const float* normal = &scene.normals[3 * size_t{index[k] + shape.record.normal_offset}];
      for (int i = 0; i < 3; ++i) sum[i] += normal[i];
    }
    if (DotProduct(sum, n) * sign < 0.0) sign = -sign;
  }
  for (double& v : n) v *= sign / twice_area;

  LightRecord light{};
  light.type = kTriangleLight;
  light.area = static_cast<float>(twice_area / 2);
  Put(p0, light.p);
  Put(e1, light.e1);
  Put(e2, light.e2);
  Put(n, light.n);
  return light;
}

// Radius if the map is a similarity (to rounding), else 0.
double SimilarityRadius(const float* m) {
  const auto column = [&](int c) { return Vector{m[c], m[c + 4], m[c + 8]}; };
  const Vector x = column(0), y = column(1), z = column(2);
  const double r2 = DotProduct(x, x);
  const double tolerance = 1e-5 * r2;
  const bool similar =
      std::abs(DotProduct(y, y) - r2) < tolerance && std::abs(DotProduct(z, z) - r2) < tolerance &&
      std::abs(DotProduct(x, y)) < tolerance && std::abs(DotProduct(x, z)) < tolerance &&
      std::abs(DotProduct(y, z)) < tolerance;
  return similar ? std::sqrt(r2) : 0.0;
}

LightRecord SphereLight(const Scene& scene, const Shape& shape) {
  const float* m = scene.spheres[shape.record.sphere].object_to_world;
  const double radius = SimilarityRadius(m);
  LightRecord light{};
  light.type = radius > 0.0 ? kSphereLight : kEllipsoidLight;
  light.area = static_cast<float>(radius);
  light.sphere = shape.record.sphere;
  if ((shape.record.flags & kShapeFlipNormal) != 0) light.flags |= kLightInward;
  light.p[0] = m[3];
  light.p[1] = m[7];
  light.p[2] = m[11];
  return light;
}

void AddAreaLights(const Scene& scene, SceneTables& tables) {
  for (size_t s = 0; s < scene.shapes.size(); ++s) {
    const Shape& shape = scene.shapes[s];
    if (!shape.emits) continue;
    tables.shapes[s].first_light = static_cast<uint32_t>(tables.lights.size());
    for (uint32_t i = 0; i < shape.record.prim_count; ++i) {
      const uint32_t prim = shape.record.first_prim + i;
      const bool is_sphere = (shape.record.flags & kShapeIsSphere) != 0;
      LightRecord light = is_sphere ? SphereLight(scene, shape) : TriangleLight(scene, shape, prim);
      if (shape.two_sided) light.flags |= kLightTwoSided;
      light.image = shape.emission_image;
      std::copy(shape.radiance.begin(), shape.radiance.end(), light.radiance);
      light.prim = prim;
      tables.lights.push_back(light);
    }
  }
}

void AddImages(const Scene& scene, SceneTables& tables) {
  for (const ImageLight& light : scene.image_lights) {
    tables.skies.push_back(light.infinite ? MakeSkyTable(light.image, light.mapping) : SkyTable{});
  }
  for (size_t i = 0; i < tables.skies.size(); ++i) {
    tables.image_lights.push_back(MakeImageLightView(scene.image_lights[i], tables.skies[i]));
  }
  MarkHoles(scene, tables);
  for (LightRecord& light : tables.lights) {
    const bool area = light.type <= kEllipsoidLight && light.image != kNone;
    if (area || light.type > kSpotLight) light.flags |= kLightPictured;
  }
  tables.view.lights.images = tables.image_lights.data();
  tables.view.lights.any_pictured = !tables.image_lights.empty();
}

// Materials in the order of their kinds, so that runs of one kernel are neighbours.
void OrderMaterials(const Scene& scene, SceneTables& tables) {
  std::vector<uint32_t>& order = tables.material_order;
  order.resize(scene.materials.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return scene.materials[a].kind < scene.materials[b].kind;
  });
  std::vector<uint32_t> rank(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    const Material& material = scene.materials[order[i]];
    tables.kinds.push_back(material.kind);
    tables.params.insert(tables.params.end(), material.params.begin(), material.params.end());
  }
  const auto ranked = [&](uint32_t material) {
    return (material & kMixedMaterial) != 0 ? material : rank[material];
  };
  for (const Shape& shape : scene.shapes) {
    tables.shapes.push_back(shape.record);
    tables.shapes.back().material = ranked(shape.record.material);
    tables.shapes.back().first_light = kNone;
  }
  for (const Mix& mix : scene.mixes) {
    tables.mixes.push_back(
        {{ranked(mix.materials[0]), ranked(mix.materials[1])}, mix.amount, kNoTexture});
  }
}

// One of the offsets of every shape; empty if no shape has it.
std::vector<uint32_t> OffsetsOf(const Scene& scene, uint32_t Shape::*offset) {
  std::vector<uint32_t> offsets;
  bool any = false;
  for (const Shape& shape : scene.shapes) {
    offsets.push_back(shape.*offset);
    any = any || shape.*offset != kNone;
  }
  if (!any) offsets.clear();
  return offsets;
}

// What few meshes have.
void AddRareColumns(const Scene& scene, SceneTables& tables) {
  tables.tangent_offsets = OffsetsOf(scene, &Shape::tangent_offset);
  tables.second_uv_offsets = OffsetsOf(scene, &Shape::second_uv_offset);
  const auto data = [](const std::vector<uint32_t>& offsets) {
    return offsets.empty() ? nullptr : offsets.data();
  };
  tables.view.tangents = scene.tangents.data();
  tables.view.tangent_offsets = data(tables.tangent_offsets);
  tables.view.second_uv_offsets = data(tables.second_uv_offsets);
}

}  // namespace

SceneTables FinishScene(const Scene& scene) {
  return FinishScene(scene, scene.request.light_sampler);
}

SceneTables FinishScene(const Scene& scene, LightSampler light_sampler) {
  SceneTables tables;
  tables.lights = scene.lights;
  OrderMaterials(scene, tables);
  AddAreaLights(scene, tables);
  AddImages(scene, tables);
  if (!tables.lights.empty()) WeighLights(scene, light_sampler, tables);

  SceneView& view = tables.view;
  view.positions = scene.positions.data();
  view.normals = scene.normals.data();
  view.uvs = scene.uvs.data();
  view.colors = scene.colors.data();
  view.color_count = static_cast<uint32_t>(scene.colors.size() / 4);
  AddRareColumns(scene, tables);
  view.indices = scene.indices.data();
  view.prim_shape = scene.prim_shape.data();
  view.shapes = tables.shapes.data();
  view.spheres = scene.spheres.data();
  view.instances = scene.instances.data();
  view.instance_count = static_cast<uint32_t>(scene.instances.size());
  view.triangle_count = static_cast<uint32_t>(scene.triangle_count());
  view.sphere_count = static_cast<uint32_t>(scene.spheres.size());
  view.lights.records = tables.lights.data();
  view.lights.count = static_cast<uint32_t>(tables.lights.size());
  view.lights.alias_threshold = tables.alias_threshold.data();
  view.lights.alias = tables.alias.data();
  tables.textures = MakeTextureTables(scene, tables.material_order);
  view.textures = tables.textures.view;
  tables.media = MakeMediaTables(scene);
  for (size_t i = 0; i < tables.mixes.size(); ++i) {
    tables.mixes[i].program = tables.textures.mix_program[i];
  }
  view.materials = {tables.params.data(), tables.kinds.data(),
                    static_cast<uint32_t>(scene.materials.size()), tables.mixes.data()};
  return tables;
}

}  // namespace swell
