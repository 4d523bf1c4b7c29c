// Images that a glTF file's textures use -> rows of the scene's images, each decoded once.
#include "src/import/gltf_images.h"

#include <tbb/parallel_for.h>

#include <optional>

namespace swell {
namespace {

Encoding EncodingOf(bool srgb) {
  Encoding encoding;
  encoding.curve = srgb ? Encoding::Curve::kSrgb : Encoding::Curve::kLinear;
  return encoding;
}

// The normals of a map whose slopes are `scale` times as steep; they need not be of unit length.
Pixels Steeper(const Pixels& map, double scale) {
  Pixels steep = map;
  steep.format = TexelFormat::kHalf;
  steep.codes.clear();
  steep.values.resize(map.size());
  for (size_t i = 0; i < steep.values.size(); ++i) {
    const double value = map.Value(i);
    const bool height = i % 3 == 2;
    steep.values[i] = static_cast<float>(height ? value : (value * 2.0 - 1.0) * scale * 0.5 + 0.5);
  }
  return steep;
}

}  // namespace

uint32_t GltfImages::Row(int image, const GltfImageUse& use) {
  const auto next = static_cast<uint32_t>(scene_.images.size());
  const auto [at, is_new] =
      rows_.try_emplace(std::tuple(image, use.use, use.srgb, use.normals, use.normal_scale), next);
  if (is_new) {
    scene_.images.emplace_back();
    wanted_[image].push_back({next, use});
  }
  return at->second;
}

Result<uint32_t> GltfImages::EmissionRow(int image, const SurfaceLookup& lookup) {
  const std::tuple key(image, lookup.wrap, lookup.wrap_t, lookup.filter, lookup.second_uvs);
  if (const auto found = emission_rows_.find(key); found != emission_rows_.end()) {
    return found->second;
  }
  const Result<GltfFile::Image> source = file_.FindImage(image);
  if (!source) return source.error();
  const Result<std::vector<ReadPixels>> read =
      ReadImagePicks({source->path, source->bytes}, {{ImageUse::kColor, EncodingOf(true)}});
  if (!read) return read.error();
  ImageLight light;
  light.mapping = ImageMapping::kSurface;
  light.lookup = lookup;
  light.image = MakeTexelImage((*read)[0].pixels, Levels::kOne);
  light.image.name = source->path;
  scene_.image_lights.push_back(std::move(light));
  const auto row = static_cast<uint32_t>(scene_.image_lights.size() - 1);
  emission_rows_[key] = row;
  return row;
}

Status GltfImages::LoadImage(int image, const std::vector<Wanted>& wanted) {
  const Result<GltfFile::Image> source = file_.FindImage(image);
  if (!source) return source.error();
  std::vector<ImagePick> picks;
  for (const Wanted& one : wanted) picks.push_back({one.use.use, EncodingOf(one.use.srgb)});
  const Result<std::vector<ReadPixels>> read = ReadImagePicks({source->path, source->bytes}, picks);
  if (!read) return read.error();
  for (size_t i = 0; i < wanted.size(); ++i) {
    const Pixels& pixels = (*read)[i].pixels;
    const double scale = wanted[i].use.normal_scale;
    const bool steeper = scale != 1.0 && pixels.channels == 3;
    const Levels levels = wanted[i].use.normals ? Levels::kOne : Levels::kAll;
    scene_.images[wanted[i].row] =
        MakeTexelImage(steeper ? Steeper(pixels, scale) : pixels, levels);
    scene_.images[wanted[i].row].name = source->path;
  }
  return Done{};
}

Status GltfImages::Load() {
  const std::vector<std::pair<int, std::vector<Wanted>>> images(wanted_.begin(), wanted_.end());
  std::vector<std::optional<Error>> errors(images.size());
  tbb::parallel_for(size_t{0}, images.size(), [&](size_t i) {
    const Status loaded = LoadImage(images[i].first, images[i].second);
    if (!loaded) errors[i] = loaded.error();
  });
  for (const std::optional<Error>& error : errors) {
    if (error) return *error;
  }
  return Done{};
}

}  // namespace swell
