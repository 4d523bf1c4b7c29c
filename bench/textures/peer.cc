// Writes an image as TextureSystem wants it, and asks for its texels one lookup at a time.
#include "bench/textures/peer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace swell::bench {
namespace {

constexpr int kFileTile = 64;

std::vector<float> LevelValues(const TexelImage& image, uint32_t level) {
  std::vector<float> values;
  for (uint32_t y = 0; y < image.levels[level].height; ++y) {
    for (uint32_t x = 0; x < image.levels[level].width; ++x) {
      for (float channel : TexelAt(image, level, x, y)) values.push_back(channel);
    }
  }
  return values;
}

}  // namespace

Status WriteTiled(const TexelImage& image, const std::string& path) {
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path);
  if (!out) return Error{path + ": cannot be written"};
  for (uint32_t i = 0; i < image.levels.size(); ++i) {
    const ImageLevel& level = image.levels[i];
    OIIO::ImageSpec spec(static_cast<int>(level.width), static_cast<int>(level.height), 3,
                         image.format == TexelFormat::kByte ? OIIO::TypeUInt8 : OIIO::TypeHalf);
    spec.tile_width = spec.tile_height = kFileTile;
    spec.attribute("textureformat", "Plain Texture");
    spec.attribute("openexr:levelmode", 1);     // smaller levels follow
    spec.attribute("openexr:roundingmode", 0);  // their sides are rounded down
    // TIFF keeps smaller levels as further images.
    const auto next = out->supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel
                                              : OIIO::ImageOutput::AppendSubimage;
    const auto mode = i == 0 ? OIIO::ImageOutput::Create : next;
    const std::vector<float> values = LevelValues(image, i);
    if (!out->open(path, spec, mode) || !out->write_image(OIIO::TypeFloat, values.data())) {
      return Error{path + ": cannot be written: " + out->geterror()};
    }
  }
  if (!out->close()) return Error{path + ": cannot be written: " + out->geterror()};
  return Done{};
}

Lookups WidthsOfPeer(const Lookups& lookups, const TexelImage& image) {
  Lookups peer(lookups.count);
  const auto side = static_cast<float>(image.levels[0].width);
  const auto last = static_cast<float>(image.levels.size() - 1);
  for (size_t i = 0; i < lookups.count; ++i) {
    const float level = std::min(std::log2(std::max(lookups.width[i] * side, 1.0f)), last);
    const float whole = std::floor(level);
    const auto next = std::min(static_cast<size_t>(whole) + 1, image.levels.size() - 1);
    const auto next_side = static_cast<float>(image.levels[next].width);
    peer.s[i] = lookups.s[i];
    peer.t[i] = lookups.t[i];
    // It blends the two levels between which a width becomes one texel, by twice its part of a
    // texel of the smaller one, less 1.
    peer.width[i] = 0.5f * (1.0f + level - whole) / next_side;
  }
  return peer;
}

Result<std::unique_ptr<TexturePeer>> TexturePeer::Make(const std::string& path) {
  constexpr float kCacheMegabytes = 4096;
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(/*shared=*/false);
  system->attribute("max_memory_MB", kCacheMegabytes);
  OIIO::TextureSystem::TextureHandle* handle = system->get_texture_handle(OIIO::ustring(path));
  std::unique_ptr<TexturePeer> peer(new TexturePeer(system, handle));
  if (!system->good(handle)) return Error{path + ": " + system->geterror()};
  return peer;
}

TexturePeer::~TexturePeer() { OIIO::TextureSystem::destroy(system_, /*teardown_imagecache=*/true); }

void TexturePeer::Filter(const Lookups& lookups, size_t first, size_t count, TextureWrap wrap,
                         TextureFilter filter, float* const* rgb) {
  const bool trilinear = filter == TextureFilter::kTrilinear;
  OIIO::TextureSystem::Perthread* thread = system_->get_perthread_info();
  OIIO::TextureOpt options;
  options.swrap = options.twrap =
      wrap == TextureWrap::kRepeat ? OIIO::TextureOpt::WrapPeriodic : OIIO::TextureOpt::WrapClamp;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.mipmode = trilinear ? OIIO::TextureOpt::MipModeTrilinear : OIIO::TextureOpt::MipModeNoMIP;
  for (size_t i = first; i < first + count; ++i) {
    const float width = trilinear ? lookups.width[i] : 0.0f;
    float value[3];
    system_->texture(handle_, thread, options, lookups.s[i], lookups.t[i], width, 0.0f, 0.0f, width,
                     3, value);
    for (size_t c = 0; c < 3; ++c) rgb[c][i] = value[c];
  }
}

int64_t TexturePeer::cache_bytes() const {
  long long bytes = 0;
  system_->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return bytes;
}

}  // namespace swell::bench
