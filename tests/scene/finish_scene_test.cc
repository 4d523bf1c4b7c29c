// Scenes with lights and materials in, claims about the tables that kernels read out.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "src/scene/scene.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

// Probability with which the alias table picks each light.
std::vector<double> AliasProbability(const SceneTables& tables) {
  const LightsView& lights = tables.view.lights;
  std::vector<double> probability(lights.count, 0.0);
  for (uint32_t slot = 0; slot < lights.count; ++slot) {
    const double keep = lights.alias_threshold[slot];
    REQUIRE((keep >= 0 && keep <= 1));
    REQUIRE(lights.alias[slot] < lights.count);
    probability[slot] += keep / lights.count;
    probability[lights.alias[slot]] += (1 - keep) / lights.count;
  }
  return probability;
}

void CheckProbabilities(const SceneTables& tables) {
  const std::vector<double> probability = AliasProbability(tables);
  double sum = 0;
  for (uint32_t i = 0; i < tables.view.lights.count; ++i) {
    sum += tables.lights[i].select_pdf;
    CHECK(std::abs(probability[i] - tables.lights[i].select_pdf) < 1e-6);
  }
  CHECK(std::abs(sum - 1) < 1e-6);
}

TEST_CASE("FinishScene: the alias table gives the lights' probabilities, which sum to 1") {
  for (uint32_t count : {1u, 2u, 3u, 100u}) {
    SceneBuilder builder;
    for (uint32_t i = 0; i < count; ++i) {
      const float level = i % 7 == 3 ? 0.0f : float(i * i % 31) + 0.01f;
      builder.AddLight(kPointLight, {level, 0, 0}, {float(i), 0, 0});
    }
    CheckProbabilities(FinishScene(builder.scene));
  }
}

TEST_CASE("FinishScene: lights without power are never picked, unless none has any") {
  SceneBuilder builder;
  for (int i = 0; i < 5; ++i) builder.AddLight(kPointLight, {i == 2 ? 1.0f : 0.0f, 0, 0});
  SceneTables tables = FinishScene(builder.scene);
  for (int i = 0; i < 5; ++i) CHECK(tables.lights[i].select_pdf == (i == 2 ? 1.0f : 0.0f));
  builder.scene.lights[2].radiance[0] = 0;
  tables = FinishScene(builder.scene);
  for (int i = 0; i < 5; ++i) CHECK(tables.lights[i].select_pdf == 0.2f);
  CheckProbabilities(tables);
}

TEST_CASE("FinishScene: lights are weighed by power") {
  SceneBuilder builder;
  Emit(builder.AddRectangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), 4);  // area 2 * 3
  Emit(builder.AddRectangle({0, 0, 5}, {2, 0, 0}, {0, 3, 0}), 4, true);
  Emit(builder.AddSphere(Ball(0.5f, 0, 0, 9)), 2);
  builder.AddLight(kPointLight, {3, 1, 1});
  const SceneTables tables = FinishScene(builder.scene);
  REQUIRE(tables.lights.size() == 6);
  const double pi = std::numbers::pi;
  const double power[6] = {3 * 4 * pi,     4 * pi * 3,     4 * pi * 3,
                           2 * 4 * pi * 3, 2 * 4 * pi * 3, 2 * pi * 4 * pi * 0.25};
  double total = 0;
  for (double p : power) total += p;
  for (int i = 0; i < 6; ++i) {
    CHECK(tables.lights[i].select_pdf == doctest::Approx(power[i] / total).epsilon(1e-6));
  }
  CheckProbabilities(tables);
  CHECK(tables.view.lights.any_area);
  CHECK(tables.view.lights.infinite_count == 0);
}

TEST_CASE("FinishScene: makes one light of every emitting primitive, in the primitives' order") {
  SceneBuilder builder;
  builder.AddLight(kPointLight, {1, 1, 1});
  builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Shape& panel = builder.AddRectangle({0, 0, 3}, {2, 0, 0}, {0, 1, 0});
  Emit(panel, 8);
  panel.record.flags = kShapeFlipNormal;
  Shape& ball = builder.AddSphere(Ball(2, 5, 6, 7));
  Emit(ball, 1, true);
  ball.record.flags |= kShapeFlipNormal;
  Emit(builder.AddSphere({1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0}), 1);
  const SceneTables tables = FinishScene(builder.scene);
  REQUIRE(tables.lights.size() == 5);
  CHECK(tables.shapes[0].first_light == kNone);
  CHECK(tables.shapes[1].first_light == 1);
  CHECK(tables.shapes[2].first_light == 3);
  CHECK(tables.shapes[3].first_light == 4);
  for (uint32_t i = 1; i < 5; ++i) CHECK(tables.lights[i].prim == i + 1);
  for (uint32_t i = 1; i < 3; ++i) {
    const LightRecord& light = tables.lights[i];
    CHECK(light.type == kTriangleLight);
    CHECK(light.flags == 0);
    CHECK(light.area == 1.0f);
    CHECK(light.n[2] == -1.0f);
    CHECK(light.radiance[0] == 8.0f);
    CHECK(light.radiance[2] == 2.0f);
  }
  const LightRecord& sphere = tables.lights[3];
  CHECK(sphere.type == kSphereLight);
  CHECK(sphere.flags == (kLightTwoSided | kLightInward));
  CHECK(sphere.area == 2.0f);
  CHECK(sphere.p[0] == 5.0f);
  CHECK(sphere.p[2] == 7.0f);
  CHECK(tables.lights[4].type == kEllipsoidLight);
}

TEST_CASE("FinishScene: an emitting side follows the vertices' normals where they say which") {
  for (float z : {1.0f, -1.0f}) {
    for (uint32_t flip : {0u, kShapeFlipNormal}) {
      SceneBuilder builder;
      Shape& shape = builder.AddMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
      Emit(shape, 1);
      shape.record.flags = kShapeNormalsOrient | flip;
      shape.record.normal_offset = 0;
      builder.scene.normals = {0, 0, z, 0, 0, z, 0, 0, z};
      CHECK(FinishScene(builder.scene).lights.at(0).n[2] == z);
    }
  }
}

TEST_CASE("FinishScene: lights at infinity that directions can find are listed") {
  SceneBuilder builder;
  builder.AddLight(kInfiniteLight, {1, 2, 3});
  builder.AddLight(kPointLight, {1, 1, 1});
  builder.AddLight(kDistantLight, {1, 1, 1}, {0, 0, 1});
  builder.AddLight(kInfiniteLight, {0.5f, 0, 1});
  const SceneTables tables = FinishScene(builder.scene);
  const LightsView& lights = tables.view.lights;
  REQUIRE(lights.infinite_count == 2);
  CHECK(lights.infinite[0] == 0);
  CHECK(lights.infinite[1] == 3);
  CHECK_FALSE(lights.any_area);
}

TEST_CASE("FinishScene: materials are ordered by kind, stable, and shapes follow them") {
  SceneBuilder builder;
  const uint32_t kinds[] = {3, 0, 3, 1, 0};
  for (uint32_t i = 0; i < 5; ++i) builder.AddMaterial(kinds[i], {float(i)});
  for (uint32_t i = 0; i < 5; ++i) builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, i);
  const SceneTables tables = FinishScene(builder.scene);
  CHECK((tables.material_order == std::vector<uint32_t>{1, 4, 3, 0, 2}));
  CHECK((tables.kinds == std::vector<uint32_t>{0, 0, 1, 3, 3}));
  for (uint32_t i = 0; i < 5; ++i) {
    CHECK(tables.params[kMaterialWords * tables.shapes[i].material] == float(i));
  }
  CHECK(tables.view.materials.count == 5);
}

TEST_CASE("FinishScene: a scene without lights has an empty table") {
  SceneBuilder builder;
  builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const SceneTables tables = FinishScene(builder.scene);
  CHECK(tables.view.lights.count == 0);
  CHECK_FALSE(tables.view.lights.any_area);
}

}  // namespace
}  // namespace swell::test
