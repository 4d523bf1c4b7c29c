// Groups the rows of a queue by material: a counting sort of row ids.
#ifndef SWELL_KERNELS_SORT_HITS_H_
#define SWELL_KERNELS_SORT_HITS_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

// Materials of the two runs without one: rays that left the scene, and hits at the last bounce,
// where nothing is scattered any more. They come after all materials.
inline constexpr uint32_t kMissRun = 0xFFFFFFFEu;
inline constexpr uint32_t kEndRun = 0xFFFFFFFFu;

struct SortHitsArgs {
  const SceneView* scene;
  uint32_t max_depth;
  const uint32_t* prims;   // HitFields::prim, `count` rows
  const uint32_t* states;  // RayFields::state
  size_t count;
  uint32_t* keys;                    // scratch, `count` rows
  uint32_t* histogram;               // scratch, materials + 2, all 0; left all 0
  Vec3Fields<In> dirs = {};          // RayFields::dir and org and HitFields::t, which choose the
  const float* distances = nullptr;  // material of a mix; only read for those
  Vec3Fields<In> orgs = {};
  // Only read where TexturesView::textured_mixes: the rest of rays and hits.
  const float* u = nullptr;
  const float* v = nullptr;
  const uint32_t* instances = nullptr;
  PixelFootprint pixel = {};
};

// Writes row ids to rows [0, count), grouped into runs and in order within each; returns the number
// of runs, at most materials + 2.
SWELL_KERNEL(size_t, SortHits, const SortHitsArgs& args, uint32_t* rows, Run* runs);

}  // namespace swell

#endif  // SWELL_KERNELS_SORT_HITS_H_
