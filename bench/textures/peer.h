// The peer: OpenImageIO's TextureSystem over the same texels in a file of tiles.
#ifndef SWELL_BENCH_TEXTURES_PEER_H_
#define SWELL_BENCH_TEXTURES_PEER_H_

#include <OpenImageIO/texture.h>

#include <memory>
#include <string>

#include "bench/textures/lookups.h"
#include "src/base/result.h"

namespace swell::bench {

// Writes all levels of an image of bytes or halves, in the tiles that maketx makes.
Status WriteTiled(const TexelImage& image, const std::string& path);

// What TextureSystem must be told for its linear blend of levels to be that of swell: it weighs by
// the ratio of widths between two levels, swell by the ratio's logarithm.
Lookups WidthsOfPeer(const Lookups& lookups, const TexelImage& image);

class TexturePeer {
 public:
  // The file is read when it is looked up; all of it stays in the cache.
  static Result<std::unique_ptr<TexturePeer>> Make(const std::string& path);
  ~TexturePeer();
  TexturePeer(const TexturePeer&) = delete;
  TexturePeer& operator=(const TexturePeer&) = delete;

  // Lookups [first, first + count) into columns. Any thread may call it.
  void Filter(const Lookups& lookups, size_t first, size_t count, TextureWrap wrap,
              TextureFilter filter, float* const* rgb);
  int64_t cache_bytes() const;

 private:
  TexturePeer(OIIO::TextureSystem* system, OIIO::TextureSystem::TextureHandle* handle)
      : system_(system), handle_(handle) {}
  OIIO::TextureSystem* system_;
  OIIO::TextureSystem::TextureHandle* handle_;
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_TEXTURES_PEER_H_
