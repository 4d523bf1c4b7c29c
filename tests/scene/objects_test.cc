// Objects and instances in, claims about what is drawn and where out.
#include "src/scene/objects.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

// Triangles 0 | 1 2 | 3 and spheres 0 | 1: the middle ones are an object's.
Scene Mixed() {
  SceneBuilder builder;
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i == 0 || i == 3 ? i : 100);
    builder.AddMesh({x, 0, 0, x + 1, 0, 0, x, 1, 0}, {0, 1, 2});
  }
  builder.AddSphere(Ball(1, -5, 0, 0));
  builder.AddSphere(Ball(2, 100, 0, 0));
  builder.scene.objects.push_back({"empty", 0, 0, 0, 0});
  builder.scene.objects.push_back({"middle", 1, 2, 1, 1});
  return builder.scene;
}

std::array<double, 12> Shift(double x, double y, double z) {
  return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
}

}  // namespace

TEST_CASE("WorldTriangles, WorldSpheres: what no object claims, in order") {
  const Scene scene = Mixed();
  const auto triangles = WorldTriangles(scene);
  REQUIRE(triangles.size() == 2);
  CHECK((triangles[0].first == 0 && triangles[0].count == 1));
  CHECK((triangles[1].first == 3 && triangles[1].count == 1));
  const auto spheres = WorldSpheres(scene);
  REQUIRE(spheres.size() == 1);
  CHECK((spheres[0].first == 0 && spheres[0].count == 1));
  CHECK(WorldTriangles(Scene()).empty());
}

TEST_CASE("WorldBounds: objects count where instances place them, and only there") {
  Scene scene = Mixed();
  Bounds bounds = WorldBounds(scene);
  CHECK(bounds.low == std::array<double, 3>{-6, -1, -1});
  CHECK(bounds.high == std::array<double, 3>{4, 1, 1});
  // The object reaches from 98 to 102 in x, -2 to 2 in y and z.
  scene.instances.push_back(*PlaceObject(Shift(0, 10, 0), 1));
  bounds = WorldBounds(scene);
  CHECK(bounds.low == std::array<double, 3>{-6, -1, -2});
  CHECK(bounds.high == std::array<double, 3>{102, 12, 2});
  scene.instances.push_back(*PlaceObject({0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0}, 1));  // x to y
  CHECK(WorldBounds(scene).high[1] == 102);
  CHECK(WorldBounds(Scene()).empty());
}

TEST_CASE("CountDrawn: an object's primitives count once for every instance") {
  Scene scene = Mixed();
  CHECK(CountDrawn(scene).triangles == 2);
  CHECK(CountDrawn(scene).spheres == 1);
  for (int i = 0; i < 3; ++i) scene.instances.push_back(*PlaceObject(Shift(i, 0, 0), 1));
  CHECK(CountDrawn(scene).triangles == 8);
  CHECK(CountDrawn(scene).spheres == 4);
}

TEST_CASE("PlaceObject: the two maps are inverse to each other to float rounding") {
  const auto instance = PlaceObject({2, 0.5, 0, 7, -1, 3, 0.25, -8, 0, 1, -4, 9}, 5);
  REQUIRE(instance);
  CHECK(instance->object == 5);
  CHECK(instance->centre[0] == 7);
  CHECK(instance->centre[1] == -8);
  CHECK(instance->centre[2] == 9);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        sum += double{instance->to_world[3 * r + k]} * instance->to_object[3 * k + c];
      CHECK(std::abs(sum - (r == c ? 1 : 0)) < 1e-6);
    }
  }
}

TEST_CASE("PlaceObject: maps that flatten or do not fit place nothing") {
  CHECK(!PlaceObject({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 0));
  CHECK(!PlaceObject({1, 2, 0, 0, 2, 4, 0, 0, 0, 0, 1, 0}, 0));
  CHECK(!PlaceObject({1e-42, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0));
  CHECK(!PlaceObject({1, 0, 0, 1e39, 0, 1, 0, 0, 0, 0, 1, 0}, 0));
  CHECK(!PlaceObject({NAN, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0));
  CHECK(!PlaceObject({1e16, 0, 0, 0, 0, 1e16, 0, 0, 0, 0, 1e16, 0}, 0));
  CHECK(!PlaceObject({1e-16, 0, 0, 0, 0, 1e-16, 0, 0, 0, 0, 1e-16, 0}, 0));
  CHECK(PlaceObject({1e-6, 0, 0, 0, 0, 1e6, 0, 0, 0, 0, 1, 0}, 0));
}

TEST_CASE("FinishScene: distant light is weighed by the extent of what is drawn") {
  // A point of power 4 pi r^2 L against a distant light of pi R^2, R half the diagonal.
  Scene scene = Mixed();
  LightRecord light{};
  light.type = kDistantLight;
  light.prim = kNone;
  light.radiance[0] = 1;
  scene.lights = {light, light};
  scene.lights[1].type = kPointLight;
  const auto share = [&] {
    const SceneTables tables = FinishScene(scene);
    return tables.lights[0].select_pdf / tables.lights[1].select_pdf;
  };
  const float before = share();
  scene.instances.push_back(*PlaceObject(Shift(0, 1000, 0), 1));
  CHECK(share() > 1000 * before);
}

}  // namespace swell::test
