// Objects and instances of scene files: two levels of the scene, however deep the file nests them.
#include <array>
#include <string>
#include <vector>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

using Float3 = std::array<float, 3>;

Float3 Placed(const InstanceRecord& instance, const Float3& p) {
  Float3 q;
  for (int k = 0; k < 3; ++k) {
    const float* m = &instance.to_world[3 * k];
    q[k] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + instance.centre[k];
  }
  return q;
}

void CheckNear(const Float3& got, const Float3& expected) {
  for (int k = 0; k < 3; ++k) CHECK(got[k] == doctest::Approx(expected[k]).epsilon(1e-5));
}

const std::string kSphere = " Shape \"sphere\" ";
const std::string kTriangle =
    " Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0] \"integer indices\" [0 1 2] ";

std::string ObjectOf(const std::string& name, const std::string& content) {
  return " ObjectBegin \"" + name + "\" " + content + " ObjectEnd ";
}
std::string InstanceOf(const std::string& name, const std::string& transform = "") {
  return " AttributeBegin " + transform + " ObjectInstance \"" + name + "\" AttributeEnd ";
}
Scene WorldWith(const std::string& text) {
  return test::WorldOf(" LightSource \"infinite\" " + text);
}

}  // namespace

TEST_CASE("objects: an object's primitives are a range of their own, placed by each instance") {
  const Scene scene =
      WorldWith(kTriangle + kSphere + ObjectOf("o", kTriangle + kTriangle + kSphere) + kTriangle +
                InstanceOf("o", "Translate 1 2 3") + InstanceOf("o", "Scale 2 2 2"));
  CHECK(scene.warnings.empty());
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].name == "o");
  CHECK(scene.objects[0].first_triangle == 1);
  CHECK(scene.objects[0].triangle_count == 2);
  CHECK(scene.objects[0].first_sphere == 1);
  CHECK(scene.objects[0].sphere_count == 1);
  CHECK(scene.triangle_count() == 4);
  CHECK(scene.prim_shape.size() == 6);
  REQUIRE(scene.instances.size() == 2);
  CheckNear(Placed(scene.instances[0], {1, 1, 1}), {2, 3, 4});
  CheckNear(Placed(scene.instances[1], {1, 1, 1}), {2, 2, 2});
  CHECK(scene.instances[1].to_object[0] == 0.5f);
}

TEST_CASE("objects: the transform at the shape comes before that of the instance") {
  const Scene scene = WorldWith("Translate 1 0 0" + ObjectOf("o", "Translate 0 1 0" + kSphere) +
                                InstanceOf("o", "Scale 2 2 2"));
  // In the object: (1, 1, 0), as in pbrt. The instance's own is Translate, then Scale.
  CHECK(scene.spheres[0].object_to_world[3] == 1.0f);
  CHECK(scene.spheres[0].object_to_world[7] == 1.0f);
  REQUIRE(scene.instances.size() == 1);
  CheckNear(Placed(scene.instances[0], {1, 1, 0}), {3, 2, 0});
}

TEST_CASE("objects: what ObjectBegin changes ends with ObjectEnd") {
  const Scene scene =
      WorldWith(ObjectOf("o", "Translate 5 0 0 ReverseOrientation" + kSphere) + kSphere);
  REQUIRE(scene.spheres.size() == 2);
  CHECK(scene.spheres[1].object_to_world[3] == 0.0f);
  CHECK(scene.shapes[1].record.flags == kShapeIsSphere);
}

TEST_CASE("objects: nested objects become instances in the world, by every way that leads there") {
  const Scene scene = WorldWith(
      ObjectOf("leaf", kTriangle) +
      ObjectOf("branch",
               InstanceOf("leaf", "Translate 1 0 0") + InstanceOf("leaf", "Scale 2 2 2")) +
      ObjectOf("tree", kSphere + InstanceOf("branch", "Translate 0 10 0") + InstanceOf("branch")) +
      InstanceOf("tree", "Translate 0 0 100") + InstanceOf("leaf"));
  CHECK(scene.warnings.empty());
  REQUIRE(scene.objects.size() == 2);  // a branch has no shapes of its own
  REQUIRE(scene.instances.size() == 6);
  const std::vector<uint32_t> objects = {1, 0, 0, 0, 0, 0};
  const std::vector<Float3> ends = {{1, 0, 100}, {2, 10, 100}, {2, 10, 100},
                                    {2, 0, 100}, {2, 0, 100},  {1, 0, 0}};
  for (size_t i = 0; i < 6; ++i) {
    INFO("instance ", i);
    CHECK(scene.instances[i].object == objects[i]);
    CheckNear(Placed(scene.instances[i], {1, 0, 0}), ends[i]);
  }
}

TEST_CASE("objects: a use may come before the object, in the world and in other objects") {
  const Scene scene = WorldWith(InstanceOf("a", "Translate 1 0 0") +
                                ObjectOf("a", InstanceOf("b", "Translate 0 1 0")) +
                                InstanceOf("a", "Translate 2 0 0") + ObjectOf("b", kTriangle));
  REQUIRE(scene.instances.size() == 2);
  CheckNear(Placed(scene.instances[0], {0, 0, 0}), {1, 1, 0});
  CheckNear(Placed(scene.instances[1], {0, 0, 0}), {2, 1, 0});
}

TEST_CASE("objects: area lights in objects do not shine, with a warning; other lights do, once") {
  const Scene scene = WorldWith(ObjectOf("o", "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]" +
                                                  kSphere + "LightSource \"point\"") +
                                InstanceOf("o") + InstanceOf("o"));
  CHECK(!scene.shapes[0].emits);
  CHECK(scene.lights.size() == 2);
  CHECK(test::Warns(scene, "scene.pbrt:2: an area light in an object does not shine"));
  CHECK(test::Warns(scene, "a light in an object is not instanced"));
}

TEST_CASE("objects: one without shapes is warned about and places nothing") {
  const Scene scene = WorldWith(kSphere + ObjectOf("o", "") + InstanceOf("o"));
  CHECK(scene.instances.empty());
  CHECK(scene.objects.empty());
  CHECK(test::Warns(scene, "object 'o' has no shapes"));
}

TEST_CASE("objects: nesting that multiplies without bound ends in an error, at once") {
  std::string text = ObjectOf("o0", kTriangle);
  for (int i = 1; i <= 60; ++i) {
    std::string content;
    for (int k = 0; k < 10; ++k) content += InstanceOf("o" + std::to_string(i - 1));
    text += ObjectOf("o" + std::to_string(i), content);
  }
  const test::TemporaryFolder folder;
  const auto many =
      ImportScene({folder.Write("scene.pbrt", "WorldBegin\n" + text + "\nObjectInstance \"o60\"")});
  REQUIRE(!many);
  CHECK(many.error().message.find(":3: the scene has more than 67108864 instances") !=
        std::string::npos);
}

TEST_CASE("objects: nesting too deep ends in an error, whether inside out or outside in") {
  for (const bool outside_in : {false, true}) {
    std::string text = ObjectOf("o0", kTriangle);
    for (int i = 1; i <= 1000; ++i) {
      const std::string object =
          ObjectOf("o" + std::to_string(i), InstanceOf("o" + std::to_string(i - 1)));
      text = outside_in ? object + text : text + object;
    }
    const test::TemporaryFolder folder;
    const auto deep = ImportScene({folder.Write("scene.pbrt", "WorldBegin " + text)});
    REQUIRE(!deep);
    CHECK(deep.error().message.find("objects are nested more than 64 deep") != std::string::npos);
  }
}

}  // namespace swell
