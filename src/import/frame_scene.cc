// A scene that says nothing of its view or its light -> one with a camera that shows all of it, and
// a soft sky.
#include "src/import/frame_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/import/transform.h"
#include "src/scene/objects.h"

namespace swell {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

constexpr uint32_t kWidth = 1024, kHeight = 768, kSamples = 64;
constexpr uint32_t kDepth = 12;         // glass in front of glass
constexpr double kFovDegrees = 36.0;    // of the shorter side
constexpr double kFromRight = 30.0;     // degrees around the y axis, from +z
constexpr double kFromAbove = 20.0;     // degrees
constexpr double kMargin = 1.08;        // frame around what is shown
constexpr double kLeastDistance = 0.1;  // of the scene's size, to what is nearest

// The camera's axes, unit.
struct Frame {
  Point right, up, forward;
};

Point Direction(double around_degrees, double above_degrees) {
  const double around = around_degrees * kRadians, above = above_degrees * kRadians;
  return {std::sin(around) * std::cos(above), std::sin(above), std::cos(around) * std::cos(above)};
}

Frame AxesTowards(const Point& viewer) {
  Frame frame;
  frame.forward = {-viewer[0], -viewer[1], -viewer[2]};
  frame.right = *Normalized(Cross(frame.forward, {0, 1, 0}));
  frame.up = Cross(frame.right, frame.forward);
  return frame;
}

// Where the camera is nearest with all points added in the frame, as far from its left edge as from
// its right one, from its top as from its bottom; along the camera's axes, from `middle`.
class FittingView {
 public:
  FittingView(const Frame& frame, const Point& middle, double size)
      : frame_(frame), middle_(middle), near_(kLeastDistance * size) {}

  void Add(double x, double y, double z) {
    const Point p = {x - middle_[0], y - middle_[1], z - middle_[2]};
    const double depth = Dot(p, frame_.forward);
    across_.Add(Dot(p, frame_.right), depth * tangent_);
    along_.Add(Dot(p, frame_.up), depth * tangent_);
    nearest_ = std::min(nearest_, depth);
  }
  void AddCorners(const Bounds& box) {
    if (box.empty()) return;
    for (size_t corner = 0; corner < 8; ++corner) {
      const auto end = [&](size_t axis) {
        return (corner >> axis & 1) != 0 ? box.high[axis] : box.low[axis];
      };
      Add(end(0), end(1), end(2));
    }
  }
  Point Eye() const {
    const double back =
        std::max({across_.Back() / tangent_, along_.Back() / tangent_, near_ - nearest_});
    if (!std::isfinite(back) || !(back > 0.0)) return {0, 0, -1};
    return {across_.Middle(), along_.Middle(), -back};
  }

 private:
  // A pair of opposite edges: each is a plane at `tangent_` to the view, as far out as a point
  // pushes it. They meet at Middle(), Back() times 1 / tangent_ behind the middle.
  struct Edges {
    double high = -HUGE_VAL, low = -HUGE_VAL;
    void Add(double off, double spread) {
      high = std::max(high, off - spread);
      low = std::max(low, -off - spread);
    }
    double Middle() const { return (high - low) / 2; }
    double Back() const { return (high + low) / 2; }
  };

  const Frame& frame_;
  Point middle_;
  double near_, tangent_ = std::tan(kFovDegrees / 2 * kRadians) / kMargin;
  double nearest_ = HUGE_VAL;
  Edges across_, along_;
};

// Triangles by their vertices; spheres and instances, of which there may be many, by their box.
void AddEverything(const Scene& scene, const Bounds& all, FittingView& fit) {
  if (!scene.spheres.empty() || !scene.instances.empty()) return fit.AddCorners(all);
  for (uint32_t index : scene.indices) {
    const float* p = &scene.positions[3 * size_t{index}];
    fit.Add(p[0], p[1], p[2]);
  }
}

}  // namespace

void FrameCamera(Scene& scene) {
  scene.request.width = kWidth;
  scene.request.height = kHeight;
  scene.request.samples_per_pixel = kSamples;
  scene.request.max_depth = kDepth;
  const Bounds all = WorldBounds(scene);
  Point middle{}, size{};
  for (size_t axis = 0; axis < 3 && !all.empty(); ++axis) {
    middle[axis] = (all.low[axis] + all.high[axis]) / 2;
    size[axis] = all.high[axis] - all.low[axis];
  }
  const Frame frame = AxesTowards(Direction(kFromRight, kFromAbove));
  FittingView fit(frame, middle, std::hypot(size[0], size[1], size[2]));
  AddEverything(scene, all, fit);
  const Point eye = fit.Eye();

  Camera camera;
  camera.fov_degrees = static_cast<float>(kFovDegrees);
  Transform to_world;
  for (size_t axis = 0; axis < 3; ++axis) {
    to_world.m[4 * axis] = frame.right[axis];
    to_world.m[4 * axis + 1] = frame.up[axis];
    to_world.m[4 * axis + 2] = frame.forward[axis];
    to_world.m[4 * axis + 3] = middle[axis] + eye[0] * frame.right[axis] + eye[1] * frame.up[axis] +
                               eye[2] * frame.forward[axis];
  }
  camera.camera_to_world = ToAffine(to_world);
  scene.camera = camera;
}

void AddSoftSky(Scene& scene) {
  constexpr uint32_t kSide = 256;               // steps between pixels are not seen
  constexpr double kDim = 0.25, kBright = 1.7;  // radiance away from the key and towards it
  const Point key = Direction(kFromRight - 50.0, 50.0);
  ImageLight sky;
  sky.infinite = true;
  sky.mapping = ImageMapping::kEqualArea;
  Pixels pixels;
  pixels.width = pixels.height = kSide;
  pixels.channels = 1;
  pixels.values.resize(pixels.size());
  sky.image = MakeTexelImage(pixels, Levels::kOne);  // for the directions of its pixels
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const double along = 0.5 + 0.5 * Dot(PixelDirection(sky.image, sky.mapping, x, y), key);
      const double lobe = along * along * along;
      pixels.values[y * kSide + x] = static_cast<float>(kDim + (kBright - kDim) * lobe);
    }
  }
  sky.image = MakeTexelImage(pixels, Levels::kOne);

  LightRecord light{};
  light.type = kImageInfiniteLight;
  std::fill(std::begin(light.radiance), std::end(light.radiance), 1.0f);
  light.prim = kNone;
  light.sphere = kNone;
  light.image = static_cast<uint32_t>(scene.image_lights.size());
  scene.image_lights.push_back(std::move(sky));
  scene.lights.push_back(light);
}

void FrameScene(Scene& scene) {
  FrameCamera(scene);
  AddSoftSky(scene);
}

}  // namespace swell
