// BuildBvh of millions: peaks of memory, bytes that are kept, and processor time.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <ctime>
#include <optional>
#include <string>

#include "src/bvh/bvh.h"
#include "src/bvh/expected_cost.h"
#include "src/stats/peak_rise.h"
#include "tests/support/bvh_scenes.h"

namespace swell::test {
namespace {

struct Built {
  Bvh bvh;
  double peak;     // bytes above those before
  double seconds;  // of processors
};

// With two threads, as each has memory of its own.
Built Build(const Scene& scene) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 2);
  Result<Bvh> bvh = Bvh();
  double seconds = 0;
  const std::optional<int64_t> peak = PeakRise([&] {
    const std::clock_t start = std::clock();
    bvh = BuildBvh(scene);
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  });
  REQUIRE(peak);
  REQUIRE(bvh);
  CHECK(ValidateBvh(*bvh, scene) == "");
  return {std::move(*bvh), static_cast<double>(*peak), seconds};
}

double MeshBytes(const Scene& scene) {
  return static_cast<double>(scene.positions.size() * sizeof(float) +
                             scene.indices.size() * sizeof(uint32_t));
}

// 2 side^2 triangles over a rough ground.
Scene HeightField(uint32_t side) {
  Scene scene;
  scene.positions.reserve(size_t{3} * (side + 1) * (side + 1));
  scene.indices.reserve(size_t{6} * side * side);
  const float step = 20.0f / static_cast<float>(side);
  for (uint32_t j = 0; j <= side; ++j) {
    for (uint32_t i = 0; i <= side; ++i) {
      const float x = static_cast<float>(i) * step, z = static_cast<float>(j) * step;
      float height = 0, size = 0.8f, frequency = 0.7f;
      for (int octave = 0; octave < 9; ++octave) {
        height +=
            size * std::sin(frequency * x + static_cast<float>(octave)) * std::cos(frequency * z);
        size *= 0.55f;
        frequency *= 2.1f;
      }
      scene.positions.insert(scene.positions.end(), {x, height, z});
    }
  }
  for (uint32_t j = 0; j < side; ++j) {
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t v = j * (side + 1) + i, w = v + side + 1;
      scene.indices.insert(scene.indices.end(), {v, w, w + 1, v, w + 1, v + 1});
    }
  }
  return scene;
}

// Leaning boxes of four sides, which are cut, on a floor that is cut from the root on.
Scene Pillars(uint32_t count) {
  Random random(60);
  Scene scene;
  AddTriangle(scene, {-10, 0, -10}, {10, 0, -10}, {10, 0, 10});
  AddTriangle(scene, {-10, 0, -10}, {10, 0, 10}, {-10, 0, 10});
  for (uint32_t i = 0; i < count; ++i) {
    const float x = random.Uniform(-9.5f, 9.5f), z = random.Uniform(-9.5f, 9.5f);
    const float height = random.Uniform(0.1f, 4.0f), half = random.Uniform(0.01f, 0.05f);
    const float lean_x = random.Uniform(-0.4f, 0.4f), lean_z = random.Uniform(-0.4f, 0.4f);
    const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
    for (const float h : {0.0f, height}) {
      for (const auto& [dx, dz] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        scene.positions.insert(scene.positions.end(),
                               {x + static_cast<float>(dx) * half + lean_x * h, h,
                                z + static_cast<float>(dz) * half + lean_z * h});
      }
    }
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t a = first + k, b = first + (k + 1) % 4;
      scene.indices.insert(scene.indices.end(), {a, b, b + 4, a, b + 4, a + 4});
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("large builds: of 4M triangles the peak is at most 3 times vertices and indices") {
  const Scene scene = HeightField(1414);
  const Built built = Build(scene);
  MESSAGE("peak ", built.peak / MeshBytes(scene), ", tree ",
          static_cast<double>(built.bvh.bytes()) / MeshBytes(scene));
  CHECK(built.peak <= 3 * MeshBytes(scene));
}

TEST_CASE("large builds: where triangles are cut the peak is at most a quarter above the tree") {
  const Scene scene = Pillars(37500);
  const Built built = Build(scene);
  const auto tree = static_cast<double>(built.bvh.bytes());
  MESSAGE("peak ", built.peak / MeshBytes(scene), ", tree ", tree / MeshBytes(scene));
  CHECK(FindExpectedCost(built.bvh).reference_count > 1.3 * scene.triangle_count());
  CHECK(built.peak <= 1.25 * tree);
}

TEST_CASE(
    "large builds: a million coincident triangles take about the time of a million of a mesh") {
  Scene scene;
  AddTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 1; i < 1000000; ++i) scene.indices.insert(scene.indices.end(), {0, 1, 2});
  const Built same = Build(scene), mesh = Build(HeightField(707));
  MESSAGE("processor seconds ", same.seconds, ", of a mesh ", mesh.seconds);
  CHECK(same.seconds <= 4 * mesh.seconds);
  CHECK(same.bvh.depth <= 8);
}

TEST_CASE("large builds: ten million instances take at most 150 bytes each, 210 at the peak") {
  constexpr uint32_t kCount = 10000000;
  for (const bool apart : {true, false}) {
    Scene scene;
    AddObject(scene, TriangleSoup(300, -0.5f, 0.5f, 0.1f, 61), 300, 0);
    scene.instances.reserve(kCount);
    Random random(62);
    for (uint32_t i = 0; i < kCount; ++i) {
      const Float3 at = apart ? random.Point(0, 3000) : Float3{1, 2, 3};
      AddInstance(scene, {1, 0, 0, at[0], 0, 1, 0, at[1], 0, 0, 1, at[2]}, 0);
    }
    REQUIRE(scene.instances.size() == kCount);
    const Built built = Build(scene);
    const double bytes = sizeof(InstanceRecord) + static_cast<double>(built.bvh.bytes()) / kCount;
    const double peak = sizeof(InstanceRecord) + built.peak / kCount;
    MESSAGE("bytes ", bytes, ", peak ", peak, ", depth ", built.bvh.depth);
    CHECK(bytes <= 150);
    CHECK(peak <= 210);
    CHECK(built.bvh.depth <= 16);
  }
}

}  // namespace swell::test
