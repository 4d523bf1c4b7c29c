// Defaults and overrides of a render: crop windows, file names, labels.
#include "src/cli/resolve.h"

#include <doctest/doctest.h>

namespace swell {
namespace {

TEST_CASE("CropPixels: the whole window is the whole frame") {
  const auto crop = CropPixels(1280, 720, {0, 1, 0, 1});
  REQUIRE(static_cast<bool>(crop));
  CHECK(crop->x0 == 0);
  CHECK(crop->y0 == 0);
  CHECK(crop->width() == 1280);
  CHECK(crop->height() == 720);
}

TEST_CASE("CropPixels: windows that share edges tile the frame") {
  for (const uint32_t size : {7u, 64u, 100u, 1280u, 65535u}) {
    for (const uint32_t parts : {2u, 3u, 7u}) {
      INFO(size, " pixels in ", parts);
      uint32_t next = 0;
      for (uint32_t i = 0; i < parts; ++i) {
        const float x0 = static_cast<float>(i) / static_cast<float>(parts);
        const float x1 = static_cast<float>(i + 1) / static_cast<float>(parts);
        const auto crop = CropPixels(size, 1, {x0, x1, 0, 1});
        REQUIRE(static_cast<bool>(crop));
        CHECK(crop->x0 == next);
        next = crop->x1;
      }
      CHECK(next == size);
    }
  }
}

TEST_CASE("CropPixels: round fractions of round sizes are exact") {
  const auto crop = CropPixels(1000, 100, {0.1f, 0.7f, 0.2f, 0.3f});
  REQUIRE(static_cast<bool>(crop));
  CHECK(crop->x0 == 100);
  CHECK(crop->x1 == 700);
  CHECK(crop->y0 == 20);
  CHECK(crop->y1 == 30);
}

TEST_CASE("CropPixels: a window between two pixels is an error") {
  CHECK(!CropPixels(10, 10, {0.11f, 0.19f, 0, 1}));
  CHECK(!CropPixels(10, 10, {0, 1, 0.51f, 0.59f}));
}

TEST_CASE("Override: the command line wins, the file fills the rest") {
  RenderRequest request;
  request.width = 100;
  request.height = 50;
  request.samples_per_pixel = 7;
  request.seed = 3;
  request.max_depth = 4000000000u;
  RenderCommand command;
  CHECK(Override(request, command).width == 100);
  CHECK(Override(request, command).samples_per_pixel == 7);
  CHECK(Override(request, command).seed == 3);
  CHECK(Override(request, command).max_depth == kMaxDepth);
  command.resolution = {{8, 9}};
  command.samples_per_pixel = 1;
  command.seed = 0;
  command.max_depth = 0;
  command.crop_window = {{0, 0.5f, 0, 0.5f}};
  const RenderRequest chosen = Override(request, command);
  CHECK(chosen.width == 8);
  CHECK(chosen.height == 9);
  CHECK(chosen.samples_per_pixel == 1);
  CHECK(chosen.seed == 0);
  CHECK(chosen.max_depth == 0);
  CHECK(chosen.crop_window[1] == 0.5f);
}

TEST_CASE("DefaultOutfile: the film's name if it is an image we write, else the scene's") {
  CHECK(DefaultOutfile("a.exr", "s.pbrt") == "a.exr");
  CHECK(DefaultOutfile("out/a.png", "s.pbrt") == "out/a.png");
  CHECK(DefaultOutfile("a.pfm", "dir.d/scene.pbrt") == "scene.exr");
  CHECK(DefaultOutfile("", "/x/y/scene.v2.pbrt") == "scene.v2.exr");
  CHECK(DefaultOutfile("", "scene") == "scene.exr");
  CHECK(DefaultOutfile("", "../.hidden") == ".hidden.exr");
  CHECK(DefaultOutfile(".exr", "scene.pbrt") == "scene.exr");
}

TEST_CASE("MaterialLabels: names where they are unique, else kind or name with the index") {
  MaterialInfo diffuse{}, mirror{};
  diffuse.name = "diffuse";
  mirror.name = "mirror";
  const MaterialInfo* const kinds[] = {&diffuse, &mirror};
  std::vector<Material> materials(5);
  materials[0].name = "wall";
  materials[2].kind = 1;
  materials[3].name = "twin";
  materials[4].name = "twin";
  CHECK(MaterialLabels(materials, kinds) ==
        std::vector<std::string>{"wall", "diffuse#1", "mirror#2", "twin#3", "twin#4"});
}

}  // namespace
}  // namespace swell
