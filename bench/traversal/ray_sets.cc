// A scene and a kind of rays in, a table of recorded rays out.
#include "bench/traversal/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swell::bench {
namespace {

// The columns of org and dir come first in both records, t_max follows in that of shadow rays.
constexpr size_t kOrgAndDir = 6;

RaySet Take(const RaySetSpec& spec, const RecordedWave& wave, uint32_t most_rows) {
  const uint32_t rows = std::min(wave.rows, most_rows);
  RaySet set{&spec, rows, Table<ShadowRayFields>(rows)};
  const auto words = set.rays.Words();
  const size_t copied = set.shadow() ? kOrgAndDir + 1 : kOrgAndDir;
  for (size_t c = 0; c < copied; ++c) {
    std::copy_n(wave.columns[c].words.begin(), rows, words[c]);
  }
  const ShadowRaysOut rays = set.rays.Columns();
  if (!set.shadow()) std::fill_n(rays.t_max, rows, std::numeric_limits<float>::infinity());
  for (uint32_t i = 0; i < rows; ++i) {
    rays.radiance.r[i] = rays.radiance.g[i] = rays.radiance.b[i] = 1.0f;
    rays.path[i] = i % kMostRows;
  }
  return set;
}

}  // namespace

Result<RaySet> RecordRays(const BuiltScene& scene, const RaySetSpec& spec, uint32_t rows) {
  constexpr uint32_t kProbeSide = 256, kMostSide = 2048;
  RecordOptions probe{spec.stage, spec.bounce, kProbeSide, kProbeSide, 1, kProbeSide * kProbeSide};
  const Result<RecordedWave> probed = RecordWave(scene, probe);
  if (!probed) return probed.error();
  if (probed->rows == 0) return Error{std::string(spec.name) + ": no path comes so far"};

  const double fraction = static_cast<double>(probed->rows) / (kProbeSide * kProbeSide);
  const double reserve = fraction == 1.0 ? 1.0 : 1.03;  // the probe is a guess
  const double paths = rows / fraction * reserve;
  const double samples = std::ceil(paths / (double{kMostSide} * kMostSide));
  const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(paths / samples)));
  const Result<RecordedWave> wave = RecordWave(
      scene, {spec.stage, spec.bounce, side, side, static_cast<uint32_t>(samples), rows});
  if (!wave) return wave.error();
  if (wave->rows == 0) return Error{std::string(spec.name) + ": no path comes so far"};
  return Take(spec, *wave, rows);
}

}  // namespace swell::bench
