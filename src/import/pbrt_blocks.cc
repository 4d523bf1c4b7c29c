// Blocks of attributes, the world, and included files: what saves the state and restores it.
#include <filesystem>

#include "src/import/pbrt_directives.h"
#include "src/import/pbrt_reader.h"

namespace swell {

void PbrtReader::Push(Place place, std::string_view directive) {
  if (saved_.size() >= kMaxAttributeDepth) {
    return Fail(place,
                "attributes are nested more than " + std::to_string(kMaxAttributeDepth) + " deep");
  }
  saved_.push_back({state_, place, directive});
}

void PbrtReader::Pop(Place place, std::string_view begin, std::string_view end) {
  if (saved_.empty()) {
    return Fail(place, std::string(end) + " has no " + std::string(begin) + " before it");
  }
  const Saved& saved = saved_.back();
  if (saved.directive != begin) {
    return Fail(place, std::string(end) + " closes the " + std::string(saved.directive) + " of " +
                           ToString(saved.place));
  }
  state_ = saved.state;
  saved_.pop_back();
}

void PbrtReader::WorldBegin(Place place) {
  for (const Saved& saved : saved_) {
    return Fail(place, "the " + std::string(saved.directive) + " of " + ToString(saved.place) +
                           " is still open");
  }
  in_world_ = true;
  state_.to_world = swell::Transform{};
  state_.transform_applies = true;
  systems_["world"] = swell::Transform{};
}

void PbrtReader::WorldEnd(Place place) {
  Warn(place, "WorldEnd is a directive of older pbrt versions and is ignored");
}

std::string PbrtReader::FileNamedBy(Place place, const std::string& directive) {
  const std::string name = Text("the file's name");
  if (failed()) return "";
  const std::string folder = std::filesystem::path(*place.file).parent_path().string();
  Parameters files(&diagnostics_, place, directive, {main_folder_, folder});
  return files.ResolveFile(name, place);
}

void PbrtReader::Include(Place place) {
  const std::string path = FileNamedBy(place, "Include");
  if (!failed()) tokens_.Open(path, place);
}

}  // namespace swell
