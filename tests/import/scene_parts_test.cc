// Meshes and images that several threads read: the scene is that of one thread.
#include "src/import/scene_parts.h"

#include <tbb/global_control.h>

#include <cstring>

#include "src/import/read_meter.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

// A strip of `count` triangles at height z.
std::string Strip(uint32_t count, double z, bool normals) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count + 2) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (normals) text += "property float nx\nproperty float ny\nproperty float nz\n";
  text += "element face " + std::to_string(count) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  for (uint32_t i = 0; i < count + 2; ++i) {
    text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " " + std::to_string(z) +
            (normals ? " 0 0 1\n" : "\n");
  }
  for (uint32_t i = 0; i < count; ++i) {
    text +=
        "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  }
  return text;
}

template <class T> bool SameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::string ManyParts(const test::TemporaryFolder& folder) {
  std::string text = "WorldBegin LightSource \"infinite\"\n";
  for (uint32_t i = 0; i < 60; ++i) {
    const std::string name = std::to_string(i) + ".ply";
    folder.Write(name, Strip(1 + (i * 37) % 400, i, i % 3 == 0));
    const std::string number = std::to_string(i);
    if (i % 10 == 0) text += "ObjectBegin \"o" + number + "\"\n";
    text += "Shape \"plymesh\" \"string filename\" \"" + name + "\"\n";
    if (i % 4 == 0) text += "Translate 0 0 .5 Shape \"sphere\" Shape \"disk\"\n";
    if (i % 10 == 1) text += "ObjectEnd\nObjectInstance \"o" + std::to_string(i - 1) + "\"\n";
    if (i % 7 == 0) text += "Material \"diffuse\" \"float reflectance\" ." + number + "\n";
  }
  return folder.Write("scene.pbrt", text);
}

}  // namespace

TEST_CASE("scene parts: any number of threads makes the same scene, to the bit") {
  const test::TemporaryFolder folder;
  const std::string path = ManyParts(folder);
  const auto read = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Result<Scene> scene = ImportScene({path});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    return std::move(*scene);
  };
  const Scene one = read(1);
  CHECK(one.shapes.size() == 60 + 2 * 15);
  CHECK(one.objects.size() == 6);
  CHECK(one.instances.size() == 6);
  for (const size_t threads : {2, 3, 8}) {
    CAPTURE(threads);
    for (int round = 0; round < 5; ++round) {
      const Scene scene = read(threads);
      CHECK(SameBytes(scene.positions, one.positions));
      CHECK(SameBytes(scene.normals, one.normals));
      CHECK(SameBytes(scene.uvs, one.uvs));
      CHECK(SameBytes(scene.indices, one.indices));
      CHECK(SameBytes(scene.prim_shape, one.prim_shape));
      CHECK(SameBytes(scene.spheres, one.spheres));
      CHECK(SameBytes(scene.instances, one.instances));
      REQUIRE(scene.shapes.size() == one.shapes.size());
      for (size_t i = 0; i < one.shapes.size(); ++i) {
        CHECK(std::memcmp(&scene.shapes[i].record, &one.shapes[i].record, sizeof(ShapeRecord)) ==
              0);
      }
      REQUIRE(scene.objects.size() == one.objects.size());
      for (size_t i = 0; i < one.objects.size(); ++i) {
        CHECK(scene.objects[i].first_triangle == one.objects[i].first_triangle);
        CHECK(scene.objects[i].triangle_count == one.objects[i].triangle_count);
        CHECK(scene.objects[i].first_sphere == one.objects[i].first_sphere);
      }
      CHECK(scene.warnings == one.warnings);
    }
  }
}

TEST_CASE("scene parts: meshes lie in the order of the file, each with its own rows") {
  const test::TemporaryFolder folder;
  folder.Write("a.ply", Strip(300, 1, true));
  folder.Write("b.ply", Strip(2, 2, false));
  const Result<Scene> scene = ImportScene({folder.Write(
      "scene.pbrt",
      "WorldBegin LightSource \"infinite\" Shape \"plymesh\" \"string filename\" \"a.ply\"\n"
      "Shape \"sphere\" Shape \"plymesh\" \"string filename\" \"b.ply\"\n"
      "Shape \"plymesh\" \"string filename\" \"a.ply\"")});
  REQUIRE(scene);
  REQUIRE(scene->shapes.size() == 4);
  CHECK(scene->shapes[0].record.first_prim == 0);
  CHECK(scene->shapes[2].record.first_prim == 300);
  CHECK(scene->shapes[3].record.first_prim == 302);
  for (const size_t shape : {0, 2, 3}) {
    const ShapeRecord& record = scene->shapes[shape].record;
    for (uint32_t prim = record.first_prim; prim < record.first_prim + record.prim_count; ++prim) {
      CHECK(scene->prim_shape[prim] == shape);
      const uint32_t vertex = scene->indices[3 * prim];
      CHECK(scene->positions[3 * vertex + 2] == (shape == 2 ? 2.0f : 1.0f));
      if (shape == 2) continue;
      CHECK(scene->normals[3 * (vertex + record.normal_offset) + 2] == 1.0f);
    }
  }
  CHECK(scene->shapes[2].record.normal_offset == kNone);
}

TEST_CASE("scene parts: triangles without area are counted in all of them, those of imports too") {
  const test::TemporaryFolder folder;
  const std::string point =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 3\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 0 1\n3 2 2 2\n";
  folder.Write("point.ply", point);
  const std::string ply = "Shape \"plymesh\" \"string filename\" \"point.ply\"\n";
  const std::string flat =
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2 0 0 1]\n";
  folder.Write("inner.pbrt", ply + flat);
  const Result<Scene> scene = ImportScene({folder.Write(
      "scene.pbrt", "WorldBegin\n" + flat + ply + "Import \"inner.pbrt\"\nObjectBegin \"o\"\n" +
                        ply + "ObjectEnd\nObjectInstance \"o\"\nObjectInstance \"o\"\n" + flat)});
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  CHECK(scene->triangle_count() == 6);
  CHECK(scene->left_out_triangles == 1 + 2 + (2 + 1) + 2 + 1);
}

TEST_CASE("scene parts: balls, disks and their parts leave no triangles out") {
  const test::TemporaryFolder folder;
  const Result<Scene> scene = ImportScene({folder.Write(
      "scene.pbrt",
      "WorldBegin Shape \"sphere\" Shape \"disk\" Shape \"sphere\" \"float zmax\" .5\n"
      "Shape \"cylinder\" Shape \"disk\" \"float phimax\" 90\n")});
  REQUIRE(scene);
  CHECK(scene->left_out_triangles == 0);
}

TEST_CASE("scene parts: a mesh that is named often is read once and placed each time") {
  const test::TemporaryFolder folder;
  const std::string ply = Strip(300, 1, true);
  folder.Write("a.ply", ply);
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"a.ply\"\n";
  const std::string text = "WorldBegin LightSource \"infinite\"\n" + mesh + "Translate 0 0 1\n" +
                           mesh + "ObjectBegin \"o\"\n" + mesh + mesh +
                           "ObjectEnd ObjectInstance \"o\" Shape \"sphere\"\n"
                           "AreaLightSource \"diffuse\" ReverseOrientation Translate 0 0 1\n" +
                           mesh;
  const std::string path = folder.Write("scene.pbrt", text);
  for (int round = 0; round < 5; ++round) {
    const uint64_t before = TheInputBytes().opened;
    const Result<Scene> scene = ImportScene({path});
    REQUIRE(scene);
    CHECK(TheInputBytes().opened - before == text.size() + ply.size());
    REQUIRE(scene->shapes.size() == 6);
    CHECK(scene->triangle_count() == 5 * 300);
    const float heights[] = {1, 2, 2, 2, 0, 3};
    for (const size_t shape : {0, 1, 2, 3, 5}) {
      CAPTURE(shape);
      const ShapeRecord& record = scene->shapes[shape].record;
      CHECK(record.prim_count == 300);
      const uint32_t vertex = scene->indices[3 * size_t{record.first_prim} + 899];
      CHECK(scene->positions[3 * vertex + 2] == heights[shape]);
      CHECK(scene->positions[3 * vertex] == 150.0f);
      const float up = shape == 5 ? -1.0f : 1.0f;
      CHECK(scene->normals[3 * (vertex + record.normal_offset) + 2] == up);
      CHECK(scene->shapes[shape].emits == (shape == 5));
    }
  }
}

// Four places of the mesh of a file, one of them in a file that is imported, and of as many copies.
TEST_CASE("scene parts: a large mesh that the world has several times is held once") {
  const test::TemporaryFolder folder;
  const std::string ply = Strip(kLeastSharedTriangles, 1, true);
  for (const char* name : {"a.ply", "b.ply", "c.ply", "d.ply"}) folder.Write(name, ply);
  const auto read = [&](bool once) {
    const auto mesh = [&](const char* copy) {
      return "Shape \"plymesh\" \"string filename\" \"" + std::string(once ? "a" : copy) +
             ".ply\"\n";
    };
    folder.Write("part.pbrt", "Scale 1 2 3 " + mesh("c"));
    const std::string text = "WorldBegin LightSource \"infinite\" Shape \"disk\"\n" + mesh("a") +
                             "Rotate 30 1 2 3 " + mesh("b") +
                             "Import \"part.pbrt\" Translate 3 -4 5 Scale -.5 1 1 " + mesh("d");
    Result<Scene> scene = ImportScene({folder.Write("scene.pbrt", text)});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    return std::move(*scene);
  };
  const Scene flat = read(false), shared = read(true);
  REQUIRE(flat.shapes.size() == 5);
  REQUIRE(shared.shapes.size() == 2);
  REQUIRE(shared.objects.size() == 1);
  REQUIRE(shared.instances.size() == 4);
  const size_t disk = shared.shapes[0].record.prim_count;
  CHECK(shared.objects[0].name == folder / "a.ply");
  CHECK(shared.triangle_count() == disk + kLeastSharedTriangles);
  CHECK(flat.triangle_count() == disk + 4 * kLeastSharedTriangles);
  const size_t rows = kLeastSharedTriangles + 2;
  const size_t first = shared.positions.size() / 3 - rows;
  for (size_t i = 0; i < 4 * rows; ++i) {
    const InstanceRecord& instance = shared.instances[i / rows];
    const float* p = &shared.positions[3 * (first + i % rows)];
    for (size_t c = 0; c < 3; ++c) {
      const float* m = instance.to_world + 3 * c;
      const double world =
          instance.centre[c] + double{m[0]} * p[0] + double{m[1]} * p[1] + double{m[2]} * p[2];
      CHECK(world == doctest::Approx(flat.positions[3 * (first + i) + c]).epsilon(1e-5));
    }
  }
}

TEST_CASE("scene parts: meshes that are small, shine, differ or are in objects stay in the world") {
  const test::TemporaryFolder folder;
  folder.Write("large.ply", Strip(kLeastSharedTriangles, 1, true));
  folder.Write("small.ply", Strip(kLeastSharedTriangles - 1, 1, true));
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"large.ply\"\n";
  const std::string small = "Shape \"plymesh\" \"string filename\" \"small.ply\"\n";
  const auto objects = [&](const std::string& text) {
    const Result<Scene> scene = ImportScene({folder.Write("scene.pbrt", "WorldBegin\n" + text)});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    return scene->objects.size();
  };
  const std::string other = "Material \"diffuse\" \"float reflectance\" .1\n";
  CHECK(objects(mesh + mesh) == 1);
  CHECK(objects(small + small) == 0);
  CHECK(objects(mesh + other + mesh) == 0);
  CHECK(objects(mesh + mesh + other + mesh + mesh) == 2);
  CHECK(objects(mesh + "ReverseOrientation " + mesh) == 0);
  CHECK(objects("AreaLightSource \"diffuse\" " + mesh + mesh) == 0);
  CHECK(objects(mesh + "ObjectBegin \"o\" " + mesh + "ObjectEnd ObjectInstance \"o\"") == 1);
  CHECK(objects(mesh + "Scale 1e20 1 1 " + mesh) == 0);
}

TEST_CASE("scene parts: a bad mesh that is named often is told where it is named first") {
  const test::TemporaryFolder folder;
  folder.Write("bad.ply", "no mesh");
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"bad.ply\"\n";
  const Result<Scene> scene =
      ImportScene({folder.Write("scene.pbrt", "WorldBegin\n" + mesh + mesh + mesh)});
  REQUIRE(!scene);
  CAPTURE(scene.error().message);
  CHECK(scene.error().message.find("scene.pbrt:2: Shape 'plymesh': ") != std::string::npos);
}

TEST_CASE("scene parts: of several bad files the first in the file's order is told") {
  const test::TemporaryFolder folder;
  folder.Write("good.ply", Strip(1000, 0, false));
  folder.Write("bad1.ply", "ply\nformat ascii 2.0\n");
  folder.Write("bad2.ply", "no mesh");
  const auto mesh = [](const std::string& name) {
    return "Shape \"plymesh\" \"string filename\" \"" + name + "\"\n";
  };
  const std::string path =
      folder.Write("scene.pbrt", "WorldBegin\n" + mesh("good.ply") + mesh("bad1.ply") +
                                     mesh("bad2.ply") + "Shape \"cone\"");
  for (int round = 0; round < 10; ++round) {
    const Result<Scene> scene = ImportScene({path});
    REQUIRE(!scene);
    CAPTURE(scene.error().message);
    CHECK(scene.error().message.find("scene.pbrt:3: Shape 'plymesh': ") != std::string::npos);
    CHECK(scene.error().message.find("bad1.ply") != std::string::npos);
  }
}

TEST_CASE("scene parts: an object whose mesh comes to nothing has no instances") {
  const test::TemporaryFolder folder;
  folder.Write("nothing.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n");
  const Result<Scene> scene = ImportScene({folder.Write(
      "scene.pbrt",
      "WorldBegin LightSource \"infinite\"\n"
      "ObjectBegin \"empty\" Shape \"plymesh\" \"string filename\" \"nothing.ply\" ObjectEnd\n"
      "ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd\n"
      "ObjectInstance \"empty\" ObjectInstance \"ball\" ObjectInstance \"empty\"")});
  REQUIRE(scene);
  REQUIRE(scene->objects.size() == 1);
  CHECK(scene->objects[0].name == "ball");
  REQUIRE(scene->instances.size() == 1);
  CHECK(scene->instances[0].object == 0);
}

}  // namespace swell
