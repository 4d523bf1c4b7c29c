// Directives of media -> rows of the scene's media, and the sides of the shapes that follow.
#include <algorithm>

#include "src/base/suggest.h"
#include "src/import/media.h"
#include "src/import/pbrt_directives.h"

namespace swell {

// pbrt resolves names at the end of the scene, so a use may come before the definition.
PbrtReader::NamedMedium& PbrtReader::MediumOf(const std::string& name, Place place) {
  const auto [at, is_new] = media_.try_emplace(name);
  if (is_new) {
    at->second.row = static_cast<uint32_t>(scene_.media.size());
    at->second.first_use = place;
    scene_.media.push_back({name, {}});
  }
  return at->second;
}

void PbrtReader::MakeNamedMedium(Place place) {
  const std::string name = Text("the medium's name");
  Parameters parameters = ParseParameters(place, "medium '" + name + "'", Target::kMedium);
  if (failed()) return;
  const std::array<float, 3> absorption = ReadMedium(parameters);
  if (!failed()) DefineMedium(name, place, absorption);
}

void PbrtReader::DefineMedium(const std::string& name, Place place,
                              const std::array<float, 3>& absorption) {
  NamedMedium& medium = MediumOf(name, place);
  if (medium.defined()) {
    return Fail(place, "medium " + Quote(name) + " is defined twice; the other is in " +
                           ToString(medium.definition));
  }
  medium.definition = place;
  scene_.media[medium.row].absorption = absorption;
}

void PbrtReader::MediumInterface(Place place) {
  const std::string inside = Text("the inner medium's name");
  if (failed()) return;
  std::string outside = inside;
  if (tokens_.Peek().kind == TokenKind::kString) outside = tokens_.Next().text;
  state_.inside = inside.empty() ? kVacuum : MediumOf(inside, place).row;
  state_.outside = outside.empty() ? kVacuum : MediumOf(outside, place).row;
}

// A surface that is not there still divides what is on its sides.
void PbrtReader::PlaceMedia(Placement* placement) {
  placement->inside = state_.inside;
  placement->outside = state_.outside;
  placement->border = state_.material == kInterfaceMaterial;
  if (!placement->border) return;
  if (border_alpha_ == kNoTexture) border_alpha_ = textures_.Constant({0.0f, 0.0f, 0.0f});
  placement->alpha = border_alpha_;
}

// Media that do nothing become none, so that scenes without others take no time for them.
void PbrtReader::FinishMedia() {
  std::vector<std::string_view> defined;
  for (const auto& [name, medium] : media_) {
    if (medium.defined()) defined.push_back(name);
  }
  for (const auto& [name, medium] : media_) {
    if (medium.defined()) continue;
    return Fail(medium.first_use,
                "medium " + Quote(name) + " is not defined" + DidYouMean(name, defined));
  }
  std::vector<uint32_t> rows(scene_.media.size(), kVacuum);
  std::vector<Medium> kept = {{}};
  for (size_t i = 1; i < scene_.media.size(); ++i) {
    if (scene_.media[i].absorption == std::array<float, 3>{}) continue;
    rows[i] = static_cast<uint32_t>(kept.size());
    kept.push_back(scene_.media[i]);
  }
  scene_.media = std::move(kept);
  scene_.camera.medium = rows[scene_.camera.medium];
  for (swell::Shape& shape : scene_.shapes) {
    shape.inside = rows[shape.inside];
    shape.outside = rows[shape.outside];
  }
}

}  // namespace swell
