// References of glTF materials to textures -> texture nodes of the scene.
#include "src/import/gltf_textures.h"

#include <cstring>

#include "src/import/gltf_values.h"

namespace swell {
namespace {

// u grows to the right and v downwards in glTF; rotations are counter-clockwise.
UvMap ReadTransform(const tinygltf::Value& transform) {
  const auto offset = NumbersOf<2>(&transform, "offset", {0.0, 0.0});
  const auto scale = NumbersOf<2>(&transform, "scale", {1.0, 1.0});
  const double angle = NumberOf(&transform, "rotation", 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]}};
}

// glTF's coordinates from those that the scene stores, whose v points up; and back.
const UvMap kFlipped{{1, 0, 0, 0, -1, 1}};

TextureWrap WrapOf(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return TextureWrap::kClamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return TextureWrap::kMirror;
    default:
      return TextureWrap::kRepeat;
  }
}

}  // namespace

GltfTextureUse ReadTextureUse(int index, int uv_set, const tinygltf::ExtensionMap& extensions) {
  GltfTextureUse use;
  use.texture = index;
  use.uv_set = uv_set;
  if (const tinygltf::Value* transform = FindExtension(extensions, "KHR_texture_transform")) {
    use.map = ReadTransform(*transform);
    const int other_set = IndexOf(transform, "texCoord");
    if (other_set >= 0) use.uv_set = other_set;
  }
  return use;
}

GltfTextureUse ReadTextureUse(const tinygltf::Value* extension, const char* name) {
  const tinygltf::Value* info = Member(extension, name);
  if (info == nullptr || !info->IsObject()) return {};
  tinygltf::ExtensionMap extensions;
  const tinygltf::Value* inner = Member(info, "extensions");
  if (const tinygltf::Value* transform = Member(inner, "KHR_texture_transform")) {
    extensions["KHR_texture_transform"] = *transform;
  }
  const int set = IndexOf(info, "texCoord");
  GltfTextureUse use = ReadTextureUse(IndexOf(info, "index"), set < 0 ? 0 : set, extensions);
  use.scale = NumberOf(info, "scale", 1.0);
  return use;
}

// -1, with a warning, if the texture names no image that can be read.
int GltfTextures::ImageOf(int texture) {
  const auto& textures = file_.model().textures;
  if (static_cast<size_t>(texture) >= textures.size()) {
    diagnostics_.Fail(place_, "there is no texture " + std::to_string(texture));
    return -1;
  }
  const tinygltf::Texture& entry = textures[static_cast<size_t>(texture)];
  int image = entry.source;
  if (image < 0) image = IndexOf(FindExtension(entry.extensions, "EXT_texture_webp"), "source");
  if (image < 0) {
    diagnostics_.Warn(place_,
                      "a texture has no image of a format that is read (PNG, JPEG, WebP); "
                      "it is left out");
  } else if (static_cast<size_t>(image) >= file_.image_count()) {
    diagnostics_.Fail(place_, "there is no image " + std::to_string(image));
    image = -1;
  }
  return image;
}

// Null, with a warning, if the mesh stores no coordinates of the texture's set.
const GltfUvFrame* GltfTextures::FrameOf(const GltfTextureUse& use, const GltfUvFrames& frames) {
  if (!use) return nullptr;
  const GltfUvFrame* of_set = nullptr;
  for (const std::optional<GltfUvFrame>* frame : {&frames.second, &frames.first}) {
    if (!*frame || (*frame)->uv_set != use.uv_set) continue;
    if (of_set == nullptr || (*frame)->map == use.map) of_set = &**frame;
  }
  if (of_set == nullptr && frames.first) {
    diagnostics_.Warn(place_, "a texture of " + UvName(use.uv_set) +
                                  " is left out: its mesh has none, or its material uses more than "
                                  "two sets of coordinates");
  }
  return of_set;
}

SurfaceLookup GltfTextures::SamplerOf(int texture) const {
  const auto& model = file_.model();
  SurfaceLookup lookup;
  lookup.wrap = lookup.wrap_t = TextureWrap::kRepeat;
  const int index = model.textures[static_cast<size_t>(texture)].sampler;
  if (index < 0 || static_cast<size_t>(index) >= model.samplers.size()) return lookup;
  const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(index)];
  lookup.wrap = WrapOf(sampler.wrapS);
  lookup.wrap_t = WrapOf(sampler.wrapT);
  if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) lookup.filter = TextureFilter::kPoint;
  return lookup;
}

uint32_t GltfTextures::Node(const GltfTextureUse& use, const GltfImageUse& image,
                            const GltfUvFrames& frames) {
  const GltfUvFrame* frame = FrameOf(use, frames);
  const int source = frame == nullptr ? -1 : ImageOf(use.texture);
  if (source < 0) return kNoTexture;
  TextureStep step;
  step.op = TextureOp::kImage;
  step.image = images_.Row(source, image);
  step.value[0] = 1.0f;
  const SurfaceLookup sampler = SamplerOf(use.texture);
  step.wrap = sampler.wrap;
  step.wrap_t = sampler.wrap_t;
  step.filter = sampler.filter;
  step.second_uvs = frames.second && frame == &*frames.second ? 1 : 0;
  // As stored -> the file's own -> the image's.
  const UvMap stored = Inverse(frame->map).value_or(UvMap{}) * kFlipped;
  const UvMap map = kFlipped * (use.map == frame->map ? kFlipped : use.map * stored);
  const bool straight = map.m[1] == 0.0 && map.m[3] == 0.0;
  step.mapping = straight ? TextureMapping::kUv : TextureMapping::kUvAffine;
  const std::array<double, 6> words =
      straight ? std::array<double, 6>{map.m[0], map.m[4], map.m[2], map.m[5], 0, 0} : map.m;
  for (size_t i = 0; i < words.size(); ++i) step.map[i] = static_cast<float>(words[i]);
  return Add(step);
}

uint32_t GltfTextures::Constant(const std::array<double, 3>& value) {
  TextureStep step;
  for (size_t c = 0; c < 3; ++c) step.value[c] = static_cast<float>(value[c]);
  return Add(step);
}

uint32_t GltfTextures::Product(uint32_t a, uint32_t b) {
  TextureStep step;
  step.op = TextureOp::kScale;
  step.input[0] = a;
  step.input[1] = b;
  return Add(step);
}

uint32_t GltfTextures::Scaled(uint32_t node, const std::array<double, 3>& factor) {
  return factor == std::array<double, 3>{1, 1, 1} ? node : Product(Constant(factor), node);
}

uint32_t GltfTextures::Step(uint32_t node, double edge) {
  TextureStep step;
  step.op = TextureOp::kStep;
  step.input[0] = node;
  step.value[0] = static_cast<float>(edge);
  return Add(step);
}

uint32_t GltfTextures::VertexColor(bool alpha) {
  TextureStep step;
  step.op = TextureOp::kVertexColor;
  step.value[0] = alpha ? 1.0f : 0.0f;
  return Add(step);
}

// Its coordinates are those that the mesh stores: GltfMaterials::Frames sees to it.
uint32_t GltfTextures::Emission(const GltfTextureUse& use, const GltfUvFrames& frames) {
  const GltfUvFrame* frame = FrameOf(use, frames);
  const int source = frame == nullptr ? -1 : ImageOf(use.texture);
  if (source < 0) return kNoTexture;
  SurfaceLookup lookup = SamplerOf(use.texture);
  lookup.second_uvs = frames.second && frame == &*frames.second ? 1 : 0;
  const Result<uint32_t> row = images_.EmissionRow(source, lookup);
  if (row) return *row;
  diagnostics_.Fail(place_, row.error().message);
  return kNoTexture;
}

uint32_t GltfTextures::Add(const TextureStep& step) {
  const std::string bytes(reinterpret_cast<const char*>(&step), sizeof(step));
  const auto next = static_cast<uint32_t>(scene_.texture_nodes.size());
  const auto [at, is_new] = nodes_.try_emplace(bytes, next);
  if (is_new) scene_.texture_nodes.push_back(step);
  return at->second;
}

}  // namespace swell
