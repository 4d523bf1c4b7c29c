// Directives: what each does to the scene, with pbrt-v4's defaults.
#include <array>
#include <cmath>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

using Vec = std::array<float, 3>;

Vec Apply(const float* m, const Vec& p) {
  Vec image{};
  for (size_t r = 0; r < 3; ++r) {
    image[r] = m[4 * r] * p[0] + m[4 * r + 1] * p[1] + m[4 * r + 2] * p[2] + m[4 * r + 3];
  }
  return image;
}

void CheckNear(const Vec& got, const Vec& expected) {
  for (size_t c = 0; c < 3; ++c) {
    INFO(c);
    CHECK(std::abs(got[c] - expected[c]) < 1e-5f);
  }
}

// Where a sphere drawn behind `directives` has its point (1, 2, 3).
Vec ImageOf(const std::string& directives) {
  const Scene scene =
      test::WorldOf("LightSource \"infinite\"\n" + directives + "\nShape \"sphere\"");
  REQUIRE(!scene.spheres.empty());
  return Apply(scene.spheres.back().object_to_world, {1, 2, 3});
}

Camera CameraOf(const std::string& text) { return test::SceneOf(text + " WorldBegin").camera; }
RenderRequest RequestOf(const std::string& text) {
  return test::SceneOf(text + " WorldBegin").request;
}

}  // namespace

TEST_CASE("directives: transforms compose as in pbrt, the last one first") {
  CheckNear(ImageOf(""), {1, 2, 3});
  CheckNear(ImageOf("Translate 10 20 30"), {11, 22, 33});
  CheckNear(ImageOf("Translate 10 20 30 Scale 2 3 4"), {12, 26, 42});
  CheckNear(ImageOf("Scale 2 3 4 Translate 10 20 30"), {22, 66, 132});
  CheckNear(ImageOf("Rotate 90 0 0 1"), {-2, 1, 3});
  CheckNear(ImageOf("Translate 1 1 1 Identity"), {1, 2, 3});
  CheckNear(ImageOf("Scale -1 1 1"), {-1, 2, 3});
}

TEST_CASE("directives: matrices are written column by column; Transform replaces") {
  const std::string matrix = "[0 2 0 0  3 0 0 0  0 0 4 0  5 6 7 1]";
  CheckNear(ImageOf("Translate 9 9 9 Transform " + matrix), {11, 8, 19});
  CheckNear(ImageOf("Translate 1 0 0 ConcatTransform " + matrix), {12, 8, 19});
}

TEST_CASE("directives: LookAt maps the world into the camera") {
  CheckNear(ImageOf("LookAt 0 0 -5  0 0 0  0 1 0"), {1, 2, 8});
}

TEST_CASE("directives: attribute blocks restore the whole state") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Translate 1 0 0\n"
      "AttributeBegin Translate 5 5 5 ReverseOrientation Material \"glass\" "
      "AreaLightSource \"diffuse\" Shape \"sphere\" AttributeEnd Shape \"sphere\"\n"
      "TransformBegin Translate 1 0 0 TransformEnd Shape \"sphere\"");
  REQUIRE(scene.shapes.size() == 3);
  CHECK((scene.shapes[0].record.flags & kShapeFlipNormal) != 0);
  CHECK((scene.shapes[1].record.flags & kShapeFlipNormal) == 0);
  CHECK(scene.shapes[0].record.material != scene.shapes[1].record.material);
  CHECK(!scene.shapes[1].emits);
  CHECK(scene.spheres[0].object_to_world[3] == 6.0f);
  CHECK(scene.spheres[1].object_to_world[3] == 1.0f);
  CHECK(scene.spheres[2].object_to_world[3] == 1.0f);
}

TEST_CASE("directives: named coordinate systems come back") {
  CheckNear(ImageOf("Translate 1 1 1 CoordinateSystem \"here\" Identity "
                    "CoordSysTransform \"here\""),
            {2, 3, 4});
  CheckNear(ImageOf("Translate 1 1 1 CoordSysTransform \"world\""), {1, 2, 3});
  const Scene scene = test::SceneOf(
      "Translate 0 0 -7 Camera \"perspective\" WorldBegin LightSource \"infinite\" "
      "CoordSysTransform \"camera\" Shape \"sphere\"");
  CheckNear(Apply(scene.spheres[0].object_to_world, {0, 0, 0}), {0, 0, 7});
}

TEST_CASE("directives: without a Camera the view is pbrt's default") {
  const Scene scene = test::WorldOf("");
  CHECK(scene.camera.type == CameraType::kPerspective);
  CHECK(scene.camera.fov_degrees == 90.0f);
  CHECK(scene.camera.lens_radius == 0.0f);
  CHECK(scene.camera.focal_distance == 1e6f);
  CheckNear(Apply(scene.camera.camera_to_world.data(), {1, 2, 3}), {1, 2, 3});
}

TEST_CASE("directives: the camera stands where LookAt puts it and sees x to the right") {
  const Camera camera = CameraOf("LookAt 1 2 3  1 2 10  0 1 0 Camera \"perspective\"");
  CheckNear(Apply(camera.camera_to_world.data(), {0, 0, 0}), {1, 2, 3});
  CheckNear(Apply(camera.camera_to_world.data(), {0, 0, 1}), {1, 2, 4});
  CheckNear(Apply(camera.camera_to_world.data(), {1, 0, 0}), {2, 2, 3});
  // A mirrored camera swaps left and right.
  const Camera mirrored =
      CameraOf("Scale -1 1 1 LookAt 0 0 -5  0 0 0  0 1 0 Camera \"perspective\"");
  CheckNear(Apply(mirrored.camera_to_world.data(), {1, 0, 0}), {-1, 0, -5});
}

TEST_CASE("directives: camera parameters") {
  const Camera camera = CameraOf(
      "Camera \"perspective\" \"float fov\" 35 \"float screenwindow\" [-1 2 -3 4] "
      "\"float lensradius\" 0.25 \"float focaldistance\" 8 \"float frameaspectratio\" 1.5");
  CHECK(camera.fov_degrees == 35.0f);
  CHECK(camera.screen_window == std::array<float, 4>{-1, 2, -3, 4});
  CHECK(camera.lens_radius == 0.25f);
  CHECK(camera.focal_distance == 8.0f);
  CHECK(camera.frame_aspect_ratio == 1.5f);
  CHECK(CameraOf("Camera \"orthographic\"").type == CameraType::kOrthographic);
}

TEST_CASE("directives: the render request has pbrt's defaults") {
  const RenderRequest request = RequestOf("");
  CHECK(request.width == 1280);
  CHECK(request.height == 720);
  CHECK(request.samples_per_pixel == 16);
  CHECK(request.max_depth == 5);
  CHECK(request.image_scale == 1.0f);
  CHECK(request.max_component == 0.0f);
  CHECK(request.filter.type == FilterType::kGaussian);
  CHECK(request.filter.radius_x == 1.5f);
  CHECK(request.filter.a == 0.5f);
}

TEST_CASE("directives: film, sampler and integrator parameters") {
  const RenderRequest request = RequestOf(
      "Film \"rgb\" \"integer xresolution\" [640] \"integer yresolution\" 480 "
      "\"float cropwindow\" [0.5 0.25 0 1] \"string filename\" \"a.exr\" \"float iso\" 200 "
      "\"float exposuretime\" 0.25 \"float maxcomponentvalue\" 7 "
      "Sampler \"zsobol\" \"integer pixelsamples\" 128 \"integer seed\" -1 "
      "Integrator \"path\" \"integer maxdepth\" 65");
  CHECK(request.width == 640);
  CHECK(request.height == 480);
  CHECK(request.crop_window == std::array<float, 4>{0.25f, 0.5f, 0, 1});
  CHECK(request.filename == "a.exr");
  CHECK(request.image_scale == 0.5f);
  CHECK(request.max_component == 7.0f);
  CHECK(request.samples_per_pixel == 128);
  CHECK(request.seed == 0xFFFFFFFFu);
  CHECK(request.max_depth == 65);
}

TEST_CASE("directives: the shutter's time scales the exposure") {
  CHECK(RequestOf("Camera \"perspective\" \"float shutteropen\" 0 \"float shutterclose\" 0.5")
            .image_scale == 0.5f);
}

TEST_CASE("directives: pixel bounds become the crop window of the same pixels") {
  const RenderRequest request = RequestOf(
      "Film \"rgb\" \"integer xresolution\" 333 \"integer yresolution\" 77 "
      "\"integer pixelbounds\" [0 100 33 77]");
  const auto first = [](float edge, float size) { return std::ceil(edge * size); };
  CHECK(first(request.crop_window[0], 333) == 0);
  CHECK(first(request.crop_window[1], 333) == 100);
  CHECK(first(request.crop_window[2], 77) == 33);
  CHECK(first(request.crop_window[3], 77) == 77);
}

TEST_CASE("directives: filters have pbrt's parameters and defaults") {
  const struct {
    const char* text;
    FilterType type;
    float radius_x, radius_y, a, b;
  } kFilters[] = {
      {"\"box\"", FilterType::kBox, 0.5f, 0.5f, 0, 0},
      {"\"triangle\"", FilterType::kTriangle, 2, 2, 0, 0},
      {"\"gaussian\" \"float sigma\" 0.75", FilterType::kGaussian, 1.5f, 1.5f, 0.75f, 0},
      {"\"mitchell\" \"float B\" 0.5", FilterType::kMitchell, 2, 2, 0.5f, 1.0f / 3.0f},
      {"\"sinc\" \"float xradius\" 3", FilterType::kSinc, 3, 4, 3, 0},
  };
  for (const auto& row : kFilters) {
    INFO(std::string(row.text));
    const Filter filter = RequestOf(std::string("PixelFilter ") + row.text).filter;
    CHECK(filter.type == row.type);
    CHECK(filter.radius_x == row.radius_x);
    CHECK(filter.radius_y == row.radius_y);
    CHECK(filter.a == row.a);
    CHECK(filter.b == row.b);
  }
}

TEST_CASE("directives: samplers have pbrt's names") {
  const std::pair<const char*, SamplerKind> rows[] = {{"sobol", SamplerKind::kSobol},
                                                      {"zsobol", SamplerKind::kZSobol},
                                                      {"halton", SamplerKind::kHalton},
                                                      {"stratified", SamplerKind::kStratified},
                                                      {"independent", SamplerKind::kIndependent},
                                                      {"paddedsobol", SamplerKind::kSobol},
                                                      {"pmj02bn", SamplerKind::kSobol}};
  for (const auto& [name, kind] : rows) {
    INFO(name);
    CHECK(RequestOf("Sampler \"" + std::string(name) + "\"").sampler == kind);
  }
  CHECK(RequestOf("Sampler \"zsobol\" \"integer pixelsamples\" 9").samples_per_pixel == 9);
  CHECK(RequestOf("Film \"rgb\"").sampler == SamplerKind::kSobol);
}

TEST_CASE("directives: stratified samples count by their grid") {
  CHECK(RequestOf("Sampler \"stratified\" \"integer xsamples\" 3").samples_per_pixel == 12);
}

TEST_CASE("directives: the integrator's light sampler is asked for by pbrt's names") {
  const auto asked = [](const std::string& parameters) {
    return RequestOf("Integrator \"path\" " + parameters).light_sampler;
  };
  CHECK(asked("") == LightSampler::kAuto);
  CHECK(asked("\"string lightsampler\" \"uniform\"") == LightSampler::kUniform);
  CHECK(asked("\"string lightsampler\" \"power\"") == LightSampler::kPower);
  CHECK(asked("\"string lightsampler\" \"bvh\"") == LightSampler::kBvh);
}

TEST_CASE("directives: what changes nothing is accepted without a word") {
  const Scene scene = test::SceneOf(
      "ColorSpace \"srgb\" Accelerator \"bvh\" \"integer maxnodeprims\" 2\n"
      "Sampler \"sobol\" \"string randomization\" \"none\" MediumInterface \"\" \"\"\n"
      "Integrator \"path\" \"string lightsampler\" \"bvh\"\n"
      "WorldBegin LightSource \"infinite\" Shape \"sphere\"");
  CHECK(scene.warnings == std::vector<std::string>{});
}

TEST_CASE("directives: what is not supported is a warning with its place") {
  const struct {
    const char* text;
    const char* warning;
  } kRows[] = {
      {"Sampler \"pmj02bn\" WorldBegin", "Sampler 'pmj02bn': swell samples with 'sobol' instead"},
      {"Sampler \"paddedsobol\" WorldBegin", "swell samples with 'sobol' instead"},
      {"Sampler \"stratified\" \"bool jitter\" false WorldBegin", "swell's strata are jittered"},
      {"Integrator \"bdpt\" WorldBegin", "Integrator 'bdpt': rendered as 'path'"},
      {"Integrator \"path\" \"string lightsampler\" \"exhaustive\" WorldBegin",
       "light sampler 'exhaustive' is not supported; 'auto' is used"},
      {"Integrator \"path\" \"string lightsampler\" \"bhv\" WorldBegin",
       "unknown light sampler 'bhv'; did you mean 'bvh'?"},
      {"Option \"disablepixeljitter\" true WorldBegin",
       "option 'disablepixeljitter' is not supported"},
      {"MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" WorldBegin",
       "medium 'fog': it scatters light, which is not supported; the medium is left out"},
      {"MakeNamedMedium \"smoke\" \"string type\" \"nanovdb\" WorldBegin",
       "varies from place to place"},
      {"Camera \"spherical\" WorldBegin",
       "camera 'spherical' is not supported; a perspective camera of 90 degrees replaces it"},
      {"Camera \"realistic\" \"string lensfile\" \"lens.dat\" WorldBegin",
       "a perspective camera of 40 degrees"},
      {"WorldBegin LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 0]",
       "\"point3 portal\" is not supported and is ignored"},
      {"WorldBegin\nTexture \"t\" \"float\" \"ptex\" \"string filename\" \"t\"", ":2: Texture 't'"},
      {"WorldBegin ActiveTransform EndTime Translate 1 0 0 ActiveTransform All", "motion"},
      {"WorldBegin WorldEnd", "WorldEnd"},
      {"Camera \"perspective\" \"float fvo\" 3 WorldBegin", "did you mean 'fov'?"},
      {"WorldBegin", "scene.pbrt: the scene has no shapes"},
      {"WorldBegin Shape \"sphere\"", "scene.pbrt: the scene has no lights"},
  };
  for (const auto& row : kRows) {
    INFO(std::string(row.text));
    const Scene scene = test::SceneOf(row.text);
    std::string all;
    for (const std::string& warning : scene.warnings) all += warning + "\n";
    INFO(all);
    CHECK(test::Warns(scene, row.warning));
  }
}

TEST_CASE("directives: equal warnings are counted, not repeated") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\"\nShape \"sphere\" \"float u\" 1\nShape \"sphere\" \"float u\" 2\n"
      "Shape \"sphere\" \"float u\" 3\nShape \"sphere\"");
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0].find("scene.pbrt:3: ") != std::string::npos);
  CHECK(scene.warnings[0].find("(and 2 more like it)") != std::string::npos);
}

TEST_CASE("directives: transforms at the shutter's end leave no trace") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" "
      "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All Shape \"sphere\"");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(scene.spheres[0].object_to_world[3] == 0.0f);
}

TEST_CASE("directives: included files are read in place, relative to the scene or the includer") {
  const test::TemporaryFolder folder;
  folder.Write("parts/a.pbrt", "Translate 1 0 0\nInclude \"b.pbrt\"");
  folder.Write("parts/b.pbrt", "Translate 0 2 0");
  folder.Write("c.pbrt", "Translate 0 0 3 Shape \"sphere\"");
  folder.Write("parts/d.pbrt", "Include \"c.pbrt\"");
  const auto scene =
      ImportScene({folder.Write("scene.pbrt",
                                "WorldBegin LightSource \"infinite\" Include \"parts/a.pbrt\"\n"
                                "Include \"parts/d.pbrt\"")});
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  REQUIRE(scene->spheres.size() == 1);
  CheckNear(Apply(scene->spheres[0].object_to_world, {0, 0, 0}), {1, 2, 3});
}

TEST_CASE("directives: an imported file adds shapes but leaves the state alone") {
  const test::TemporaryFolder folder;
  folder.Write("part.pbrt", "Translate 1 0 0 Shape \"sphere\"");
  const auto scene = ImportScene({folder.Write(
      "scene.pbrt", "WorldBegin LightSource \"infinite\" Import \"part.pbrt\" Shape \"sphere\"")});
  REQUIRE(scene);
  REQUIRE(scene->spheres.size() == 2);
  CHECK(scene->spheres[0].object_to_world[3] == 1.0f);
  CHECK(scene->spheres[1].object_to_world[3] == 0.0f);
}

TEST_CASE("directives: several files are read as one") {
  const test::TemporaryFolder folder;
  const auto scene = ImportScene({folder.Write("a.pbrt",
                                               "Film \"rgb\" \"integer xresolution\" 9 WorldBegin\n"
                                               "LightSource \"infinite\" Translate 1 0 0"),
                                  folder.Write("b.pbrt", "Shape \"sphere\"")});
  REQUIRE(scene);
  CHECK(scene->request.width == 9);
  CHECK(scene->spheres[0].object_to_world[3] == 1.0f);
}

}  // namespace swell
