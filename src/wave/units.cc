// Crop window and sample count -> units of work.
#include "src/wave/units.h"

#include <algorithm>

#include "kernels/columns.h"

namespace swell {
namespace {

// Samples of a pixel in one unit: enough to fill a wave from one tile, few enough to share out.
constexpr uint32_t kSamplesPerUnit = 16;

// The even bits of v, packed.
uint32_t EvenBits(uint32_t v) {
  v &= 0x55555555u;
  v = (v | v >> 1) & 0x33333333u;
  v = (v | v >> 2) & 0x0F0F0F0Fu;
  return (v | v >> 4) & 0x00FF00FFu;
}

}  // namespace

Units::Units(const PixelBounds& crop, uint32_t samples_per_pixel)
    : samples_per_pixel_(samples_per_pixel),
      samples_per_unit_(std::min(samples_per_pixel, kSamplesPerUnit)),
      ranges_((samples_per_pixel + samples_per_unit_ - 1) / samples_per_unit_) {
  pixels_.reserve(size_t{crop.width()} * crop.height() + kRowPadding);
  // Tiles lie on a fixed grid, so that a crop cuts them but does not move them.
  for (uint32_t y = crop.y0 / kTileSize * kTileSize; y < crop.y1; y += kTileSize) {
    for (uint32_t x = crop.x0 / kTileSize * kTileSize; x < crop.x1; x += kTileSize) {
      const uint32_t first = static_cast<uint32_t>(pixels_.size());
      for (uint32_t i = 0; i < kTileSize * kTileSize; ++i) {
        const uint32_t px = x + EvenBits(i), py = y + EvenBits(i >> 1);
        const bool inside = px >= crop.x0 && px < crop.x1 && py >= crop.y0 && py < crop.y1;
        if (inside) pixels_.push_back(px | py << 16);
      }
      tiles_.push_back({first, static_cast<uint32_t>(pixels_.size()) - first});
    }
  }
  pixels_.insert(pixels_.end(), kRowPadding, 0);
  count_ = tiles_.size() * ranges_;
}

bool Units::Next(Unit& unit) {
  const uint64_t index = next_.fetch_add(1, std::memory_order_relaxed);
  if (index >= count_) {
    next_.store(count_, std::memory_order_relaxed);  // never wraps
    return false;
  }
  const Tile& tile = tiles_[index / ranges_];
  const uint32_t first = static_cast<uint32_t>(index % ranges_) * samples_per_unit_;
  unit = {&pixels_[tile.first_pixel], tile.pixel_count, first,
          std::min(samples_per_unit_, samples_per_pixel_ - first)};
  return true;
}

}  // namespace swell
