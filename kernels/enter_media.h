// Surfaces and directions in which light leaves them in; the media that it goes on in out.
#ifndef SWELL_KERNELS_ENTER_MEDIA_H_
#define SWELL_KERNELS_ENTER_MEDIA_H_

#include "kernels/kernel.h"
#include "kernels/media_view.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

struct EnterMediaArgs {
  const SceneView* scene;
  SidesView sides;
  Vec3Fields<In> org, dir;  // of the rays that met the surfaces
  HitsIn hits;              // row for row with them
  const uint32_t* rows;     // of them, by i; or by path[i] where there is `path`
  const uint32_t* path;     // may be null
  Vec3Fields<In> leaving;   // directions, by i; null: straight on
  const uint32_t* before;   // media, as `rows`; null: kKeptMedium where light keeps its own
  size_t count;
  uint32_t* SWELL_RESTRICT after;  // media, by i
};
inline constexpr uint32_t kKeptMedium = 0xFFFFFFFFu;

// Rows that hit nothing keep their medium. Up to a vector of rows behind `after` is scratch.
SWELL_KERNEL(void, EnterMedia, const EnterMediaArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_ENTER_MEDIA_H_
