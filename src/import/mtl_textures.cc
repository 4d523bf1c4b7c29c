// Finds and reads the images of MTL materials. What cannot be had is a warning: models travel
// without their textures often.
#include "src/import/mtl_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace swell {
namespace {

// Exporters write both kinds of slashes.
std::string PathOf(const MtlTexture& texture) {
  std::string name = texture.name;
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path(name);
  if (path.is_absolute() || texture.place.file == nullptr) return path.string();
  return (std::filesystem::path(*texture.place.file).parent_path() / path).string();
}

// Normals point away from the surface: on the whole far more blue than red and green, which are
// about one half.
bool LooksLikeNormals(const Pixels& pixels) {
  if (pixels.channels != 3) return false;
  double sum[3] = {0, 0, 0};
  for (size_t i = 0; i < pixels.size(); ++i) sum[i % 3] += pixels.Value(i);
  const double count = static_cast<double>(pixels.size()) / 3;
  return sum[2] / count > 0.65 && std::abs(sum[0] / count - 0.5) < 0.15 &&
         std::abs(sum[1] / count - 0.5) < 0.15;
}

// Pixels of three channels to one: their mean.
Pixels Heights(const Pixels& colors) {
  Pixels heights;
  heights.width = colors.width;
  heights.height = colors.height;
  heights.channels = 1;
  const size_t channels = colors.channels;
  heights.values.resize(heights.size());
  for (size_t i = 0; i < heights.values.size(); ++i) {
    float sum = 0.0f;
    for (size_t c = 0; c < channels; ++c) sum += colors.Value(channels * i + c);
    heights.values[i] = sum / static_cast<float>(channels);
  }
  return heights;
}

}  // namespace

uint32_t MtlTextures::Image(const MtlTexture& texture, MtlImageUse use) {
  const std::string path = PathOf(texture);
  const auto known = rows_.find({path, use});
  if (known != rows_.end()) return known->second;
  const uint32_t row = Read(path, use, texture.place);
  rows_[{path, use}] = row;
  return row;
}

uint32_t MtlTextures::Read(const std::string& path, MtlImageUse use, Place place) {
  Encoding encoding;
  const bool color = use == MtlImageUse::kColor || use == MtlImageUse::kLight;
  if (!color) encoding.curve = Encoding::Curve::kLinear;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    diagnostics_.Warn(place,
                      "texture " + Quote(path) + " does not exist; its material goes without");
    return kNoTexture;
  }
  const ImageUse as = use == MtlImageUse::kNumber ? ImageUse::kScalar : ImageUse::kColor;
  Result<ReadPixels> read = ReadImagePixels(path, as, encoding);
  if (!read) {
    diagnostics_.Warn(place, read.error().message + "; its material goes without");
    return kNoTexture;
  }
  if (read->not_finite > 0) {
    diagnostics_.Warn(place, path + ": " + std::to_string(read->not_finite) +
                                 " values are not finite; they count as 0");
  }
  if (use == MtlImageUse::kLight) {
    ImageLight light;
    light.mapping = ImageMapping::kSurface;
    light.image = MakeTexelImage(read->pixels, Levels::kOne);
    light.image.name = path;
    scene_.image_lights.push_back(std::move(light));
    return static_cast<uint32_t>(scene_.image_lights.size() - 1);
  }
  const auto row = static_cast<uint32_t>(scene_.images.size());
  if (use == MtlImageUse::kHeight) {
    looks_like_normals_[row] = LooksLikeNormals(read->pixels);
    if (!looks_like_normals_[row]) read->pixels = Heights(read->pixels);
  }
  scene_.images.push_back(MakeTexelImage(read->pixels, Levels::kAll));
  scene_.images.back().name = path;
  return row;
}

uint32_t MtlTextures::Add(const TextureStep& step) {
  scene_.texture_nodes.push_back(step);
  return static_cast<uint32_t>(scene_.texture_nodes.size() - 1);
}

uint32_t MtlTextures::Constant(const std::array<double, 3>& value) {
  TextureStep step;
  for (size_t c = 0; c < 3; ++c) step.value[c] = static_cast<float>(value[c]);
  return Add(step);
}

uint32_t MtlTextures::NormalMap(const MtlTexture& texture, MtlImageUse use) {
  const uint32_t image = Image(texture, use);
  return image == kNoTexture ? kNoTexture : Add(NormalMapStep(image));
}

uint32_t MtlTextures::Node(const MtlTexture& texture, MtlImageUse use,
                           const std::array<double, 3>& factor) {
  const uint32_t image = Image(texture, use);
  if (image == kNoTexture) return kNoTexture;
  TextureStep step;
  step.op = TextureOp::kImage;
  step.image = image;
  step.filter = TextureFilter::kTrilinear;
  step.wrap = texture.options.clamp ? TextureWrap::kClamp : TextureWrap::kRepeat;
  for (size_t i = 0; i < 2; ++i) {
    step.map[i] = static_cast<float>(texture.options.scale[i]);
    step.map[2 + i] = static_cast<float>(texture.options.origin_offset[i]);
  }
  const bool grey = factor[0] == factor[1] && factor[1] == factor[2];
  step.value[0] = grey ? static_cast<float>(factor[0]) : 1.0f;
  const uint32_t node = Add(step);
  if (grey) return node;
  TextureStep scale;
  scale.op = TextureOp::kScale;
  scale.input[0] = node;
  scale.input[1] = Constant(factor);
  return Add(scale);
}

}  // namespace swell
