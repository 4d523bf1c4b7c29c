// Texture directives, the parameters that name textures, and what cannot be read.
#include <cmath>

#include "src/import/read_image.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

// Two by two pixels in a portable pixmap: bytes 0, 51, 102 .. in order.
std::string Ppm() {
  std::string text = "P6\n2 2\n255\n";
  for (int i = 0; i < 12; ++i) text += static_cast<char>(20 * i);
  return text;
}

Result<Scene> ReadWith(const std::string& world) {
  const test::TemporaryFolder folder;
  folder.Write("image.ppm", Ppm());
  return ImportScene({folder.Write("scene.pbrt", "WorldBegin\n" + world)});
}

Scene SceneWith(const std::string& world) {
  Result<Scene> scene = ReadWith(world);
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

const TextureStep& LastNode(const Scene& scene) { return scene.texture_nodes.back(); }

const std::string kDots = "Texture \"dots\" \"spectrum\" \"dots\" \"rgb inside\" [1 0 0] ";

}  // namespace

TEST_CASE("textures: a constant texture costs nothing: it is the parameter's value") {
  const Scene scene = SceneWith(
      "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [0.1 0.2 0.3] "
      "Material \"diffuse\" \"texture reflectance\" \"c\" Shape \"sphere\"");
  CHECK(scene.materials[0].textures.empty());
  CHECK(scene.materials[0].params[1] == 0.2f);
}

TEST_CASE("textures: a varying one is bound to the parameter's words and range") {
  const Scene scene = SceneWith(kDots +
                                "Material \"glass\" \"texture tint\" \"dots\" Shape \"sphere\" "
                                "Material \"glass\" \"texture tint\" \"dots\" Shape \"sphere\"");
  REQUIRE(scene.materials.size() == 2);  // not merged
  REQUIRE(scene.materials[0].textures.size() == 1);
  const MaterialTexture& texture = scene.materials[0].textures[0];
  CHECK(scene.texture_nodes[texture.node].op == TextureOp::kDots);
  CHECK(texture.word == 1);
  CHECK(texture.count == 3);
  CHECK(texture.max == 20.0f);
}

TEST_CASE("textures: a parameter that is negative while unset is set by a texture") {
  const Scene scene =
      SceneWith(kDots + "Material \"conductor\" \"texture reflectance\" \"dots\" Shape \"sphere\"");
  CHECK(scene.materials[0].params[6] > 0.0f);
  CHECK(scene.materials[0].textures[0].min == 0.0f);
}

TEST_CASE("textures: inputs are numbers, colours or earlier textures") {
  const Scene scene =
      SceneWith(kDots +
                "Texture \"f\" \"float\" \"windy\" Texture \"m\" \"spectrum\" \"mix\" "
                "\"texture tex1\" \"dots\" \"texture amount\" \"f\"");
  const TextureStep& mix = LastNode(scene);
  REQUIRE(mix.op == TextureOp::kMix);
  CHECK(scene.texture_nodes[mix.input[0]].op == TextureOp::kDots);
  CHECK(scene.texture_nodes[mix.input[1]].value[2] == 1.0f);
  CHECK(scene.texture_nodes[mix.input[2]].op == TextureOp::kWindy);
  const TextureStep& dots = scene.texture_nodes[mix.input[0]];
  CHECK(scene.texture_nodes[dots.input[0]].value[0] == 1.0f);
  CHECK(scene.texture_nodes[dots.input[1]].value[0] == 0.0f);
}

TEST_CASE("textures: names of floats and of spectra are apart") {
  const Scene scene = SceneWith(
      "Texture \"t\" \"float\" \"constant\" \"float value\" 3 "
      "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 2 3]");
  CHECK(scene.texture_nodes.size() == 2);
}

TEST_CASE("textures: mappings, their scales and the space they stand in") {
  const Scene scene = SceneWith(
      "Translate 1 2 3 Scale 2 2 2 Texture \"t\" \"float\" \"checkerboard\" "
      "\"string mapping\" \"planar\" \"vector3 v1\" [0 0 1] \"float udelta\" 0.5");
  const TextureStep& step = LastNode(scene);
  CHECK(step.mapping == TextureMapping::kPlanar);
  CHECK(step.map[2] == 1.0f);
  CHECK(step.map[4] == 1.0f);
  CHECK(step.map[6] == 0.5f);
  CHECK(step.texture_from_world[0] == 0.5f);
  CHECK(step.texture_from_world[11] == -1.5f);
  CHECK(step.scale_from_world == 0.5f);
}

TEST_CASE("textures: a checkerboard of dimension 3 fills space") {
  const Scene scene = SceneWith("Texture \"t\" \"float\" \"checkerboard\" \"integer dimension\" 3");
  CHECK(LastNode(scene).op == TextureOp::kCheckerboard3);
}

TEST_CASE("textures: an image's wrap, filter, encoding and use") {
  const std::string image = "\"imagemap\" \"string filename\" \"image.ppm\" ";
  const Scene scene = SceneWith(
      "Texture \"a\" \"spectrum\" " + image + "\"string wrap\" \"clamp\" \"bool invert\" true " +
      "Texture \"b\" \"spectrum\" " + image + "\"string filter\" \"trilinear\" " +
      "Texture \"c\" \"spectrum\" " + image + "\"string encoding\" \"linear\" " +
      "Texture \"d\" \"float\" " + image + "\"string encoding\" \"linear\" " +
      "Texture \"e\" \"float\" " + image + "\"string encoding\" \"gamma 2\" \"float scale\" 3");
  REQUIRE(scene.texture_nodes.size() == 5);
  CHECK(scene.texture_nodes[0].wrap == TextureWrap::kClamp);
  CHECK(scene.texture_nodes[0].invert == 1);
  CHECK(scene.texture_nodes[1].filter == TextureFilter::kTrilinear);
  CHECK(scene.texture_nodes[4].value[0] == 3.0f);
  REQUIRE(scene.images.size() == 4);  // "a" and "b" share one
  const auto texel = [&](uint32_t node) {
    return TexelAt(scene.images[scene.texture_nodes[node].image], 0, 1, 0);
  };
  const double code = 80 / 255.0;
  CHECK(texel(0)[1] == doctest::Approx(std::pow((code + 0.055) / 1.055, 2.4)));
  CHECK(texel(2)[1] == doctest::Approx(code));
  CHECK(texel(3)[0] == doctest::Approx(code));  // the mean of 60, 80 and 100
  CHECK(texel(4)[0] ==
        doctest::Approx((60 * 60 + 80 * 80 + 100 * 100) / (3 * 255.0 * 255.0)).epsilon(1e-5));
  CHECK(scene.images[scene.texture_nodes[3].image].channels == 1);
}

TEST_CASE("textures: alpha, displacement and normal maps of shapes and materials") {
  const Scene scene = SceneWith(
      "Texture \"w\" \"float\" \"windy\" Material \"diffuse\" \"texture displacement\" \"w\" "
      "Shape \"sphere\" \"texture alpha\" \"w\" Shape \"sphere\" \"float alpha\" 0.5 "
      "Shape \"sphere\" \"float alpha\" 1 "
      "Material \"diffuse\" \"string normalmap\" \"image.ppm\" Shape \"sphere\"");
  CHECK(scene.texture_nodes[scene.materials[0].displacement].op == TextureOp::kWindy);
  CHECK(scene.texture_nodes[scene.shapes[0].alpha].op == TextureOp::kWindy);
  CHECK(scene.texture_nodes[scene.shapes[1].alpha].value[0] == 0.5f);
  CHECK(scene.shapes[2].alpha == kNoTexture);
  const TextureStep& normals = scene.texture_nodes[scene.materials[1].normal_map];
  CHECK(normals.op == TextureOp::kImage);
  CHECK(normals.value[0] == 1.0f);
  REQUIRE(normals.image == 0);
  CHECK(TexelAt(scene.images[0], 0, 0, 0)[2] == doctest::Approx(40 / 255.0));  // not sRGB
}

TEST_CASE("textures: an area light's image multiplies its radiance") {
  const Scene scene = SceneWith(
      "AreaLightSource \"diffuse\" \"string filename\" \"image.ppm\" \"float scale\" 4 "
      "Shape \"sphere\"");
  CHECK(scene.shapes[0].emission_image == 0);
  CHECK(scene.shapes[0].radiance[0] == 4.0f);
  CHECK(scene.image_lights[0].mapping == ImageMapping::kSurface);
}

TEST_CASE("textures: what cannot be one is an error with its place and a remedy") {
  const struct {
    const char* text;
    const char* fragment;
  } kRows[] = {
      {"Texture \"t\" \"color\" \"constant\"", "did you mean 'spectrum'?"},
      {"Texture \"t\" \"flaot\" \"constant\"", "did you mean 'float'?"},
      {"Texture \"t\" \"float\" \"chekcerboard\"", "did you mean 'checkerboard'?"},
      {"Texture \"t\" \"float\" \"windy\" Texture \"t\" \"float\" \"windy\"", "defined twice"},
      {"Texture \"t\" \"float\" \"scale\" \"texture tex\" \"t\"", "before this line"},
      {"Texture \"wood\" \"float\" \"windy\" Shape \"sphere\" \"texture alpha\" \"wod\"",
       "did you mean 'wood'?"},
      {"Texture \"t\" \"spectrum\" \"constant\" Shape \"sphere\" \"texture alpha\" \"t\"",
       "make it \"float\""},
      {"Texture \"t\" \"spectrum\" \"imagemap\"", "\"string filename\" is missing"},
      {"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\"",
       "not in the folder"},
      {"Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"image.ppm\" \"string wrap\" "
       "\"rep\"",
       "unknown value 'rep'"},
      {"Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"image.ppm\" "
       "\"string encoding\" \"srgb\"",
       "known: sRGB"},
      {"Texture \"t\" \"float\" \"fbm\" \"integer octaves\" 1000", "octaves"},
      {"Texture \"t\" \"float\" \"dots\" \"string mapping\" \"cube\"", "known: cylindrical"},
      {"Texture \"t\" \"float\" \"windy\" Material \"glass\" \"texture fresnel\" \"t\"",
       "wrong type"},
  };
  for (const auto& row : kRows) {
    INFO(std::string(row.text));
    const Result<Scene> scene = ReadWith(row.text);
    REQUIRE(!scene);
    INFO(scene.error().message);
    CHECK(scene.error().message.find("scene.pbrt:2: ") != std::string::npos);
    CHECK(scene.error().message.find(row.fragment) != std::string::npos);
  }
}

TEST_CASE("textures: a small file that claims a large picture is doubted before memory is taken") {
  const test::TemporaryFolder folder;
  // The header of an uncompressed TGA of 8000 x 8000 pixels of 24 bits.
  const std::string header("\0\0\2\0\0\0\0\0\0\0\0\0\x40\x1f\x40\x1f\x18\0", 18);
  const std::string path = folder.Write("t.tga", header + std::string(3000, '\0'));
  const Result<ReadPixels> read = ReadImagePixels(path, ImageUse::kColor, {});
  REQUIRE_FALSE(read);
  CHECK(read.error().message.find("t.tga: claims 8000 x 8000 pixels but has only") !=
        std::string::npos);
}

TEST_CASE("textures: a BMP of run lengths is doubted before the library unpacks it") {
  const test::TemporaryFolder folder;
  // Two pixels wide, 536870911 high from the top, 8 bits, run lengths of 8.
  const std::string text(
      "BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\xe0\1\0\x8\0\1\0\0\0", 34);
  const std::string path = folder.Write("t.bmp", text + std::string(28, '\0'));
  const Result<ReadPixels> read = ReadImagePixels(path, ImageUse::kColor, {});
  REQUIRE_FALSE(read);
  CHECK(read.error().message.find("t.bmp: has 2 x 536870911 pixels; at most 65536 a side") !=
        std::string::npos);
  // The library reads run lengths of 24 bits beyond what it has unpacked.
  std::string wide = text + std::string(28, '\0');
  wide.replace(22, 8, std::string("\1\0\0\0\1\0\x18\0", 8));
  const Result<ReadPixels> of_24 =
      ReadImagePixels(folder.Write("w.bmp", wide), ImageUse::kColor, {});
  REQUIRE_FALSE(of_24);
  CHECK(of_24.error().message.find("w.bmp: is no BMP") != std::string::npos);
}

TEST_CASE("textures: too many in one material is an error, not a crash") {
  std::string text = "Texture \"t0\" \"spectrum\" \"marble\" ";
  for (int i = 1; i < 30; ++i) {
    text += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"scale\" \"texture tex\" \"t" +
            std::to_string(i - 1) + "\" ";
  }
  CHECK(ReadWith(text + "Material \"diffuse\" \"texture reflectance\" \"t29\""));
  for (int i = 30; i < 90; ++i) {
    text += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"scale\" \"texture tex\" \"t" +
            std::to_string(i - 1) + "\" ";
  }
  const Result<Scene> scene =
      ReadWith(text + "Material \"diffuse\" \"texture reflectance\" \"t89\"");
  REQUIRE(!scene);
  CHECK(scene.error().message.find("at most 64") != std::string::npos);
  const Result<Scene> alpha = ReadWith(text +
                                       "Texture \"f\" \"float\" \"windy\" Shape \"sphere\" "
                                       "\"float alpha\" 0.5");
  CHECK(alpha);
}

}  // namespace swell
