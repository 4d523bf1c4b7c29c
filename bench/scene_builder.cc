// Materials by name, meshes and a camera in, a Scene out.
#include "bench/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "kernels/material.h"
#include "src/base/check.h"

namespace swell::bench {
namespace {

Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point Unit(const Point& a) {
  const float length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

uint32_t KindByName(const std::string& name) {
  uint32_t kind = 0;
  while (kind < kMaterialKindCount && name != kMaterialKinds[kind]->name) ++kind;
  SWELL_CHECK(kind < kMaterialKindCount);
  return kind;
}

uint32_t ParameterByName(const MaterialInfo& info, const std::string& name) {
  uint32_t index = 0;
  while (index < info.param_count && name != info.params[index].name) ++index;
  SWELL_CHECK(index < info.param_count);
  return index;
}

size_t WordsOf(const ParamSpec& spec) { return spec.type == ParamType::kRgb ? 3 : 1; }

}  // namespace

uint32_t SceneBuilder::AddMaterial(const std::string& kind,
                                   const std::vector<Parameter>& parameters) {
  Material material;
  material.kind = KindByName(kind);
  const MaterialInfo& info = *kMaterialKinds[material.kind];
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const ParamSpec& spec = info.params[i];
    std::copy_n(spec.fallback, WordsOf(spec), &material.params[ParamOffset(info, i)]);
  }
  for (const Parameter& parameter : parameters) {
    const uint32_t index = ParameterByName(info, parameter.name);
    SWELL_CHECK(parameter.values.size() == WordsOf(info.params[index]));
    std::copy(parameter.values.begin(), parameter.values.end(),
              &material.params[ParamOffset(info, index)]);
  }
  scene_.materials.push_back(material);
  return static_cast<uint32_t>(scene_.materials.size() - 1);
}

std::vector<float> SceneBuilder::Named(const std::string& kind, const std::string& parameter,
                                       const std::string& name) {
  const MaterialInfo& info = *kMaterialKinds[KindByName(kind)];
  const ParamSpec& spec = info.params[ParameterByName(info, parameter)];
  uint32_t index = 0;
  while (index < spec.named_count && name != spec.named[index].name) ++index;
  SWELL_CHECK(index < spec.named_count);
  return {spec.named[index].value, spec.named[index].value + WordsOf(spec)};
}

void SceneBuilder::AddMesh(const Mesh& mesh, uint32_t material, const Point& radiance) {
  const auto first_vertex = static_cast<uint32_t>(scene_.positions.size() / 3);
  Shape shape;
  shape.record.material = material;
  shape.record.first_light = kNone;
  shape.record.first_prim = static_cast<uint32_t>(scene_.triangle_count());
  shape.record.prim_count = static_cast<uint32_t>(mesh.indices.size() / 3);
  shape.record.uv_offset = kNone;
  shape.record.normal_offset = kNone;
  if (!mesh.normals.empty()) {
    shape.record.normal_offset = static_cast<uint32_t>(scene_.normals.size() / 3) - first_vertex;
    shape.record.flags = kShapeNormalsOrient;
  }
  shape.emits = radiance != Point{0, 0, 0};
  shape.radiance = radiance;

  for (const Point& p : mesh.positions) {
    scene_.positions.insert(scene_.positions.end(), p.begin(), p.end());
  }
  for (const Point& n : mesh.normals) {
    scene_.normals.insert(scene_.normals.end(), n.begin(), n.end());
  }
  for (uint32_t index : mesh.indices) scene_.indices.push_back(first_vertex + index);
  scene_.prim_shape.insert(scene_.prim_shape.end(), shape.record.prim_count,
                           static_cast<uint32_t>(scene_.shapes.size()));
  scene_.shapes.push_back(shape);
}

void SceneBuilder::AddQuads(const std::vector<Point>& corners, uint32_t material,
                            const Point& radiance) {
  Mesh mesh;
  mesh.positions = corners;
  for (uint32_t i = 0; i < corners.size(); i += 4) {
    for (uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(i + corner);
  }
  AddMesh(mesh, material, radiance);
}

void SceneBuilder::AddInfiniteLight(const Point& radiance) {
  LightRecord light{};
  light.type = kInfiniteLight;
  light.prim = kNone;
  std::copy(radiance.begin(), radiance.end(), light.radiance);
  scene_.lights.push_back(light);
}

void SceneBuilder::LookAt(const Point& eye, const Point& target, const Point& up,
                          float fov_degrees) {
  const Point z = Unit(Minus(target, eye));
  const Point x = Unit(Cross(up, z));
  const Point y = Cross(z, x);
  scene_.camera.fov_degrees = fov_degrees;
  for (size_t r = 0; r < 3; ++r) {
    const float row[4] = {x[r], y[r], z[r], eye[r]};
    std::copy_n(row, 4, &scene_.camera.camera_to_world[4 * r]);
  }
}

Scene SceneBuilder::Finish(uint32_t resolution, uint32_t max_depth) {
  scene_.request.width = resolution;
  scene_.request.height = resolution;
  scene_.request.max_depth = max_depth;
  scene_.request.filter = {FilterType::kBox, 0.5f, 0.5f, 0.0f, 0.0f};
  return std::move(scene_);
}

Mesh MakeIcosphere(uint32_t levels) {
  const float golden = (1.0f + std::sqrt(5.0f)) / 2.0f;
  Mesh mesh;
  for (float b : {golden, -golden}) {
    for (float a : {1.0f, -1.0f}) {
      mesh.positions.push_back(Unit({a, b, 0.0f}));
      mesh.positions.push_back(Unit({0.0f, a, b}));
      mesh.positions.push_back(Unit({b, 0.0f, a}));
    }
  }
  // The faces are the triples of vertices at the edge's distance, turned outwards.
  const auto neighbours = [&](uint32_t i, uint32_t j) {
    const Point d = Minus(mesh.positions[i], mesh.positions[j]);
    return std::hypot(d[0], d[1], d[2]) < 1.2f;
  };
  for (uint32_t i = 0; i < 12; ++i) {
    for (uint32_t j = i + 1; j < 12; ++j) {
      for (uint32_t k = j + 1; k < 12; ++k) {
        if (!neighbours(i, j) || !neighbours(j, k) || !neighbours(i, k)) continue;
        const Point& p = mesh.positions[i];
        const Point n = Cross(Minus(mesh.positions[j], p), Minus(mesh.positions[k], p));
        const bool outward = n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > 0.0f;
        for (uint32_t v : {i, outward ? j : k, outward ? k : j}) mesh.indices.push_back(v);
      }
    }
  }
  for (uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t i, uint32_t j) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(i, j), static_cast<uint32_t>(mesh.positions.size()));
      if (is_new) {
        const Point a = mesh.positions[i], b = mesh.positions[j];
        mesh.positions.push_back(Unit({a[0] + b[0], a[1] + b[1], a[2] + b[2]}));
      }
      return entry->second;
    };
    std::vector<uint32_t> divided;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
      const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      divided.insert(divided.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.indices = std::move(divided);
  }
  mesh.normals = mesh.positions;
  return mesh;
}

Mesh Placed(const Mesh& mesh, const Point& centre, float scale) {
  Mesh placed = mesh;
  for (Point& p : placed.positions) {
    for (size_t i = 0; i < 3; ++i) p[i] = centre[i] + scale * p[i];
  }
  return placed;
}

}  // namespace swell::bench
