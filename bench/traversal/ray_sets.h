// Rays of one kind from a real render, in the order swell's queues hold them.
#ifndef SWELL_BENCH_TRAVERSAL_RAY_SETS_H_
#define SWELL_BENCH_TRAVERSAL_RAY_SETS_H_

#include <cstdint>
#include <string>

#include "bench/record_wave.h"
#include "kernels/records.h"
#include "src/wave/table.h"

namespace swell::bench {

struct RaySetSpec {
  const char* name;
  const char* title;
  Stage stage;  // which the rays enter
  uint32_t bounce;
};

inline constexpr RaySetSpec kRaySets[] = {
    {"camera", "camera", Stage::kIntersect, 0},
    {"bounce1", "first diffuse bounce", Stage::kIntersect, 1},
    {"bounce3", "third bounce", Stage::kIntersect, 3},
    {"shadow0", "shadow, from camera hits", Stage::kOcclude, 0},
    {"shadow3", "shadow, from third-bounce hits", Stage::kOcclude, 3},
};

struct RaySet {
  const RaySetSpec* spec;
  uint32_t rows;
  // Closest-hit rays use org and dir alone. Row i gives radiance 1 to path i % kMostRows, so that
  // no path occurs twice in a call of kMostRows rows.
  Table<ShadowRayFields> rays;

  bool shadow() const { return spec->stage == Stage::kOcclude; }
};

// About `rows` of them, from all over the frame: the frame is as large as it takes. An error if no
// path comes so far.
Result<RaySet> RecordRays(const BuiltScene& scene, const RaySetSpec& spec, uint32_t rows);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_RAY_SETS_H_
