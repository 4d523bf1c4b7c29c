// A name in, one of the benchmarks' scenes out.
#include "bench/scenes.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/scene_builder.h"
#include "src/import/import_scene.h"

namespace swell::bench {

// Cornell University Program of Graphics, "The Cornell Box: data" (1998), in millimetres; colours
// of the walls and the lamp as RGB.
Scene CornellScene() {
  SceneBuilder builder;
  const uint32_t white = builder.AddMaterial("diffuse", {{"reflectance", {0.73f, 0.73f, 0.73f}}});
  const uint32_t red = builder.AddMaterial("diffuse", {{"reflectance", {0.63f, 0.065f, 0.05f}}});
  const uint32_t green = builder.AddMaterial("diffuse", {{"reflectance", {0.14f, 0.45f, 0.091f}}});

  builder.AddQuads({{343, 548.7f, 227}, {343, 548.7f, 332}, {213, 548.7f, 332}, {213, 548.7f, 227}},
                   white, {17, 12, 4});
  builder.AddQuads(
      {
          {552.8f, 0, 0},
          {0, 0, 0},  // floor
          {0, 0, 559.2f},
          {549.6f, 0, 559.2f},  //
          {556, 548.8f, 0},
          {556, 548.8f, 559.2f},  // ceiling
          {0, 548.8f, 559.2f},
          {0, 548.8f, 0},  //
          {549.6f, 0, 559.2f},
          {0, 0, 559.2f},  // back wall
          {0, 548.8f, 559.2f},
          {556, 548.8f, 559.2f},  //
      },
      white);
  builder.AddQuads({{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}, green);
  builder.AddQuads({{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}},
                   red);
  builder.AddQuads(
      {
          {130, 165, 65},  {82, 165, 225},  {240, 165, 272}, {290, 165, 114},  // short block
          {290, 0, 114},   {290, 165, 114}, {240, 165, 272}, {240, 0, 272},    //
          {130, 0, 65},    {130, 165, 65},  {290, 165, 114}, {290, 0, 114},    //
          {82, 0, 225},    {82, 165, 225},  {130, 165, 65},  {130, 0, 65},     //
          {240, 0, 272},   {240, 165, 272}, {82, 165, 225},  {82, 0, 225},     //
          {130, 0, 65},    {290, 0, 114},   {240, 0, 272},   {82, 0, 225},     //
          {423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406},  // tall block
          {423, 0, 247},   {423, 330, 247}, {472, 330, 406}, {472, 0, 406},    //
          {472, 0, 406},   {472, 330, 406}, {314, 330, 456}, {314, 0, 456},    //
          {314, 0, 456},   {314, 330, 456}, {265, 330, 296}, {265, 0, 296},    //
          {265, 0, 296},   {265, 330, 296}, {423, 330, 247}, {423, 0, 247},    //
          {423, 0, 247},   {472, 0, 406},   {314, 0, 456},   {265, 0, 296},    //
      },
      white);
  builder.LookAt({278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.3f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/8);
}

Scene SphereRoomScene() {
  SceneBuilder builder;
  const uint32_t wall = builder.AddMaterial("diffuse", {{"reflectance", {0.7f, 0.7f, 0.7f}}});
  const uint32_t red = builder.AddMaterial("diffuse", {{"reflectance", {0.6f, 0.2f, 0.2f}}});
  const uint32_t green = builder.AddMaterial("diffuse", {{"reflectance", {0.2f, 0.6f, 0.2f}}});
  const auto metal = [&](const char* name) {
    return builder.AddMaterial("conductor", {{"eta", SceneBuilder::Named("conductor", "eta", name)},
                                             {"k", SceneBuilder::Named("conductor", "k", name)}});
  };
  const std::vector<uint32_t> of_spheres = {
      builder.AddMaterial("diffuse", {{"reflectance", {0.7f, 0.25f, 0.15f}}}),
      builder.AddMaterial("mirror", {{"reflectance", {0.9f, 0.9f, 0.9f}}}),
      builder.AddMaterial("fuzzymirror", {{"reflectance", {0.8f, 0.85f, 0.9f}}, {"fuzz", {0.2f}}}),
      builder.AddMaterial("dielectric", {{"eta", {1.5f}}}),
      metal("Cu"),
      builder.AddMaterial("diffuse", {{"reflectance", {0.15f, 0.35f, 0.7f}}}),
      metal("Au"),
  };

  const float x = 6, y = 7, z = 6;
  builder.AddQuads({{2, 6.99f, -2}, {2, 6.99f, 2}, {-2, 6.99f, 2}, {-2, 6.99f, -2}}, wall,
                   {9, 9, 9});
  builder.AddQuads(
      {
          {-x, 0, -z},
          {-x, 0, z},
          {x, 0, z},
          {x, 0, -z},  // floor
          {-x, y, -z},
          {x, y, -z},
          {x, y, z},
          {-x, y, z},  // ceiling
          {-x, 0, z},
          {-x, y, z},
          {x, y, z},
          {x, 0, z},  // far wall
          {-x, 0, -z},
          {x, 0, -z},
          {x, y, -z},
          {-x, y, -z},  // wall behind the camera
      },
      wall);
  builder.AddQuads({{-x, 0, -z}, {-x, y, -z}, {-x, y, z}, {-x, 0, z}}, red);
  builder.AddQuads({{x, 0, -z}, {x, 0, z}, {x, y, z}, {x, y, -z}}, green);
  const Mesh sphere = MakeIcosphere(/*levels=*/5);
  for (uint32_t i = 0; i < 25; ++i) {
    const Point centre = {2.1f * (static_cast<float>(i % 5) - 2.0f),
                          0.85f + 1.1f * static_cast<float>(i % 2 + i / 10 % 2),
                          1.7f * (static_cast<float>(i / 5) - 2.0f) + 1.1f};
    builder.AddMesh(Placed(sphere, centre, 0.8f), of_spheres[i % of_spheres.size()]);
  }
  builder.LookAt({0, 3.6f, -5.8f}, {0, 1.6f, 0}, {0, 1, 0}, 70.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/16);
}

Scene BigMeshScene() {
  constexpr uint32_t kSide = 708;  // vertices; 2 (kSide - 1)^2 triangles
  Mesh mesh;
  for (uint32_t j = 0; j < kSide; ++j) {
    for (uint32_t i = 0; i < kSide; ++i) {
      const float x = 20.0f * static_cast<float>(i) / (kSide - 1) - 10.0f;
      const float z = 20.0f * static_cast<float>(j) / (kSide - 1) - 10.0f;
      float height = 0.0f, size = 1.0f, frequency = 0.5f;
      for (int octave = 0; octave < 6; ++octave) {
        height += size * std::sin(frequency * x + static_cast<float>(octave)) *
                  std::cos(1.1f * frequency * z + 0.3f * static_cast<float>(octave));
        size *= 0.5f;
        frequency *= 2.1f;
      }
      mesh.positions.push_back({x, height, z});
    }
  }
  for (uint32_t j = 0; j + 1 < kSide; ++j) {
    for (uint32_t i = 0; i + 1 < kSide; ++i) {
      const uint32_t v = j * kSide + i;
      for (uint32_t corner : {v, v + kSide, v + kSide + 1, v, v + kSide + 1, v + 1}) {
        mesh.indices.push_back(corner);
      }
    }
  }
  SceneBuilder builder;
  builder.AddMesh(mesh, builder.AddMaterial("diffuse", {{"reflectance", {0.6f, 0.55f, 0.45f}}}));
  builder.AddInfiniteLight({1, 1, 1});
  builder.LookAt({0, 6, -14}, {0, -1, 0}, {0, 1, 0}, 45.0f);
  return builder.Finish(/*resolution=*/512, /*max_depth=*/5);
}

Result<Scene> MakeScene(const std::string& name) {
  if (name == "cornell") return CornellScene();
  if (name == "pillars") return PillarRoomScene();
  if (name == "small-pillars") return SmallPillarRoomScene();
  if (name == "valley-1m") return SphereOverValleyScene(/*large=*/false);
  if (name == "valley-4m") return SphereOverValleyScene(/*large=*/true);
  if (name == "room") return SphereRoomScene();
  if (name == "bigmesh") return BigMeshScene();
  if (name == "lights-1000") return ManyLightsScene();
  if (name.ends_with(".ply")) return ScanScene(name);
  return ImportScene({name});
}

Result<std::unique_ptr<BuiltScene>> BuildScene(const std::string& name, LightSampler sampler) {
  Result<Scene> scene = MakeScene(name);
  if (!scene) return scene.error();
  if (sampler != LightSampler::kAuto) scene->request.light_sampler = sampler;
  auto built = std::make_unique<BuiltScene>(std::move(*scene));
  Result<Bvh> bvh = BuildBvh(built->scene);
  if (!bvh) return bvh.error();
  built->bvh = std::move(*bvh);
  return built;
}

}  // namespace swell::bench
