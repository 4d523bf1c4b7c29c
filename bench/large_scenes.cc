// The scenes that traversal is measured on, made in memory: pillars with slivers, a sphere over a
// valley, and a room for the mesh of a file.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/scene_builder.h"
#include "bench/scenes.h"
#include "src/import/ply.h"

namespace swell::bench {
namespace {

// The standard's engine is the same everywhere, its distributions are not.
class Random {
 public:
  float Uniform(float low, float high) {
    return low + (high - low) * (static_cast<float>(engine_() >> 8) * 0x1p-24f);
  }

 private:
  std::mt19937 engine_{1};
};

Point Along(const Point& from, float t, const Point& dir) {
  return {from[0] + t * dir[0], from[1] + t * dir[1], from[2] + t * dir[2]};
}

Point Unit(const Point& v) {
  const float length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// A box of height `height` on a square of half side `half`, along `up`, turned by `angle`.
void AddPillar(const Point& foot, const Point& up, float half, float height, float angle,
               Mesh& mesh) {
  const Point side =
      Unit({up[1] * std::cos(angle), -up[0] * std::cos(angle) - up[2] * std::sin(angle),
            up[1] * std::sin(angle)});
  const Point other = {up[1] * side[2] - up[2] * side[1], up[2] * side[0] - up[0] * side[2],
                       up[0] * side[1] - up[1] * side[0]};
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (float h : {0.0f, height}) {
    for (float a : {-half, half}) {
      for (float b : {-half, half}) {
        mesh.positions.push_back(Along(Along(Along(foot, h, up), a, side), b, other));
      }
    }
  }
  constexpr uint32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                     {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& face : kFaces) {
    for (uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + face[corner]);
  }
}

// A triangle as long as `dir` and a thousandth as wide.
void AddSliver(const Point& from, const Point& dir, Mesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  const Point to = Along(from, 1.0f, dir);
  mesh.positions.insert(mesh.positions.end(),
                        {from, to, Along(to, 1e-3f, {dir[1], dir[2], dir[0]})});
  for (uint32_t corner : {0u, 1u, 2u}) mesh.indices.push_back(first + corner);
}

Scene PillarRoom(uint32_t pillars, uint32_t slivers) {
  constexpr float kSide = 10, kHeight = 6;
  SceneBuilder builder;
  const uint32_t wall = builder.AddMaterial("diffuse", {{"reflectance", {0.75f, 0.75f, 0.75f}}});
  const uint32_t pillar = builder.AddMaterial("diffuse", {{"reflectance", {0.7f, 0.6f, 0.5f}}});
  builder.AddQuads({{-3, 5.99f, -3}, {3, 5.99f, -3}, {3, 5.99f, 3}, {-3, 5.99f, 3}}, wall,
                   {9, 9, 9});
  Mesh room;
  AddPillar({0, 0, 0}, {0, 1, 0}, kSide, kHeight, 0, room);
  builder.AddMesh(room, wall);

  Random random;
  Mesh mesh;
  for (uint32_t i = 0; i < pillars; ++i) {
    const Point foot = {random.Uniform(-9.5f, 9.5f), 0, random.Uniform(-9.5f, 9.5f)};
    const Point up = Unit({random.Uniform(-0.4f, 0.4f), 1, random.Uniform(-0.4f, 0.4f)});
    const float height = random.Uniform(0.3f, 1.0f) * random.Uniform(0.3f, 4.0f);
    AddPillar(foot, up, random.Uniform(0.01f, 0.05f), height, random.Uniform(0, 3), mesh);
  }
  for (uint32_t i = 0; i < slivers; ++i) {
    const Point from = {random.Uniform(-9, 9), random.Uniform(0.2f, 4), random.Uniform(-9, 9)};
    const Point dir = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    AddSliver(from, dir, mesh);
  }
  builder.AddMesh(mesh, pillar);
  builder.LookAt({-9, 5.2f, -9}, {0, 1, 0}, {0, 1, 0}, 60.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/8);
}

// A height field over [-10, 10]^2 with steep slopes, its rim raised; `side` vertices a side.
Mesh Valley(uint32_t side) {
  Mesh mesh;
  mesh.positions.reserve(size_t{side} * side);
  mesh.indices.reserve(size_t{side - 1} * (side - 1) * 6);
  for (uint32_t j = 0; j < side; ++j) {
    for (uint32_t i = 0; i < side; ++i) {
      const float x = 20.0f * static_cast<float>(i) / static_cast<float>(side - 1) - 10.0f;
      const float z = 20.0f * static_cast<float>(j) / static_cast<float>(side - 1) - 10.0f;
      const float r2 = (x * x + z * z) / 100.0f;
      float height = 5.0f * r2 * r2 / (0.5f + r2), size = 0.8f, frequency = 0.7f;
      for (int octave = 0; octave < 9; ++octave) {
        const auto phase = static_cast<float>(octave);
        height += size * std::sin(frequency * x + 1.7f * phase) *
                  std::cos(1.1f * frequency * z + 0.3f * phase);
        size *= 0.55f;
        frequency *= 2.1f;
      }
      mesh.positions.push_back({x, height, z});
    }
  }
  for (uint32_t j = 0; j + 1 < side; ++j) {
    for (uint32_t i = 0; i + 1 < side; ++i) {
      const uint32_t v = j * side + i;
      for (uint32_t corner : {v, v + side, v + side + 1, v, v + side + 1, v + 1}) {
        mesh.indices.push_back(corner);
      }
    }
  }
  return mesh;
}

}  // namespace

Scene PillarRoomScene() { return PillarRoom(/*pillars=*/24000, /*slivers=*/11986); }

Scene SmallPillarRoomScene() { return PillarRoom(/*pillars=*/200, /*slivers=*/300); }

Scene SphereOverValleyScene(bool large) {
  SceneBuilder builder;
  const uint32_t rock = builder.AddMaterial("diffuse", {{"reflectance", {0.75f, 0.7f, 0.65f}}});
  const uint32_t chalk = builder.AddMaterial("diffuse", {{"reflectance", {0.8f, 0.8f, 0.8f}}});
  builder.AddQuads({{-4, 12, -4}, {4, 12, -4}, {4, 12, 4}, {-4, 12, 4}}, rock, {20, 20, 20});
  builder.AddMesh(Valley(large ? 1160 : 581), rock);
  Mesh sphere = MakeIcosphere(/*levels=*/large ? 8 : 7);
  sphere.normals.clear();
  builder.AddMesh(Placed(sphere, {0, 3.5f, 0}, 2.0f), chalk);
  builder.LookAt({0, 6, -9}, {0, 1.5f, 0}, {0, 1, 0}, 60.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/8);
}

Scene ManyLightsScene() {
  constexpr float kHeight = 5;
  SceneBuilder builder;
  const uint32_t wall = builder.AddMaterial("diffuse", {{"reflectance", {0.6f, 0.6f, 0.6f}}});
  const uint32_t pillar = builder.AddMaterial("diffuse", {{"reflectance", {0.7f, 0.5f, 0.4f}}});
  const uint32_t metal =
      builder.AddMaterial("fuzzymirror", {{"reflectance", {0.8f, 0.85f, 0.9f}}, {"fuzz", {0.2f}}});
  Mesh hall;
  AddPillar({0, 0, 0}, {0, 1, 0}, 10, kHeight, 0, hall);
  builder.AddMesh(hall, wall);
  Random random;
  Mesh pillars;
  for (int i = 0; i < 300; ++i) {
    const Point foot = {random.Uniform(-9.5f, 9.5f), 0, random.Uniform(-9.5f, 9.5f)};
    AddPillar(foot, {0, 1, 0}, random.Uniform(0.03f, 0.12f), random.Uniform(0.3f, 2.5f),
              random.Uniform(0, 3), pillars);
  }
  builder.AddMesh(pillars, pillar);
  const Mesh sphere = MakeIcosphere(/*levels=*/4);
  for (int i = 0; i < 9; ++i) {
    const Point centre = {5.0f * static_cast<float>(i % 3 - 1), 0.6f,
                          5.0f * static_cast<float>(i / 3 - 1)};
    builder.AddMesh(Placed(sphere, centre, 0.6f), metal);
  }
  for (int i = 0; i < 1000; ++i) {
    const Point at = {random.Uniform(-9.8f, 9.8f), random.Uniform(3.3f, kHeight - 0.1f),
                      random.Uniform(-9.8f, 9.8f)};
    Mesh lamp;
    for (uint32_t k = 0; k < 3; ++k) {
      lamp.positions.push_back(
          Along(at, random.Uniform(0.02f, 0.08f),
                {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)}));
      lamp.indices.push_back(k);
    }
    const float level = 40 * std::exp(random.Uniform(0, 3));
    builder.AddMesh(lamp, wall,
                    {level, level * random.Uniform(0.4f, 1), level * random.Uniform(0.2f, 1)});
  }
  // No lamp in sight, so that the noise is that of drawing lights.
  builder.LookAt({-9, 3, -9}, {-5, 0, -5}, {0, 1, 0}, 60.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/5);
}

Result<Scene> ScanScene(const std::string& ply_file) {
  std::vector<float> positions, normals, uvs;
  Mesh mesh;
  const Result<PlyContents> read = ReadPly(ply_file, {&positions, &normals, &uvs, &mesh.indices});
  if (!read) return read.error();
  if (mesh.indices.empty()) return Error{ply_file + ": has no triangles"};
  Point lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < positions.size(); i += 3) {
    mesh.positions.push_back({positions[i], positions[i + 1], positions[i + 2]});
    for (size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], positions[i + k]);
      upper[k] = std::max(upper[k], positions[i + k]);
    }
  }
  const float size = std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
  const float x = 0.5f * (lower[0] + upper[0]), z = 0.5f * (lower[2] + upper[2]), y = lower[1];

  SceneBuilder builder;
  const uint32_t grey = builder.AddMaterial("diffuse", {{"reflectance", {0.7f, 0.7f, 0.7f}}});
  const float lamp = y + 2.95f * size;
  builder.AddQuads({{x - size, lamp, z - size},
                    {x + size, lamp, z - size},
                    {x + size, lamp, z + size},
                    {x - size, lamp, z + size}},
                   grey, {9, 9, 9});
  Mesh room;
  AddPillar({x, y, z}, {0, 1, 0}, 5 * size, 3 * size, 0, room);
  builder.AddMesh(room, grey);
  builder.AddMesh(mesh, grey);
  builder.LookAt({x + 0.4f * size, y + 0.8f * size, z + 1.1f * size}, {x, y + 0.35f * size, z},
                 {0, 1, 0}, 50.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/8);
}

}  // namespace swell::bench
