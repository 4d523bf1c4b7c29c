// What swell info says of a scene.
#include "src/cli/scene_text.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
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
    scene.left_out_triangles = 3;
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

  SceneFacts Facts() const {
    SceneFacts facts = CollectFacts(scene, tables, kinds, {5, 6, 2, 2048});
    facts.seconds = {{"import", 0.25}, {"build", 0.5}};
    facts.peak_rss_bytes = {{"import", 4096}, {"build", std::nullopt}};
    return facts;
  }
  std::string Text() const { return SceneText(Facts()); }
  nlohmann::json Json() const { return nlohmann::json::parse(SceneJson(Facts())); }
};

TEST_CASE("SceneText: counts what is there") {
  const std::string text = Fixture().Text();
  CHECK(ValueOf(text, "meshes") == "1");
  CHECK(ValueOf(text, "triangles") == "1");
  CHECK(ValueOf(text, "left out") == "3 triangles without area");
  CHECK(ValueOf(text, "spheres") == "1");
  CHECK(ValueOf(text, "vertices") == "4");
  CHECK(ValueOf(text, "materials") == "3 (2 diffuse, 1 mirror)");
  CHECK(ValueOf(text, "lights") == "2 (1 infinite, 1 triangle)");
  CHECK(text.find("mirror#2: mirror") != std::string::npos);
  CHECK(ValueOf(text, "nodes") == "5");
  CHECK(ValueOf(text, "tree") == "2.00 KiB");
  CHECK(ValueOf(text, "peak at import") == "4.00 KiB");
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

TEST_CASE("SceneText: textures by file, size and memory") {
  Fixture f;
  CHECK(f.Text().find("Textures\n  none\n") != std::string::npos);
  Pixels pixels;
  pixels.width = 8;
  pixels.height = 4;
  pixels.values.resize(pixels.size());
  f.scene.images.push_back(MakeTexelImage(pixels, Levels::kOne));
  f.scene.images.back().name = "wood.png";
  f.scene.image_lights.emplace_back();
  f.scene.image_lights.back().image = f.scene.images.back();
  const std::string text = f.Text();
  CHECK(text.find("wood.png  texture") != std::string::npos);
  CHECK(text.find("8x4") != std::string::npos);
  CHECK(text.find("3 x floats") != std::string::npos);
  const nlohmann::json json = f.Json();
  REQUIRE(json["textures"].size() == 2);
  CHECK(json["textures"][0]["file"] == "wood.png");
  CHECK(json["textures"][0]["width"] == 8);
  CHECK(json["textures"][0]["bytes"] >= 8 * 4 * 3 * 4);
  CHECK(json["textures"][1]["use"] == "light");
  CHECK(json["memory_bytes"]["textures"] >= json["textures"][0]["bytes"]);
  CHECK(json["memory_bytes"]["images of lights"] == json["textures"][1]["bytes"]);
}

TEST_CASE("SceneJson: holds what the text holds") {
  Fixture f;
  f.scene.warnings = {"a.pbrt:3: odd"};
  const nlohmann::json json = f.Json();
  CHECK(json["schema"] == 1);
  CHECK(json["meshes"] == 1);
  CHECK(json["triangles"] == nlohmann::json{{"unique", 1}, {"instanced", 1}, {"left_out", 3}});
  CHECK(json["spheres"]["unique"] == 1);
  CHECK(json["materials"]["by_kind"] == nlohmann::json{{"diffuse", 2}, {"mirror", 1}});
  CHECK(json["materials"]["list"][0] == nlohmann::json{{"name", "wall"}, {"kind", "diffuse"}});
  CHECK(json["lights"]["by_type"] == nlohmann::json{{"triangle", 1}, {"infinite", 1}});
  CHECK(json["bounds"]["high"][0] == 13);
  CHECK(json["camera"]["type"] == "perspective");
  CHECK(json["film"]["width"] == 64);
  CHECK(json["tree"]["nodes"] == 5);
  CHECK(json["memory_bytes"]["tree"] == 2048);
  CHECK(json["seconds"] == nlohmann::json{{"import", 0.25}, {"build", 0.5}});
  CHECK(json["peak_rss_bytes"] == nlohmann::json{{"import", 4096}, {"build", nullptr}});
  CHECK(json["warnings"][0] == nlohmann::json{{"text", "a.pbrt:3: odd"}, {"count", 1}});
  f.scene.indices.clear();
  f.scene.spheres.clear();
  CHECK(f.Json()["bounds"].is_null());
}

TEST_CASE("GroupWarnings: those that differ in place, names and numbers only are one") {
  const std::vector<WarningFacts> groups =
      GroupWarnings({"a.mtl:3: texture 'x.png' does not exist", "a.obj:9: 12 triangles are gone",
                     "b.mtl:4: texture 'y.png' does not exist (and 2 more like it)",
                     "c.obj: 7 triangles are gone", "c.obj: odd (and so on)"});
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].text == "a.mtl:3: texture 'x.png' does not exist");
  CHECK(groups[0].count == 4);
  CHECK(groups[1].count == 2);
  CHECK(groups[2].text == "c.obj: odd (and so on)");
  CHECK(groups[2].count == 1);
}

}  // namespace
}  // namespace swell
