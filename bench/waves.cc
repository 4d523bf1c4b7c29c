// A scene and a bounce, or a dump file, in; tables of rows out.
#include "bench/waves.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "kernels/intersect_rays.h"
#include "kernels/sort_hits.h"
#include "src/stages/wave_recorder.h"

namespace swell::bench {
namespace {

constexpr uint32_t kRecordedRows = 1u << 18;  // to choose from
constexpr size_t kRayColumns = Table<RayFields>::kColumns;
constexpr size_t kHitColumns = Table<HitFields>::kColumns;

[[noreturn]] void Fail(const std::string& message) {
  std::fprintf(stderr, "swell_bench: %s\n", message.c_str());
  std::exit(1);
}

// Keeps what `make` makes under a name. References stay valid.
template <class T, class Make>
const T& Once(std::map<std::string, std::unique_ptr<T>>& kept, const std::string& name, Make make) {
  std::unique_ptr<T>& entry = kept[name];
  if (!entry) entry = make();
  return *entry;
}

RecordedWave Read(const std::string& path) {
  Result<RecordedWave> wave = ReadWave(path);
  if (!wave) Fail(wave.error().message);
  if (wave->rows == 0) Fail(path + ": has no rows");
  return std::move(*wave);
}

// Renders one sample of every pixel, or as many as the recorder takes.
RecordedWave Record(const WaveSource& source, Stage stage) {
  const BuiltScene& scene = SceneOf(source.scene);
  const RenderRequest& request = scene.scene.request;
  Result<RecordedWave> wave =
      RecordWave(scene, {stage, source.bounce, request.width, request.height, 1, kRecordedRows});
  if (!wave) Fail(wave.error().message);
  if (wave->rows == 0) Fail(source.label + ": no path comes so far");
  return std::move(*wave);
}

RecordedWave Get(const WaveSource& source, Stage stage) {
  return source.file.empty() ? Record(source, stage) : Read(source.file);
}

// Which rows of a record a wave is made of: blocks that stood together, from all over the frame.
std::vector<uint32_t> Choose(const RecordedWave& wave) {
  constexpr uint32_t kBlock = 256;  // pixels of a tile
  std::vector<uint32_t> chosen;
  const uint32_t blocks = kMostRows / kBlock;
  for (uint32_t row = 0; row < std::min(wave.rows, kMostRows); ++row) {
    const uint64_t first = uint64_t{wave.rows - kBlock} * (row / kBlock) / (blocks - 1);
    chosen.push_back(wave.rows <= kMostRows ? row : static_cast<uint32_t>(first) + row % kBlock);
  }
  return chosen;
}

// Columns `first`, `first + 1`, ... of the record to the columns of a table.
template <template <template <class> class> class Fields>
void Copy(const RecordedWave& wave, const std::vector<uint32_t>& rows, size_t first, size_t columns,
          Table<Fields>& table) {
  const auto words = table.Words();
  for (size_t c = 0; c < columns; ++c) {
    for (size_t i = 0; i < rows.size(); ++i) words[c][i] = wave.columns[first + c].words[rows[i]];
  }
}

std::unique_ptr<RayWave> MakeRays(const WaveSource& source) {
  const RecordedWave recorded = Get(source, Stage::kShade);
  if (recorded.columns.size() < kRayColumns + 2) Fail(source.label + ": holds no rays");
  const std::vector<uint32_t> chosen = Choose(recorded);
  const auto rows = static_cast<uint32_t>(chosen.size());
  auto wave =
      std::make_unique<RayWave>(RayWave{&SceneOf(source.scene), rows, Table<RayFields>(rows),
                                        Table<HitFields>(rows), Table<PathFields>(rows)});
  Copy(recorded, chosen, 0, kRayColumns, wave->rays);
  Copy(recorded, chosen, kRayColumns, 2, wave->paths);
  for (uint32_t i = 0; i < rows; ++i) wave->rays.Columns().path[i] = i;
  if (recorded.columns.size() >= kRayColumns + 2 + kHitColumns) {
    Copy(recorded, chosen, kRayColumns + 2, kHitColumns, wave->hits);
  } else {
    const RaysIn rays = wave->rays.ReadColumns();
    IntersectRays(Width::kWide, wave->scene->bvh.view(), Traversal::kAuto, rays.org, rays.dir,
                  wave->hits.Columns(), rows);
  }
  return wave;
}

std::unique_ptr<ShadowWave> MakeShadowRays(const WaveSource& source) {
  const RecordedWave recorded = Get(source, Stage::kOcclude);
  constexpr size_t kColumns = Table<ShadowRayFields>::kColumns;
  if (recorded.columns.size() != kColumns) Fail(source.label + ": holds no shadow rays");
  const std::vector<uint32_t> chosen = Choose(recorded);
  const auto rows = static_cast<uint32_t>(chosen.size());
  auto wave = std::make_unique<ShadowWave>(ShadowWave{
      &SceneOf(source.scene), rows, Table<ShadowRayFields>(rows), Table<PathFields>(rows)});
  Copy(recorded, chosen, 0, kColumns, wave->shadow_rays);
  for (uint32_t i = 0; i < rows; ++i) wave->shadow_rays.Columns().path[i] = i;
  return wave;
}

}  // namespace

const BuiltScene& SceneOf(const std::string& name) {
  static std::map<std::string, std::unique_ptr<BuiltScene>> kept;
  return Once(kept, name, [&] {
    Result<std::unique_ptr<BuiltScene>> built = BuildScene(name);
    if (!built) Fail(built.error().message);
    return std::move(*built);
  });
}

const RayWave& RaysOf(const WaveSource& source) {
  static std::map<std::string, std::unique_ptr<RayWave>> kept;
  return Once(kept, source.label, [&] { return MakeRays(source); });
}

const ShadowWave& ShadowRaysOf(const WaveSource& source) {
  static std::map<std::string, std::unique_ptr<ShadowWave>> kept;
  return Once(kept, source.label, [&] { return MakeShadowRays(source); });
}

SortedWave Sort(const RayWave& wave) {
  const SceneView& scene = wave.scene->tables.view;
  const size_t capacity = RoundUpToPadding(wave.rows) + kRowPadding;
  std::vector<uint32_t> keys(capacity), histogram(scene.materials.count + 2);
  SortedWave sorted{std::vector<uint32_t>(capacity), std::vector<Run>(histogram.size())};
  const SortHitsArgs args{&scene,
                          wave.scene->scene.request.max_depth,
                          wave.hits.ReadColumns().prim,
                          wave.rays.ReadColumns().state,
                          wave.rows,
                          keys.data(),
                          histogram.data(),
                          wave.rays.ReadColumns().dir,
                          wave.hits.ReadColumns().t,
                          wave.rays.ReadColumns().org};
  sorted.runs.resize(SortHits(Width::kWide, args, sorted.rows.data(), sorted.runs.data()));
  return sorted;
}

}  // namespace swell::bench
