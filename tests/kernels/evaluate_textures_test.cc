// Hits on textured surfaces in; parameters and normals out, against a scalar reference.
#include "kernels/evaluate_textures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "src/wave/table.h"
#include "tests/reference/texture.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

constexpr size_t kCount = 1000;

TexelImage Noise(uint32_t width, uint32_t height, uint32_t channels) {
  std::mt19937 random(4);
  Pixels pixels{width, height, channels, TexelFormat::kByte, {}, {}, {}};
  for (size_t code = 0; code < 256; ++code) pixels.decode[code] = float(code) / 255;
  for (size_t i = 0; i < pixels.size(); ++i) pixels.codes.push_back(uint8_t(random()));
  return MakeTexelImage(pixels, Levels::kAll);
}

struct TextureScene {
  SceneBuilder builder;
  Scene& scene = builder.scene;

  uint32_t Add(TextureOp op, std::initializer_list<uint32_t> inputs = {},
               std::initializer_list<float> values = {}) {
    TextureStep step;
    step.op = op;
    std::copy(inputs.begin(), inputs.end(), step.input);
    std::copy(values.begin(), values.end(), step.value);
    step.octaves = 5;
    scene.texture_nodes.push_back(step);
    return uint32_t(scene.texture_nodes.size() - 1);
  }
  TextureStep& step(uint32_t node) { return scene.texture_nodes[node]; }
  // A normal map of one texel.
  void AddNormalMap(std::vector<float> texel) {
    scene.images = {
        MakeTexelImage({1, 1, 3, TexelFormat::kFloat, {}, std::move(texel), {}}, Levels::kAll)};
    scene.materials[0].normal_map = Add(TextureOp::kImage, {}, {1});
  }

  // A slanted rectangle with uvs, and a stretched sphere.
  TextureScene() {
    Shape& mesh = builder.AddMesh({0, 0, 1, 4, 0, 1.5f, 4, 3, 2, 0, 3, 1.5f}, {0, 1, 2, 0, 2, 3});
    mesh.record.uv_offset = 0;
    scene.uvs = {0, 0, 2, 0.5f, 2, 1.5f, -1, 1};
    builder.AddSphere({1.5f, 0.2f, 0, 9, 0.1f, 0.7f, 0.3f, 2, 0, 0.2f, 1, 5});
  }
};

// Random hits on all primitives; hits.u and hits.v are weights.
struct Hits {
  Table<RayFields> rays{kCount};
  Table<HitFields> hits{kCount};
  std::vector<uint32_t> rows = std::vector<uint32_t>(kCount + kRowPadding);
  std::vector<reference::TexturedPoint> points;

  explicit Hits(const Scene& scene) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (size_t i = 0; i < kCount; ++i) {
      rows[i] = uint32_t(kCount - 1 - i);
      points.push_back(i % 3 == 2 ? OnSphere(scene, i, uniform(random), uniform(random))
                                  : OnTriangle(scene, i, uniform(random), uniform(random)));
    }
  }

 private:
  void Put(size_t i, const reference::Vector& p, const reference::Vector& dir, float t) {
    const RaysOut r = rays.Columns();
    r.org.x[i] = float(p.x - t * dir.x);
    r.org.y[i] = float(p.y - t * dir.y);
    r.org.z[i] = float(p.z - t * dir.z);
    r.dir.x[i] = float(dir.x);
    r.dir.y[i] = float(dir.y);
    r.dir.z[i] = float(dir.z);
    hits.Columns().t[i] = t;
  }
  reference::TexturedPoint OnTriangle(const Scene& scene, size_t i, float b1, float b2) {
    if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
    const uint32_t prim = i % 2;
    const uint32_t* index = &scene.indices[3 * prim];
    const double weight[3] = {1.0 - b1 - b2, b1, b2};
    reference::TexturedPoint at{};
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) at.p[c] += weight[k] * scene.positions[3 * index[k] + c];
      at.u += weight[k] * scene.uvs[2 * index[k]];
      at.v += weight[k] * scene.uvs[2 * index[k] + 1];
    }
    for (int c = 0; c < 4 && !scene.colors.empty(); ++c) {
      at.color[c] = 0;
      for (int k = 0; k < 3; ++k) at.color[c] += weight[k] * scene.colors[4 * index[k] + c];
    }
    const auto corner = [&](int k) {
      const float* p = &scene.positions[3 * index[k]];
      return reference::Vector{p[0], p[1], p[2]};
    };
    const reference::Vector n =
        reference::Normalize(reference::Cross(corner(1) - corner(0), corner(2) - corner(0)));
    at.n = {double(n.x), double(n.y), double(n.z)};
    Put(i, {at.p[0], at.p[1], at.p[2]}, {0, 0, -1}, 2);
    hits.Columns().prim[i] = prim;
    hits.Columns().u[i] = b1;
    hits.Columns().v[i] = b2;
    return at;
  }
  reference::TexturedPoint OnSphere(const Scene& scene, size_t i, float a, float b) {
    const double z = 1 - 1.96 * a - 0.02, phi = 2 * std::numbers::pi * (0.01 + 0.98 * b);
    const double r = std::sqrt(1 - z * z);
    const reference::Vector object{r * std::cos(phi), r * std::sin(phi), z};
    const SphereRecord& sphere = scene.spheres[0];
    const auto p = reference::TransformPoint(sphere.object_to_world, object);
    const auto n = reference::Normalize(reference::TransformNormal(sphere.world_to_object, object));
    Put(i, p, n * -1, 1);
    hits.Columns().prim[i] = 2;
    hits.Columns().u[i] = hits.Columns().v[i] = 0;
    return {{double(p.x), double(p.y), double(p.z)},
            {double(n.x), double(n.y), double(n.z)},
            phi / (2 * std::numbers::pi),
            1 - std::acos(z) / std::numbers::pi};
  }
};

// The three words of the node's value, for all rows, then the normals if there are any.
WordColumns Evaluate(const SceneTables& tables, Hits& hits, Width width, size_t count = kCount,
                     float spread = 0) {
  WordColumns out(6, count);
  const auto words = out.Pointers();
  float* columns[kMaxTextureSteps] = {};
  for (int c = 0; c < 3; ++c) columns[c] = reinterpret_cast<float*>(words[c]);
  PixelFootprint pixel{};
  pixel.spread = spread;
  EvaluateTexturesArgs args{&tables.view,
                            tables.view.textures.material_program[0],
                            pixel,
                            hits.rows.data(),
                            count,
                            hits.rays.ReadColumns(),
                            hits.hits.ReadColumns(),
                            columns,
                            {}};
  args.normals.x = reinterpret_cast<float*>(words[3]);
  args.normals.y = reinterpret_cast<float*>(words[4]);
  args.normals.z = reinterpret_cast<float*>(words[5]);
  EvaluateTextures(width, args);
  return out;
}

// Evaluates `node` as the first three words of material 0 and compares with the reference; some
// texture may jump where a point lies within rounding of an edge.
void CheckTexture(TextureScene& t, uint32_t node, double tolerance, size_t most_wrong) {
  t.scene.materials[0].textures = {{node, 0, 3, -100.0f, 100.0f}};
  const SceneTables tables = FinishScene(t.scene);
  Hits hits(t.scene);
  std::vector<reference::Color> expected;
  for (size_t i = 0; i < kCount; ++i) {
    expected.push_back(reference::EvaluateTexture(t.scene, node, hits.points[hits.rows[i]]));
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", op ",
         int(t.step(node).op), ", mapping ", int(t.step(node).mapping), ", wrap ",
         int(t.step(node).wrap), ", filter ", int(t.step(node).filter));
    for (size_t count : kRowCounts) {
      const WordColumns out = Evaluate(tables, hits, width, count);
      size_t wrong = 0;
      double worst = 0;
      for (size_t i = 0; i < count; ++i) {
        double difference = 0;
        for (int c = 0; c < 3; ++c) {
          difference = std::max(difference, std::abs(out.Float(c, i) - expected[i][c]));
        }
        wrong += difference > tolerance;
        if (difference <= tolerance) worst = std::max(worst, difference);
      }
      CAPTURE(worst);
      CHECK(wrong <= most_wrong);
    }
  });
  CheckSameBits([&](Width width) { return Evaluate(tables, hits, width).Rows(); });
}

const TextureMapping kMappings[] = {TextureMapping::kUv, TextureMapping::kSpherical,
                                    TextureMapping::kCylindrical, TextureMapping::kPlanar,
                                    TextureMapping::kUvAffine};

void SetMapping(TextureStep& step, TextureMapping mapping) {
  step.mapping = mapping;
  const float uv[8] = {3, 2, 0.1f, 0.2f};
  const float planar[8] = {0.5f, 0.2f, 0.1f, 0, 0.3f, 1, 0.25f, -1};
  std::copy_n(mapping == TextureMapping::kPlanar ? planar : uv, 8, step.map);
  const float from_world[12] = {0.5f, 0.1f, 0, 0.3f, 0, 0.4f, 0.1f, 0.2f, 0.1f, 0, 0.6f, 0.7f};
  std::copy_n(from_world, 12, step.texture_from_world);
}

}  // namespace

TEST_CASE("EvaluateTextures: every texture is the reference's, in every mapping") {
  for (TextureMapping mapping : kMappings) {
    TextureScene t;
    const uint32_t red = t.Add(TextureOp::kConstant, {}, {0.9f, 0.2f, 0.1f});
    const uint32_t blue = t.Add(TextureOp::kConstant, {}, {0.1f, 0.3f, 0.8f});
    const uint32_t bilerp =
        t.Add(TextureOp::kBilerp, {}, {0, 0.1f, 0.2f, 1, 0, 0, 0, 1, 0, 0.3f, 0.2f, 1});
    const uint32_t checker = t.Add(TextureOp::kCheckerboard2, {red, bilerp});
    const uint32_t dots = t.Add(TextureOp::kDots, {checker, blue});
    for (uint32_t node : {bilerp, checker, dots}) SetMapping(t.step(node), mapping);
    CheckTexture(t, bilerp, 2e-5, 0);
    CheckTexture(t, checker, 2e-5, 3);
    CheckTexture(t, dots, 2e-5, 5);
  }
}

TEST_CASE("EvaluateTextures: textures of space and of others are the reference's") {
  TextureScene t;
  const uint32_t red = t.Add(TextureOp::kConstant, {}, {0.9f, 0.2f, 0.1f});
  const uint32_t blue = t.Add(TextureOp::kConstant, {}, {0.1f, 0.3f, 0.8f});
  const uint32_t fbm = t.Add(TextureOp::kFbm, {}, {0.6f});
  const uint32_t wrinkled = t.Add(TextureOp::kWrinkled, {}, {0.6f});
  const uint32_t windy = t.Add(TextureOp::kWindy);
  const uint32_t marble = t.Add(TextureOp::kMarble, {}, {0.5f, 2.0f, 0.7f});
  const uint32_t cubes = t.Add(TextureOp::kCheckerboard3, {red, blue});
  for (uint32_t node : {fbm, wrinkled, windy, marble, cubes}) {
    SetMapping(t.step(node), TextureMapping::kUv);
  }
  CheckTexture(t, fbm, 2e-5, 0);
  CheckTexture(t, wrinkled, 2e-5, 0);
  CheckTexture(t, windy, 2e-5, 0);
  CheckTexture(t, marble, 5e-5, 0);
  CheckTexture(t, cubes, 1e-6, 3);
  const uint32_t mix = t.Add(TextureOp::kMix, {red, marble, wrinkled});
  CheckTexture(t, mix, 5e-5, 0);
  CheckTexture(t, t.Add(TextureOp::kScale, {mix, wrinkled}), 5e-5, 0);
  CheckTexture(t, t.Add(TextureOp::kDirectionMix, {mix, blue}, {0.6f, 0, 0.8f}), 5e-5, 0);
}

TEST_CASE("EvaluateTextures: images wrap and filter as the reference") {
  for (TextureWrap wrap : {TextureWrap::kRepeat, TextureWrap::kBlack, TextureWrap::kClamp,
                           TextureWrap::kOctahedral, TextureWrap::kMirror}) {
    for (TextureFilter filter :
         {TextureFilter::kPoint, TextureFilter::kBilinear, TextureFilter::kTrilinear}) {
      TextureScene t;
      t.scene.images = {Noise(7, 5, 1), Noise(16, 16, 3)};
      const uint32_t image = t.Add(TextureOp::kImage, {}, {0.75f});
      TextureStep& step = t.step(image);
      step.wrap = wrap;
      step.filter = filter;
      step.image = filter == TextureFilter::kPoint ? 0 : 1;
      step.invert = wrap == TextureWrap::kClamp;
      const float map[4] = {0.9f, -0.6f, 0.05f, 0.3f};  // at most one image away
      std::copy_n(map, 4, step.map);
      CheckTexture(t, image, filter == TextureFilter::kPoint ? 1e-6 : 1e-4,
                   filter == TextureFilter::kPoint ? 3 : 0);
    }
  }
}

TEST_CASE("EvaluateTextures: an image wraps along its axes by two rules") {
  const TextureWrap wraps[] = {TextureWrap::kRepeat, TextureWrap::kBlack, TextureWrap::kClamp,
                               TextureWrap::kMirror};
  for (TextureWrap along_s : wraps) {
    for (TextureWrap along_t : wraps) {
      TextureScene t;
      t.scene.images = {Noise(7, 5, 3)};
      const uint32_t image = t.Add(TextureOp::kImage, {}, {1});
      t.step(image).wrap = along_s;
      t.step(image).wrap_t = along_t;
      const float map[4] = {0.9f, -0.6f, 0.05f, 0.3f};  // at most one image away
      std::copy_n(map, 4, t.step(image).map);
      CheckTexture(t, image, 1e-4, 0);
    }
  }
}

TEST_CASE("EvaluateTextures: colours of vertices are as between them, white on spheres; steps") {
  TextureScene t;
  t.scene.colors = {1, 0, 0, 1, 0, 0.5f, 0, 0.5f, 0.2f, 0, 1, 0, 0.4f, 0.3f, 0.1f, 0.25f};
  const uint32_t color = t.Add(TextureOp::kVertexColor, {}, {0});
  const uint32_t alpha = t.Add(TextureOp::kVertexColor, {}, {1});
  CheckTexture(t, color, 1e-5, 0);
  CheckTexture(t, alpha, 1e-5, 0);
  CheckTexture(t, t.Add(TextureOp::kStep, {alpha}, {0.4f}), 1e-5, 1);
  // The last vertex has none: its triangle is white.
  Hits hits(t.scene);
  t.scene.colors.resize(12);
  t.scene.materials[0].textures = {{color, 0, 3, 0, 1}};
  const SceneTables tables = FinishScene(t.scene);
  const WordColumns out = Evaluate(tables, hits, Width::kWide);
  for (size_t i = 0; i < kCount; ++i) {
    if (hits.hits.Columns().prim[hits.rows[i]] == 1) REQUIRE(out.Float(1, i) == 1.0f);
  }
}

TEST_CASE("EvaluateTextures: a wide pixel sees the mean, a narrow one the texture") {
  TextureScene t;
  t.scene.images = {Noise(32, 32, 1)};
  const uint32_t one = t.Add(TextureOp::kConstant, {}, {1, 1, 1});
  const uint32_t zero = t.Add(TextureOp::kConstant, {}, {0, 0, 0});
  const uint32_t image = t.Add(TextureOp::kImage, {}, {1});
  t.step(image).filter = TextureFilter::kTrilinear;
  const uint32_t checker = t.Add(TextureOp::kCheckerboard2, {one, zero});
  const float mean = TexelAt(t.scene.images[0], 5, 0, 0)[0];
  for (const auto& [node, expected, tolerance] :
       {std::tuple{image, mean, 1e-6f}, {checker, 0.5f, 0.02f}}) {
    t.scene.materials[0].textures = {{node, 0, 3, 0, 1}};
    const SceneTables tables = FinishScene(t.scene);
    Hits hits(t.scene);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target));
      const WordColumns out = Evaluate(tables, hits, width, kCount, 5.0f);
      for (size_t i = 0; i < kCount; ++i)
        REQUIRE(std::abs(out.Float(0, i) - expected) <= tolerance);
    });
  }
}

TEST_CASE("EvaluateTextures: values are brought into the parameter's range") {
  TextureScene t;
  const uint32_t value = t.Add(TextureOp::kConstant, {}, {-3, 0.4f, 7});
  t.scene.materials[0].textures = {{value, 0, 3, 0.1f, 0.9f}};
  const SceneTables tables = FinishScene(t.scene);
  Hits hits(t.scene);
  const WordColumns out = Evaluate(tables, hits, Width::kWide, 16);
  CHECK(out.Float(0, 3) == 0.1f);
  CHECK(out.Float(1, 3) == 0.4f);
  CHECK(out.Float(2, 3) == 0.9f);
}

TEST_CASE("EvaluateTextures: a bump tilts the normal by the slope of its heights") {
  // Heights rise along the plane x = p.x by 0.5 per length: the normal of a level plane leans back.
  TextureScene t;
  t.scene.positions = {0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1};
  t.scene.uvs = {0, 0, 1, 0, 1, 1, 0, 1};
  const uint32_t ramp = t.Add(TextureOp::kBilerp, {}, {0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 2, 2});
  t.scene.materials[0].displacement = ramp;
  const SceneTables tables = FinishScene(t.scene);
  Hits hits(t.scene);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const WordColumns out = Evaluate(tables, hits, width);
    for (size_t i = 0; i < kCount; ++i) {
      if (hits.rows[i] % 3 == 2) continue;  // the sphere
      const reference::Vector n = At(out, 3, i);
      REQUIRE(reference::Length(n - reference::Normalize({-0.5L, 0, 1})) < 1e-3);
    }
  });
}

// The normal of every hit on the mesh is `expected`.
void CheckNormals(const Scene& scene, const reference::Vector& expected, float spread = 0.0f) {
  const SceneTables tables = FinishScene(scene);
  Hits hits(scene);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const WordColumns out = Evaluate(tables, hits, width, kCount, spread);
    for (size_t i = 0; i < kCount; ++i) {
      if (hits.rows[i] % 3 == 2) continue;
      REQUIRE(reference::Length(At(out, 3, i) - expected) < 1e-5);
    }
  });
}

TEST_CASE("EvaluateTextures: a normal map's colours are normals in the frame of dp/du") {
  TextureScene t;
  t.scene.positions = {0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1};
  t.scene.uvs = {0, 0, 0, 2, -2, 2, -2, 0};  // u runs along -y, v along x
  t.AddNormalMap({0.8f, 0.5f, 0.9f});
  CheckNormals(t.scene, reference::Normalize({0, -0.6L, 0.8L}));
}

TEST_CASE("EvaluateTextures: a normal map that follows v leans to it where u and v are mirrored") {
  for (bool mirrored : {false, true}) {
    TextureScene t;
    t.scene.positions = {0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1};
    const float v = mirrored ? -1.0f : 1.0f;
    t.scene.uvs = {0, 0, 1, 0, 1, v, 0, v};
    t.AddNormalMap({0.5f, 0.8f, 0.9f});
    t.scene.materials[0].normal_map_follows_v = true;
    INFO("mirrored: ", mirrored);
    CheckNormals(t.scene, reference::Normalize({0, 0.6L * v, 0.8L}));
  }
}

TEST_CASE("EvaluateTextures: a normal map lies as its step says, unfiltered") {
  // Two texels, of which only the second leans; seen twice as large, at the second coordinates.
  TextureScene t;
  t.scene.positions = {0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1};
  t.scene.uvs = {0, 0, 1, 0, 1, 1, 0, 1, 0.4f, 0, 0.4f, 0, 0.4f, 0, 0.4f, 0};
  t.scene.shapes[0].second_uv_offset = 4;
  Pixels pixels{2, 1, 3, TexelFormat::kFloat, {}, {0.5f, 0.5f, 1, 0.8f, 0.5f, 0.9f}, {}};
  t.scene.images = {MakeTexelImage(pixels, Levels::kAll)};
  const uint32_t node = t.Add(TextureOp::kImage, {}, {1});
  t.step(node).filter = TextureFilter::kPoint;
  t.step(node).second_uvs = 1;
  t.step(node).map[0] = 2;
  t.scene.materials[0].normal_map = node;
  CheckNormals(t.scene, reference::Vector{0.6, 0, 0.8}, /*spread=*/100.0f);
}

TEST_CASE("EvaluateTextures: a normal map leans along the vertices' tangents, y by their side") {
  for (const float side : {1.0f, -1.0f}) {
    TextureScene t;
    t.scene.positions = {0, 0, 1, 4, 0, 1, 4, 3, 1, 0, 3, 1};
    t.scene.uvs = {0, 0, 1, 0, 1, 1, 0, 1};
    for (int i = 0; i < 4; ++i) {
      t.scene.tangents.insert(t.scene.tangents.end(), {0, 1, 0, side});
    }
    t.scene.shapes[0].tangent_offset = 0;
    t.AddNormalMap({0.5f, 0.8f, 0.9f});
    t.scene.materials[0].normal_map_follows_v = true;
    INFO("side ", side);
    CheckNormals(t.scene, {-0.6L * side, 0, 0.8L});
  }
}

TEST_CASE("EvaluateTextures: a step of second coordinates sees those, a mesh without its first") {
  for (const bool has_second : {true, false}) {
    TextureScene t;
    t.scene.uvs.insert(t.scene.uvs.end(), {0.25f, 0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.25f, 0.5f});
    if (has_second) t.scene.shapes[0].second_uv_offset = 4;
    t.scene.shapes.back().second_uv_offset = 4;  // the sphere, so that the column is there
    const uint32_t first = t.Add(TextureOp::kBilerp, {}, {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
    const uint32_t second = t.Add(TextureOp::kBilerp, {}, {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
    t.step(second).second_uvs = 1;
    t.scene.materials[0].textures = {{second, 0, 3, -100, 100}};
    const SceneTables tables = FinishScene(t.scene);
    t.scene.materials[0].textures = {{first, 0, 3, -100, 100}};
    const SceneTables first_tables = FinishScene(t.scene);
    Hits hits(t.scene);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", second: ", has_second);
      const WordColumns out = Evaluate(tables, hits, width);
      const WordColumns by_first = Evaluate(first_tables, hits, width);
      for (size_t i = 0; i < kCount; ++i) {
        if (hits.rows[i] % 3 == 2) continue;
        const float u = has_second ? 0.25f : by_first.Float(0, i);
        const float v = has_second ? 0.5f : by_first.Float(1, i);
        REQUIRE(out.Float(0, i) == doctest::Approx(u).epsilon(1e-5));
        REQUIRE(out.Float(1, i) == doctest::Approx(v).epsilon(1e-5));
      }
    });
  }
}

}  // namespace swell::test
