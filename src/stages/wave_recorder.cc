// Rows of a wave -> a dump file, and back.
#include "src/stages/wave_recorder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/base/new_file.h"

namespace swell {
namespace {

constexpr const char* kMagic = "swell-wave 1";
constexpr const char* kRayColumns[] = {
    "org.x",        "org.y",        "org.z",        "dir.x",    "dir.y",     "dir.z", "path",
    "throughput.r", "throughput.g", "throughput.b", "bsdf_pdf", "eta_scale", "state"};
constexpr const char* kHitColumns[] = {"t", "prim", "u", "v", "instance"};
constexpr const char* kShadowColumns[] = {"org.x",      "org.y",      "org.z", "dir.x",
                                          "dir.y",      "dir.z",      "t_max", "radiance.r",
                                          "radiance.g", "radiance.b", "path"};
constexpr const char* kPathColumns[] = {"pixel", "sample"};

static_assert(std::size(kRayColumns) == Table<RayFields>::kColumns);
static_assert(std::size(kHitColumns) == Table<HitFields>::kColumns);
static_assert(std::size(kShadowColumns) == Table<ShadowRayFields>::kColumns);

void Append(RecordedColumn& column, const uint32_t* words, size_t count) {
  column.words.insert(column.words.end(), words, words + count);
}

}  // namespace

WaveRecorder::WaveRecorder(std::string scene, Stage stage, uint32_t bounce, uint32_t enough)
    : enough_(enough) {
  recorded_.scene = std::move(scene);
  recorded_.stage = stage;
  recorded_.bounce = bounce;
  if (stage == Stage::kOcclude) {
    for (const char* name : kShadowColumns) recorded_.columns.push_back({name, {}});
    return;
  }
  for (const char* name : kRayColumns) recorded_.columns.push_back({name, {}});
  for (const char* name : kPathColumns) recorded_.columns.push_back({name, {}});
  if (stage == Stage::kIntersect) return;
  for (const char* name : kHitColumns) recorded_.columns.push_back({name, {}});
}

void WaveRecorder::Offer(Stage stage, const Wave& wave) {
  const uint32_t bucket = std::min(recorded_.bounce, kStatsBounces - 1);
  if (stage != recorded_.stage || wave.bounces[bucket] == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Window& window : wave.windows) {
    if (recorded_.rows >= enough_) return;
    if (stage == Stage::kOcclude) {
      TakeShadowRays(wave, window);
    } else {
      TakeRays(wave, window);
    }
  }
}

void WaveRecorder::TakeRays(const Wave& wave, const Window& window) {
  size_t c = 0;
  for (const uint32_t* words : wave.rays.Words(window.first)) {
    Append(recorded_.columns[c++], words, window.rays);
  }
  // Pixel and sample stay with the path; a recorded row carries them itself.
  const PathsIn paths = wave.paths.ReadColumns(window.first);
  const uint32_t* path = wave.rays.ReadColumns(window.first).path;
  for (uint32_t i = 0; i < window.rays; ++i) {
    recorded_.columns[c].words.push_back(paths.pixel[path[i]]);
    recorded_.columns[c + 1].words.push_back(paths.sample[path[i]]);
  }
  c += 2;
  if (recorded_.stage != Stage::kIntersect) {
    for (const uint32_t* words : wave.hits.Words(window.first)) {
      Append(recorded_.columns[c++], words, window.rays);
    }
  }
  recorded_.rows += window.rays;
}

void WaveRecorder::TakeShadowRays(const Wave& wave, const Window& window) {
  size_t c = 0;
  for (const uint32_t* words : wave.shadow_rays.Words(window.first)) {
    Append(recorded_.columns[c++], words, window.shadow_rays);
  }
  recorded_.rows += window.shadow_rays;
}

Status WriteWave(const RecordedWave& wave, const std::string& path) {
  Result<NewFile> file = NewFile::Open(path);
  if (!file) return file.error();
  std::ostringstream header;
  header << kMagic << "\nscene " << wave.scene << "\nstage "
         << kStageNames[static_cast<uint32_t>(wave.stage)] << "\nbounce " << wave.bounce
         << "\nrows " << wave.rows << "\n";
  for (const RecordedColumn& column : wave.columns) header << "column " << column.name << "\n";
  header << "data\n";
  const std::string text = header.str();
  file->Write(text.data(), text.size());
  for (const RecordedColumn& column : wave.columns) {
    file->Write(column.words.data(), column.words.size() * sizeof(uint32_t));
  }
  return file->Commit();
}

Result<RecordedWave> ReadWave(const std::string& path) {
  std::error_code failed;
  const uintmax_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (failed || !file || !std::getline(file, line)) return Error{path + ": cannot be read"};
  if (line != kMagic) return Error{path + ": is not a recorded wave of this version"};
  RecordedWave wave;
  while (std::getline(file, line) && line != "data") {
    const size_t space = line.find(' ');
    const std::string key = line.substr(0, space);
    const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
    if (key == "scene") wave.scene = value;
    if (key == "column") wave.columns.push_back({value, {}});
    if (key == "bounce")
      wave.bounce = static_cast<uint32_t>(std::strtoul(value.c_str(), nullptr, 10));
    if (key == "rows") wave.rows = static_cast<uint32_t>(std::strtoul(value.c_str(), nullptr, 10));
    for (uint32_t s = 0; key == "stage" && s < kStageCount; ++s) {
      if (value == kStageNames[s]) wave.stage = static_cast<Stage>(s);
    }
  }
  if (uintmax_t{wave.rows} * wave.columns.size() * sizeof(uint32_t) > size) {
    return Error{path + ": is truncated"};
  }
  for (RecordedColumn& column : wave.columns) {
    column.words.resize(wave.rows);
    file.read(reinterpret_cast<char*>(column.words.data()),
              static_cast<std::streamsize>(column.words.size() * sizeof(uint32_t)));
  }
  if (!file) return Error{path + ": is truncated"};
  return wave;
}

}  // namespace swell
