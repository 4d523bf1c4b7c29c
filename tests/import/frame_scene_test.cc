// The automatic camera and light.
#include "src/import/frame_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "src/scene/objects.h"

namespace swell {
namespace {

using Double3 = std::array<double, 3>;

void AddTriangle(Scene& scene, const std::array<float, 9>& corners) {
  for (uint32_t i = 0; i < 3; ++i) {
    scene.indices.push_back(static_cast<uint32_t>(scene.positions.size() / 3 + i));
  }
  scene.positions.insert(scene.positions.end(), corners.begin(), corners.end());
  scene.prim_shape.push_back(0);
}

// Where a point is seen to the right of and above the middle of the frame, as shares of the shorter
// side's half, and its distance.
Double3 Seen(const Camera& camera, const Double3& p) {
  Double3 local{};
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t k = 0; k < 3; ++k) {
      const float* m = camera.camera_to_world.data() + 4 * k;
      local[axis] += m[axis] * (p[k] - m[3]);
    }
  }
  const double reach = local[2] * std::tan(camera.fov_degrees * std::numbers::pi / 360.0);
  return {local[0] / reach, local[1] / reach, local[2]};
}

// How far from the middle of the frame a point is seen; negative if it is behind the camera.
double OffCentre(const Camera& camera, const Double3& p) {
  const Double3 seen = Seen(camera, p);
  return seen[2] > 0.0 ? std::max(std::abs(seen[0]), std::abs(seen[1])) : -1.0;
}

double FurthestOff(const Scene& scene) {
  double most = 0.0;
  for (uint32_t index : scene.indices) {
    const float* p = &scene.positions[3 * index];
    const double off = OffCentre(scene.camera, {p[0], p[1], p[2]});
    REQUIRE(off >= 0.0);
    most = std::max(most, off);
  }
  return most;
}

}  // namespace

TEST_CASE("FrameCamera: everything is in the frame and fills it, whatever its shape and place") {
  const std::array<float, 9> shapes[] = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                         {-50, 0, 0, 50, 0, 0, 0, 0.1f, 0},
                                         {0, -1e-3f, 0, 0, 1e-3f, 0, 0, 0, 4e-3f},
                                         {1e5f, 7, 0, 1e5f + 300, 7, 100, 1e5f, 20, 500}};
  for (const std::array<float, 9>& shape : shapes) {
    Scene scene;
    AddTriangle(scene, shape);
    FrameCamera(scene);
    const double most = FurthestOff(scene);
    CHECK(most < 0.95);
    CHECK(most > 0.85);
  }
}

TEST_CASE("FrameCamera: what is near on one side and far on the other is still in the middle") {
  Scene scene;
  AddTriangle(scene, {-50, 0, 0, 50, 0, 0, 0, 0.1f, 0});
  FrameCamera(scene);
  const double left = Seen(scene.camera, {-50, 0, 0})[0], right = Seen(scene.camera, {50, 0, 0})[0];
  CHECK(left < -0.9);
  CHECK(right == doctest::Approx(-left).epsilon(1e-4));
}

TEST_CASE("FrameCamera: looks down from the front, with right on the right") {
  Scene scene;
  AddTriangle(scene, {-1, 0, 0, 1, 0, 0, 0, 1, 0});
  FrameCamera(scene);
  const Affine& m = scene.camera.camera_to_world;
  CHECK(m[0] > 0.8f);    // right is towards +x
  CHECK(m[4] == 0.0f);   // and level
  CHECK(m[5] > 0.8f);    // up
  CHECK(m[10] < -0.7f);  // forward is towards -z
  CHECK(m[6] < -0.2f);   // and downwards
  CHECK(m[11] > 0.0f);
}

TEST_CASE("FrameCamera: instances are in the frame") {
  Scene scene;
  AddTriangle(scene, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  scene.objects.push_back({"o", 0, 1, 0, 0});
  scene.instances.push_back(*PlaceObject({1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0}, 0));
  scene.instances.push_back(*PlaceObject({1, 0, 0, -100, 0, 1, 0, 0, 0, 0, 1, 0}, 0));
  FrameCamera(scene);
  for (double x : {-100.0, 101.0}) {
    const double off = OffCentre(scene.camera, {x, 0, 0});
    CHECK(off > 0.5);
    CHECK(off < 0.95);
  }
}

TEST_CASE("FrameCamera: a scene of nothing gets a camera of finite numbers") {
  Scene scene;
  FrameCamera(scene);
  for (float value : scene.camera.camera_to_world) CHECK(std::isfinite(value));
}

TEST_CASE("AddSoftSky: white in it is nearly white, and what faces up is brighter than down") {
  Scene scene;
  AddSoftSky(scene);
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].type == kImageInfiniteLight);
  REQUIRE(scene.lights[0].image == 0);
  const ImageLight& sky = scene.image_lights[0];
  CHECK(sky.infinite);
  double up = 0.0, down = 0.0;
  const ImageLevel& level = sky.image.levels[0];
  for (uint32_t y = 0; y < level.height; ++y) {
    const double angle = PixelSolidAngle(sky.image, sky.mapping, y);
    for (uint32_t x = 0; x < level.width; ++x) {
      const double cosine = PixelDirection(sky.image, sky.mapping, x, y)[1];
      const double sent = angle * std::abs(cosine) * TexelAt(sky.image, 0, x, y)[0];
      (cosine > 0.0 ? up : down) += sent / std::numbers::pi;
    }
  }
  CHECK(up > 0.9);
  CHECK(up < 1.0);  // what is white and level does not clip
  CHECK(down > 0.3);
  CHECK(down < 0.5);
}

}  // namespace swell
