// A size and a kind in, an image and where it is looked up out.
#ifndef SWELL_BENCH_TEXTURES_LOOKUPS_H_
#define SWELL_BENCH_TEXTURES_LOOKUPS_H_

#include <cstddef>
#include <cstdint>

#include <hwy/aligned_allocator.h>

#include "kernels/texture_view.h"
#include "src/scene/image.h"

namespace swell::bench {

// Waves with noise on them, linear; of bytes or halves.
Pixels MakePattern(uint32_t side, TexelFormat format);

enum class Coherence {
  kCoherent,  // pixels of a frame, tile by tile: neighbours lie 1.3 to 10 texels apart
  kRandom,
};

struct Lookups {
  explicit Lookups(size_t size)
      : count(size),
        s(hwy::AllocateAligned<float>(size)),
        t(hwy::AllocateAligned<float>(size)),
        width(hwy::AllocateAligned<float>(size)) {}
  size_t count;
  hwy::AlignedFreeUniquePtr<float[]> s, t;
  hwy::AlignedFreeUniquePtr<float[]> width;  // part of the image's side
};

// Coordinates from all over the image, some from beyond its edges; widths from 1 to 32 texels.
Lookups MakeLookups(size_t count, Coherence coherence, uint32_t side);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TEXTURES_LOOKUPS_H_
