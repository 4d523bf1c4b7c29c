// Import: files that are read at the same time as what follows, each with a copy of the state.
#include <tbb/global_control.h>

#include <cstring>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

template <class T> bool SameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void CheckSameMaterials(const Scene& a, const Scene& b) {
  REQUIRE(a.materials.size() == b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i) {
    CAPTURE(i);
    CHECK(a.materials[i].name == b.materials[i].name);
    CHECK(a.materials[i].kind == b.materials[i].kind);
    CHECK(a.materials[i].params == b.materials[i].params);
    CHECK(a.materials[i].normal_map == b.materials[i].normal_map);
    CHECK(a.materials[i].displacement == b.materials[i].displacement);
    REQUIRE(a.materials[i].textures.size() == b.materials[i].textures.size());
    for (size_t k = 0; k < a.materials[i].textures.size(); ++k) {
      CHECK(a.materials[i].textures[k].node == b.materials[i].textures[k].node);
    }
  }
  REQUIRE(a.mixes.size() == b.mixes.size());
  for (size_t i = 0; i < a.mixes.size(); ++i) CHECK(a.mixes[i].materials == b.mixes[i].materials);
}

void CheckSameScene(const Scene& a, const Scene& b) {
  CHECK(SameBytes(a.positions, b.positions));
  CHECK(SameBytes(a.normals, b.normals));
  CHECK(SameBytes(a.uvs, b.uvs));
  CHECK(SameBytes(a.indices, b.indices));
  CHECK(SameBytes(a.prim_shape, b.prim_shape));
  CHECK(SameBytes(a.spheres, b.spheres));
  CHECK(SameBytes(a.instances, b.instances));
  CHECK(SameBytes(a.lights, b.lights));
  CHECK(SameBytes(a.texture_nodes, b.texture_nodes));
  REQUIRE(a.shapes.size() == b.shapes.size());
  for (size_t i = 0; i < a.shapes.size(); ++i) {
    CAPTURE(i);
    CHECK(std::memcmp(&a.shapes[i].record, &b.shapes[i].record, sizeof(ShapeRecord)) == 0);
    CHECK(a.shapes[i].alpha == b.shapes[i].alpha);
    CHECK(a.shapes[i].radiance == b.shapes[i].radiance);
    CHECK(a.shapes[i].inside == b.shapes[i].inside);
  }
  REQUIRE(a.objects.size() == b.objects.size());
  for (size_t i = 0; i < a.objects.size(); ++i) {
    CHECK(a.objects[i].name == b.objects[i].name);
    CHECK(a.objects[i].first_triangle == b.objects[i].first_triangle);
    CHECK(a.objects[i].triangle_count == b.objects[i].triangle_count);
  }
  CheckSameMaterials(a, b);
  CHECK(a.media.size() == b.media.size());
  CHECK(a.images.size() == b.images.size());
  CHECK(a.warnings == b.warnings);
}

Result<Scene> ReadBy(size_t threads, const std::string& path) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return ImportScene({path});
}

// Reads with several numbers of threads; all find the same error, which is returned.
std::string ErrorOf(const std::string& path) {
  const Result<Scene> one = ReadBy(1, path);
  REQUIRE(!one);
  for (int round = 0; round < 20; ++round) {
    const Result<Scene> many = ReadBy(4, path);
    REQUIRE(!many);
    CHECK(many.error().message == one.error().message);
  }
  return one.error().message;
}

Scene Read(const std::string& path) {
  Result<Scene> scene = ReadBy(4, path);
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

bool Contains(const std::string& text, std::string_view fragment) {
  return text.find(fragment) != std::string::npos;
}

// A text that takes a while to read: `count` triangles of a mesh at height z.
std::string LongMesh(uint32_t count, double z) {
  std::string points = "Shape \"trianglemesh\" \"point3 P\" [", indices = "] \"integer indices\" [";
  for (uint32_t i = 0; i < count + 2; ++i) {
    points += std::to_string(i / 2) + " " + std::to_string(i % 2) + " " + std::to_string(z) + "\n";
  }
  for (uint32_t i = 0; i < count; ++i) {
    indices += std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  }
  return points + indices + "]\n";
}

constexpr char kWorld[] = "WorldBegin LightSource \"infinite\"\n";

// Everything that an imported file may hold or use.
std::string ManyImports(const test::TemporaryFolder& folder) {
  std::string text = kWorld;
  text +=
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3]"
      " \"rgb sigma_s\" [0 0 0]\n"
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3]\n"
      "MakeNamedMaterial \"border\" \"string type\" \"interface\"\n";
  for (uint32_t i = 0; i < 40; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i == 0 ? 0 : i - 1);
    std::string part = LongMesh(1 + (i * 37) % 400, i);
    part += "Texture \"u\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" ." + n +
            "\nMakeNamedMaterial \"m" + n +
            "\" \"string type\" \"diffuse\" \"texture reflectance\" \"u\"\n"
            "NamedMaterial \"m" +
            before + "\" Shape \"disk\"\nNamedMaterial \"m" + n +
            "\" Shape \"sphere\" \"texture alpha\" \"a\"\n"
            "Material \"diffuse\" \"float reflectance\" .25 \"unknown u\" Shape \"disk\"\n"
            "MakeNamedMedium \"inner" +
            n +
            "\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [3 2 1] \"rgb sigma_s\" [0 0 0]\n"
            "MediumInterface \"inner" +
            n +
            "\" \"fog\" NamedMaterial \"border\" Shape \"sphere\"\n"
            "LightSource \"point\" \"float scale\" " +
            n + "\n";
    if (i % 5 == 0) {
      part += "ObjectBegin \"o" + n + "\" " + LongMesh(3, 1) + "ObjectEnd\n";
    } else {
      part += "Translate 0 0 " + n + " ObjectInstance \"o" + std::to_string(i - i % 5) + "\"\n";
    }
    if (i % 8 == 0) {
      folder.Write("deep" + n + ".pbrt", LongMesh(5, .5) + "Shape \"disk\"");
      part += "Import \"deep" + n + ".pbrt\"\n";
    }
    const size_t bad = part.find("\"unknown u\"");
    part.replace(bad, 11, "\"float u\" 1");
    folder.Write(n + ".pbrt", part);
    if (i == 2) text += "Texture \"a\" \"float\" \"constant\" \"float value\" .5\n";
    if (i < 2) {
      folder.Write(n + ".pbrt", LongMesh(7, i) + "MakeNamedMaterial \"m" + n +
                                    "\" \"string type\" \"conductor\"\n"
                                    "ObjectBegin \"o" +
                                    std::to_string(i * 100) + "\" Shape \"disk\" ObjectEnd\n");
    }
    text += "Scale 1 1 1.01 Import \"" + n + ".pbrt\"\n";
    if (i % 3 == 0) text += "Material \"diffuse\" \"float reflectance\" ." + n + "\n";
    if (i % 7 == 0) text += "Shape \"disk\"\n";
  }
  return folder.Write("scene.pbrt", text);
}

}  // namespace

TEST_CASE("imports: any number of threads makes the same scene, to the bit") {
  const test::TemporaryFolder folder;
  const std::string path = ManyImports(folder);
  const Result<Scene> one = ReadBy(1, path);
  INFO((one ? "" : one.error().message));
  REQUIRE(one);
  CHECK(one->objects.size() == 9);
  CHECK(one->instances.size() == 31);
  CHECK(one->media.size() == 40);
  CHECK(one->lights.size() == 39);
  for (const size_t threads : {2, 3, 8}) {
    CAPTURE(threads);
    for (int round = 0; round < 5; ++round) {
      const Result<Scene> many = ReadBy(threads, path);
      REQUIRE(many);
      CheckSameScene(*one, *many);
    }
  }
}

TEST_CASE("imports: shapes lie in the order of the files, as if they were included") {
  const test::TemporaryFolder folder;
  std::string import, include;
  for (int i = 0; i < 30; ++i) {
    const std::string name = std::to_string(i) + ".pbrt";
    folder.Write(name, LongMesh(static_cast<uint32_t>(1 + i * 31 % 50), i) + "Shape \"sphere\"");
    const std::string between = "Translate 0 0 1 Shape \"disk\"\n";
    import += "Import \"" + name + "\" " + between;
    include += "AttributeBegin Include \"" + name + "\" AttributeEnd " + between;
  }
  const Scene a = Read(folder.Write("import.pbrt", kWorld + import));
  const Scene b = Read(folder.Write("include.pbrt", kWorld + include));
  CheckSameScene(a, b);
}

TEST_CASE("imports: a file begins with the state at its directive and leaves it alone") {
  const test::TemporaryFolder folder;
  folder.Write("part.pbrt",
               "Translate 1 0 0 Shape \"sphere\" Material \"conductor\" "
               "AttributeBegin ReverseOrientation AttributeEnd");
  const Scene scene = Read(folder.Write(
      "scene.pbrt",
      std::string(kWorld) +
          "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3]"
          " \"rgb sigma_s\" [0 0 0]\n"
          "Attribute \"shape\" \"float radius\" 3 MediumInterface \"fog\" \"\"\n"
          "Material \"diffuse\" \"float reflectance\" .125\n"
          "AreaLightSource \"diffuse\" \"rgb L\" [4 5 6] Translate 0 2 0\n"
          "Import \"part.pbrt\" Translate 0 0 3 Shape \"sphere\""));
  REQUIRE(scene.spheres.size() == 2);
  for (const Shape& shape : scene.shapes) {
    CHECK(scene.materials[shape.record.material].params[0] == 0.125f);
    CHECK(shape.radiance == std::array<float, 3>{4, 5, 6});
    CHECK(scene.media[shape.inside].name == "fog");
  }
  const auto& inner = scene.spheres[0].object_to_world;
  const auto& outer = scene.spheres[1].object_to_world;
  CHECK(std::array{inner[3], inner[7], inner[11]} == std::array{1.0f, 2.0f, 0.0f});
  CHECK(std::array{outer[3], outer[7], outer[11]} == std::array{0.0f, 2.0f, 3.0f});
  CHECK(inner[0] == 3.0f);
}

TEST_CASE("imports: an image on the light of the state is still its own in a file") {
  const test::TemporaryFolder folder;
  const std::string grey(12, '?');  // 0.747 thrice
  folder.Write("a.pfm", "PF\n1 1\n-1\n" + grey);
  folder.Write("b.pfm", "PF\n1 1\n-1\n" + grey);
  folder.Write("part.pbrt",
               "Shape \"disk\" AreaLightSource \"diffuse\" \"string filename\" "
               "\"b.pfm\" Shape \"disk\"");
  const Scene scene = Read(
      folder.Write("scene.pbrt", std::string(kWorld) +
                                     "AreaLightSource \"diffuse\" \"string filename\" \"a.pfm\"\n"
                                     "Import \"part.pbrt\" Import \"part.pbrt\""));
  REQUIRE(scene.shapes.size() == 4);
  REQUIRE(scene.image_lights.size() == 3);
  CHECK(scene.shapes[0].emission_image == scene.shapes[2].emission_image);
  CHECK(scene.shapes[1].emission_image != scene.shapes[3].emission_image);
}

TEST_CASE("imports: materials, media and objects are known in the whole scene") {
  const test::TemporaryFolder folder;
  folder.Write("names.pbrt",
               "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.5 .25 .125]\n"
               "MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\"\n"
               "MakeNamedMaterial \"x\" \"string type\" \"mix\""
               " \"string materials\" [\"m\" \"late\"]\n"
               "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3]"
               " \"rgb sigma_s\" [0 0 0]\n"
               "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd");
  folder.Write("uses.pbrt",
               "MediumInterface \"fog\" \"\" NamedMaterial \"x\" Shape \"sphere\" "
               "NamedMaterial \"m\" Shape \"disk\" ObjectInstance \"o\"");
  for (const char* text :
       {"Import \"names.pbrt\" Import \"uses.pbrt\" MakeNamedMaterial \"late\" \"string type\" "
        "\"conductor\"",
        "MakeNamedMaterial \"late\" \"string type\" \"conductor\" Import \"names.pbrt\" "
        "NamedMaterial \"m\" ObjectInstance \"o\" Shape \"disk\" MediumInterface \"fog\" \"\""}) {
    CAPTURE(text);
    const Scene scene = Read(folder.Write("scene.pbrt", kWorld + std::string(text)));
    CHECK(scene.instances.size() == 1);
    REQUIRE(scene.mixes.size() == 1);
    CHECK(scene.materials[scene.mixes[0].materials[0]].name == "m");
    CHECK(scene.materials[scene.mixes[0].materials[1]].name == "late");
    const Shape& disk = *std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const auto& s) {
      return (s.record.flags & kShapeIsSphere) == 0;
    });
    CHECK(scene.materials[disk.record.material].name == "m");
    CHECK(scene.materials[disk.record.material].params[1] == 0.25f);
    CHECK(scene.media.size() == 2);
  }
}

TEST_CASE("imports: textures and coordinate systems of a file are its own") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a", "b"}) {
    folder.Write(name + std::string(".pbrt"),
                 "Texture \"t\" \"float\" \"constant\" \"float value\" .5\n"
                 "CoordinateSystem \"here\" Shape \"disk\" \"texture alpha\" \"t\"");
  }
  const std::string both = std::string(kWorld) + "Import \"a.pbrt\" Import \"b.pbrt\"\n";
  CHECK(Read(folder.Write("scene.pbrt", both)).shapes.size() == 2);
  CHECK(Contains(ErrorOf(folder.Write("scene.pbrt", both + "CoordSysTransform \"here\"")),
                 "scene.pbrt:3: "));
  CHECK(
      Contains(ErrorOf(folder.Write("scene.pbrt", both + "Shape \"disk\" \"texture alpha\" \"t\"")),
               "there is no float texture 't' before this line"));
}

TEST_CASE("imports: names that are defined twice end in an error") {
  const test::TemporaryFolder folder;
  const std::string path = folder / "scene.pbrt";
  const auto error = [&](std::string_view file, std::string_view text) {
    folder.Write("part.pbrt", file);
    return ErrorOf(folder.Write("scene.pbrt", kWorld + std::string(text)));
  };
  const std::string part = folder / "part.pbrt";
  const std::string material = "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\n";
  CHECK(error(material, "Import \"part.pbrt\"\n" + material) ==
        part + ":1: material 'm' is defined twice; the other is in " + path + ":3");
  CHECK(Contains(error(material, "Import \"part.pbrt\" Import \"part.pbrt\""), "defined twice"));
  const std::string border = "MakeNamedMaterial \"m\" \"string type\" \"interface\"\n";
  CHECK(Contains(error(border, "Import \"part.pbrt\" " + border), "defined twice"));
  CHECK(Contains(error(border, border + "Import \"part.pbrt\""), "defined twice"));
  CHECK(Contains(error(border, "Import \"part.pbrt\" NamedMaterial \"m\" Shape \"disk\""),
                 "scene.pbrt:2: material 'm' is an interface; define it before it is used"));
  CHECK(Contains(error("NamedMaterial \"m\" Shape \"disk\"", "Import \"part.pbrt\" " + border),
                 "part.pbrt:1: material 'm' is an interface; define it before it is used"));
  const std::string medium = "MakeNamedMedium \"g\" \"string type\" \"homogeneous\"\n";
  CHECK(Contains(error(medium, medium + "Import \"part.pbrt\""), "medium 'g' is defined twice"));
  const std::string object = "ObjectBegin \"o\" Shape \"disk\" ObjectEnd\n";
  CHECK(Contains(error(object, object + "Import \"part.pbrt\""), "'o' is already defined at"));
}

TEST_CASE("imports: a file within an object adds to the object") {
  const test::TemporaryFolder folder;
  folder.Write("part.pbrt", "AreaLightSource \"diffuse\" Shape \"sphere\" ObjectInstance \"p\"");
  const Scene scene = Read(folder.Write(
      "scene.pbrt", std::string(kWorld) +
                        "ObjectBegin \"o\" Import \"part.pbrt\" Shape \"disk\" ObjectEnd\n"
                        "ObjectBegin \"p\" Shape \"disk\" ObjectEnd\n"
                        "ObjectInstance \"o\" Translate 1 0 0 ObjectInstance \"o\""));
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[0].sphere_count == 1);
  CHECK(scene.instances.size() == 4);
  for (const Shape& shape : scene.shapes) CHECK(!shape.emits);
  CHECK(test::Warns(scene, "an area light in an object does not shine"));
  folder.Write("part.pbrt", "ObjectInstance \"o\"");
  CHECK(Contains(ErrorOf(folder / "scene.pbrt"), "object 'o' contains itself"));
  folder.Write("part.pbrt", "ObjectBegin \"q\"");
  CHECK(Contains(ErrorOf(folder / "scene.pbrt"), "ObjectBegin inside of another object, 'o'"));
}

TEST_CASE("imports: of several errors the first in the files' order is told") {
  const test::TemporaryFolder folder;
  folder.Write("good.pbrt", LongMesh(2000, 1));
  folder.Write("slow.pbrt", LongMesh(5000, 1) + "Scale 0 0 0");
  folder.Write("fast.pbrt", "Oops");
  const auto error = [&](const std::string& text) {
    return ErrorOf(folder.Write("scene.pbrt", kWorld + text));
  };
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"bad.ply\"\n";
  folder.Write("bad.ply", "ply\nformat ascii 1.0\n");
  const std::string good = "Import \"good.pbrt\"\n", slow = "Import \"slow.pbrt\"\n",
                    fast = "Import \"fast.pbrt\"\n";
  CHECK(Contains(error(good + slow + good), "slow.pbrt:10004: a scale of 0"));
  CHECK(Contains(error(good + slow + fast + "Oops"), "slow.pbrt"));
  CHECK(Contains(error(good + fast + slow + "Oops"), "fast.pbrt:1: unknown directive 'Oops'"));
  CHECK(Contains(error(good + mesh + fast + slow), "scene.pbrt:3: Shape 'plymesh'"));
  CHECK(Contains(error(good + slow + mesh), "slow.pbrt"));
  folder.Write("mesh.pbrt", good + mesh + "Oops");
  CHECK(Contains(error(good + "Import \"mesh.pbrt\" " + fast), "mesh.pbrt:2: Shape 'plymesh'"));
  CHECK(Contains(error("Import \"none.pbrt\"\n" + fast), "scene.pbrt:2: Import: file 'none.pbrt'"));
}

TEST_CASE("imports: files that open or close too much, or stand before the world") {
  const test::TemporaryFolder folder;
  folder.Write("open.pbrt", "AttributeBegin\nTranslate 1 0 0");
  folder.Write("close.pbrt", "\nAttributeEnd");
  const auto error = [&](const std::string& text) {
    return ErrorOf(folder.Write("scene.pbrt", text));
  };
  CHECK(Contains(error(std::string(kWorld) + "Import \"open.pbrt\" AttributeEnd"),
                 "open.pbrt:1: AttributeBegin is never closed"));
  CHECK(Contains(error(std::string(kWorld) + "AttributeBegin Import \"close.pbrt\""),
                 "close.pbrt:2: AttributeEnd has no AttributeBegin before it"));
  CHECK(Contains(error("Import \"open.pbrt\""), "'Import' must come after WorldBegin"));
}

TEST_CASE("imports: cyclic, too deep or too many files end in an error") {
  const test::TemporaryFolder folder;
  const std::string path = folder.Write("scene.pbrt", std::string(kWorld) + "Import \"b.pbrt\"");
  folder.Write("b.pbrt", "\nInclude \"c.pbrt\"");
  folder.Write("c.pbrt", "Import \"b.pbrt\"");
  CHECK(Contains(ErrorOf(path), folder / "c.pbrt" + ":1: a file includes itself: " +
                                    folder / "b.pbrt" + " -> " + folder / "c.pbrt" + " -> "));
  folder.Write("c.pbrt", "Import \"scene.pbrt\"");
  CHECK(Contains(ErrorOf(path), "a file includes itself: " + path + " -> "));
  folder.Write("b.pbrt", "Import \"0.pbrt\"");
  for (int i = 0; i < 80; ++i) {
    folder.Write(std::to_string(i) + ".pbrt", "Import \"" + std::to_string(i + 1) + ".pbrt\"\n");
  }
  folder.Write("80.pbrt", "# the end");
  CHECK(Contains(ErrorOf(path), "files are included more than 64 deep"));
  for (int i = 0; i < 20; ++i) {
    const std::string next = "Import \"" + std::to_string(i + 1) + ".pbrt\"\n";
    folder.Write(std::to_string(i) + ".pbrt", next + next);
  }
  folder.Write("20.pbrt", "# the end");
  for (const size_t threads : {1, 4}) {
    const Result<Scene> scene = ReadBy(threads, path);
    REQUIRE(!scene);
    CHECK(scene.error().message == path + ": more than 32768 files are included");
  }
}

TEST_CASE("imports: an image that several files name is read once, and its fault told once") {
  const test::TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string pixels("PF\n1 1\n-1\n");
  for (int c = 0; c < 3; ++c) pixels.append(reinterpret_cast<const char*>(&nan), sizeof(nan));
  folder.Write("image.pfm", pixels);
  const std::string texture =
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"image.pfm\"\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"disk\"\n";
  folder.Write("a.pbrt", texture);
  folder.Write("b.pbrt", texture);
  const std::string path = folder.Write(
      "scene.pbrt", std::string(kWorld) + "Import \"a.pbrt\" Import \"b.pbrt\"\n" + texture);
  const Scene scene = Read(path);
  CHECK(scene.images.size() == 1);
  CHECK(scene.materials.size() == 3);
  for (int round = 0; round < 20; ++round) {
    const std::vector<std::string> warnings = Read(path).warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(Contains(warnings[0], folder / "a.pbrt" + ":1: "));
  }
}

TEST_CASE("imports: an option in a file is ignored with a warning") {
  const test::TemporaryFolder folder;
  folder.Write("part.pbrt", "Option \"seed\" 7 Shape \"disk\"");
  const Scene scene =
      Read(folder.Write("scene.pbrt", std::string(kWorld) + "Import \"part.pbrt\""));
  CHECK(scene.request.seed == 0);
  CHECK(test::Warns(scene, "an option of an imported file is ignored"));
}

}  // namespace swell
