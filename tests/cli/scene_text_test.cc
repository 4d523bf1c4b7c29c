// What swell info says of a scene.
#include "src/cli/scene_text.h"

#include <doctest/doctest.h>

#include <sstream>

namespace swell {
namespace {

// The rest of the line that starts with `name`, or "".
std::string ValueOf(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  " + name + " ", 0) != 0) continue;
    const size_t start = line.find_first_not_of(' ', name.size() + 2);
    return start == std::string::npos ? "" : line.substr(start);
  }
  return "";
}

struct Fixture {
  Scene scene;
  SceneTables tables;
  MaterialInfo diffuse{}, mirror{};
  const MaterialInfo* kinds[2] = {&diffuse, &mirror};

  Fixture() {
    diffuse.name = "diffuse";
    mirror.name = "mirror";
    scene.positions = {0, 0, 0, 1, 0, 0, 0, 2, 0, 99, 99, 99};
    scene.indices = {0, 1, 2};
    scene.shapes.resize(2);
    scene.shapes[1].record.flags = kShapeIsSphere;
    // Radius 3 around (10, 0, 0).
    scene.spheres = {{{3, 0, 0, 10, 0, 3, 0, 0, 0, 0, 3, 0}, {}}};
    scene.materials.resize(3);
    scene.materials[0].name = "wall";
    scene.materials[2].kind = 1;
    tables.lights.resize(2);
    tables.lights[1].type = kInfiniteLight;
    scene.request.width = 64;
    scene.request.height = 32;
    scene.request.crop_window = {0.5f, 1, 0, 1};
  }

  std::string Text() const { return SceneText(scene, tables, kinds, {5, 6, 2, 2048, 0.5}, 0.25); }
};

TEST_CASE("SceneText: counts what is there") {
  const std::string text = Fixture().Text();
  CHECK(ValueOf(text, "meshes") == "1");
  CHECK(ValueOf(text, "triangles") == "1");
  CHECK(ValueOf(text, "spheres") == "1");
  CHECK(ValueOf(text, "vertices") == "4");
  CHECK(ValueOf(text, "materials") == "3 (2 diffuse, 1 mirror)");
  CHECK(ValueOf(text, "lights") == "2 (1 infinite, 1 triangle)");
  CHECK(text.find("mirror#2: mirror") != std::string::npos);
  CHECK(ValueOf(text, "nodes") == "5");
  CHECK(ValueOf(text, "tree") == "2.00 KiB");
  CHECK(ValueOf(text, "import") == "0.250 s");
  CHECK(ValueOf(text, "build") == "0.500 s");
}

TEST_CASE("SceneText: of instanced primitives, how many there are and how many are seen") {
  Fixture f;
  CHECK(f.Text().find("instances  ") != std::string::npos);  // the memory of none
  CHECK(ValueOf(f.Text(), "objects") == "");
  f.scene.objects.push_back({"thing", 0, 1, 0, 1});
  InstanceRecord instance{};
  for (int k = 0; k < 3; ++k) instance.to_world[4 * k] = 1;
  f.scene.instances.assign(2500, instance);
  f.scene.instances[0].centre[0] = -100;
  const std::string text = f.Text();
  CHECK(ValueOf(text, "objects") == "1");
  CHECK(ValueOf(text, "instances") == "2,500");
  CHECK(ValueOf(text, "triangles") == "1 unique, 2,500 with instances");
  CHECK(ValueOf(text, "spheres") == "1 unique, 2,500 with instances");
  CHECK(ValueOf(text, "bounds") == "x -100 to 13, y -3 to 3, z -3 to 3");
}

TEST_CASE("SceneText: bounds are of what is drawn: triangles' vertices and whole spheres") {
  CHECK(ValueOf(Fixture().Text(), "bounds") == "x 0 to 13, y -3 to 3, z -3 to 3");
  Fixture empty;
  empty.scene.indices.clear();
  empty.scene.spheres.clear();
  CHECK(ValueOf(empty.Text(), "bounds") == "empty");
}

TEST_CASE("SceneText: the film's memory is that of its crop window") {
  const std::string text = Fixture().Text();
  CHECK(ValueOf(text, "film") ==
        "64x32, pixels 32 to 64 by 0 to 32, gaussian filter of 1.5x1.5 "
        "pixels");
  CHECK(text.find("48.00 KiB") != std::string::npos);  // 32 x 32 pixels of 48 bytes
}

TEST_CASE("SceneText: warnings come last, or none") {
  Fixture f;
  CHECK(f.Text().find("Warnings\n  none\n") != std::string::npos);
  f.scene.warnings = {"a.pbrt:3: odd"};
  CHECK(f.Text().find("Warnings\n  a.pbrt:3: odd\n") != std::string::npos);
}

TEST_CASE("SceneText: a scene without light says so") {
  Fixture f;
  f.tables.lights.clear();
  CHECK(ValueOf(f.Text(), "lights") == "0; the picture will be black");
}

}  // namespace
}  // namespace swell
