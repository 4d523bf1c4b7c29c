// Small scenes for tests, built shape by shape.
#ifndef SWELL_TESTS_SUPPORT_SCENE_BUILDER_H_
#define SWELL_TESTS_SUPPORT_SCENE_BUILDER_H_

#include <array>
#include <cstdint>
#include <vector>

#include "src/scene/scene.h"

namespace swell::test {

inline SphereRecord MakeSphereRecord(const Affine& m) {
  SphereRecord record{};
  for (int i = 0; i < 12; ++i) record.object_to_world[i] = m[i];
  const auto at = [&](int r, int c) -> double { return m[4 * r + c]; };
  double inverse[3][3];
  const auto minor = [&](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
  };
  const double det = at(0, 0) * minor(0, 0) + at(0, 1) * minor(0, 1) + at(0, 2) * minor(0, 2);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) inverse[r][c] = minor(c, r) / det;
  }
  for (int r = 0; r < 3; ++r) {
    double shift = 0;
    for (int c = 0; c < 3; ++c) {
      record.world_to_object[4 * r + c] = static_cast<float>(inverse[r][c]);
      shift -= inverse[r][c] * at(c, 3);
    }
    record.world_to_object[4 * r + 3] = static_cast<float>(shift);
  }
  return record;
}

// A sphere as an affine map: scaled by r and moved to (x, y, z).
inline Affine Ball(float r, float x, float y, float z) {
  return {r, 0, 0, x, 0, r, 0, y, 0, 0, r, z};
}

struct SceneBuilder {
  Scene scene;

  // Meshes come before spheres. Vertices are x y z; returns the shape.
  Shape& AddMesh(const std::vector<float>& vertices, const std::vector<uint32_t>& indices,
                 uint32_t material = 0) {
    const uint32_t base = static_cast<uint32_t>(scene.positions.size() / 3);
    Shape shape;
    shape.record = {material, kNone, static_cast<uint32_t>(scene.triangle_count()), kNone, kNone,
                    0,        0,     static_cast<uint32_t>(indices.size() / 3)};
    scene.positions.insert(scene.positions.end(), vertices.begin(), vertices.end());
    for (uint32_t index : indices) scene.indices.push_back(base + index);
    return Add(shape);
  }
  Shape& AddRectangle(const std::array<float, 3>& p, const std::array<float, 3>& e1,
                      const std::array<float, 3>& e2, uint32_t material = 0) {
    std::vector<float> v;
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 3; ++i)
        v.push_back(p[i] + (k == 1 || k == 2 ? e1[i] : 0.0f) + (k >= 2 ? e2[i] : 0.0f));
    }
    return AddMesh(v, {0, 1, 2, 0, 2, 3}, material);
  }
  Shape& AddSphere(const Affine& object_to_world, uint32_t material = 0) {
    Shape shape;
    const uint32_t sphere = static_cast<uint32_t>(scene.spheres.size());
    shape.record = {material, kNone, static_cast<uint32_t>(scene.prim_shape.size()),
                    kNone,    kNone, kShapeIsSphere,
                    sphere,   1};
    scene.spheres.push_back(MakeSphereRecord(object_to_world));
    return Add(shape);
  }
  uint32_t AddMaterial(uint32_t kind, const MaterialParams& params = {}) {
    scene.materials.push_back({"", kind, params});
    return static_cast<uint32_t>(scene.materials.size() - 1);
  }
  LightRecord& AddLight(LightType type, const std::array<float, 3>& radiance,
                        const std::array<float, 3>& p = {}) {
    LightRecord light{};
    light.type = type;
    light.prim = kNone;
    for (int i = 0; i < 3; ++i) light.radiance[i] = radiance[i];
    for (int i = 0; i < 3; ++i) light.p[i] = p[i];
    scene.lights.push_back(light);
    return scene.lights.back();
  }

 private:
  Shape& Add(const Shape& shape) {
    if (scene.materials.empty()) AddMaterial(0);
    scene.prim_shape.insert(scene.prim_shape.end(), shape.record.prim_count,
                            static_cast<uint32_t>(scene.shapes.size()));
    scene.shapes.push_back(shape);
    return scene.shapes.back();
  }
};

inline void Emit(Shape& shape, float level, bool two_sided = false) {
  shape.emits = true;
  shape.two_sided = two_sided;
  shape.radiance = {level, level / 2, level / 4};
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_SCENE_BUILDER_H_
