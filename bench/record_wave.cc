// A render with a recorder in, its dump file read back out.
#include "bench/record_wave.h"

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "src/schedule/render.h"

namespace swell::bench {

Result<RecordedWave> RecordWave(const BuiltScene& scene, const RecordOptions& options) {
  std::string folder = std::filesystem::temp_directory_path() / "swell_bench_XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return Error{folder + ": cannot be made"};
  RenderOptions render;
  render.width = options.width;
  render.height = options.height;
  render.crop = {0, 0, options.width, options.height};
  render.samples_per_pixel = options.samples_per_pixel;
  render.thread_count = 1;
  render.path = SettingsOf(scene);
  render.path.max_depth = std::min(render.path.max_depth, options.bounce + 1);  // no row differs
  render.wave = kMostRows;
  render.dump = {options.stage, options.bounce, folder + "/wave", "", options.rows};
  const Result<RenderResult> rendered = Render(scene.scene, scene.tables, scene.bvh, render, {});
  Result<RecordedWave> wave = rendered ? ReadWave(render.dump.file) : rendered.error();
  std::filesystem::remove_all(folder);
  return wave;
}

PathSettings SettingsOf(const BuiltScene& scene) {
  constexpr uint32_t kRouletteStart = 3;  // as swell render has it
  return {0, scene.scene.request.max_depth, kRouletteStart, DiffuseSampling::kDisk};
}

}  // namespace swell::bench
