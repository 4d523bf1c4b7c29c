// Work for waves: pieces of (tile, sample range), handed out one after the other to all workers.
#ifndef SWELL_WAVE_UNITS_H_
#define SWELL_WAVE_UNITS_H_

#include <atomic>
#include <cstdint>
#include <vector>

#include "src/film/film.h"

namespace swell {

// Samples [first_sample, first_sample + sample_count) of the listed pixels.
struct Unit {
  const uint32_t* pixels = nullptr;  // x | y << 16; kRowPadding more can be read
  uint32_t pixel_count = 0;
  uint32_t first_sample = 0;
  uint32_t sample_count = 0;
};

// Which of a unit's paths is started next: pixels of one sample first.
struct UnitCursor {
  Unit unit;
  uint32_t pixel = 0;
  uint32_t sample = 0;
  bool done() const { return sample == unit.sample_count; }
};

class Units {
 public:
  static constexpr uint32_t kTileSize = 16;  // pixels; a tile's camera rays are coherent

  Units(const PixelBounds& crop, uint32_t samples_per_pixel);

  // False when all work has been handed out or the render was cancelled. Safe from all threads.
  bool Next(Unit& unit);
  void Cancel() { next_.store(count_, std::memory_order_relaxed); }

  uint64_t count() const { return count_; }

 private:
  struct Tile {
    uint32_t first_pixel, pixel_count;
  };
  std::vector<uint32_t> pixels_;  // of all tiles, each in Morton order; then padding
  std::vector<Tile> tiles_;
  uint32_t samples_per_pixel_;
  uint32_t samples_per_unit_;
  uint64_t ranges_;  // sample ranges per tile
  uint64_t count_;
  std::atomic<uint64_t> next_{0};
};

}  // namespace swell

#endif  // SWELL_WAVE_UNITS_H_
