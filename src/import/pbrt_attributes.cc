// Directives that change what later ones mean: defaults of parameters, colour spaces, options.
#include <algorithm>

#include "src/base/suggest.h"
#include "src/base/text.h"
#include "src/import/pbrt_directives.h"

namespace swell {

void PbrtReader::Attribute(Place place) {
  const std::string name = Text("what the attribute is for");
  const std::vector<std::string_view> targets = {"shape", "light", "material", "medium", "texture"};
  const auto found = std::find(targets.begin(), targets.end(), name);
  if (!failed() && found == targets.end()) {
    return Fail(place,
                "unknown target " + Quote(name) + " of Attribute" + KnownWords(name, targets));
  }
  const auto target = static_cast<Target>(found - targets.begin());
  Parameters parameters = ParseParameters(place, "Attribute '" + name + "'");
  if (failed()) return;
  ConvertColors(parameters, target);
  // Saved states share the old ones.
  auto defaults = state_.defaults == nullptr ? std::make_shared<Defaults>()
                                             : std::make_shared<Defaults>(*state_.defaults);
  parameters.MoveTo(&(*defaults)[static_cast<size_t>(target)]);
  state_.defaults = std::move(defaults);
}

void PbrtReader::ColorSpace(Place place) {
  const std::string name = Text("the colour space's name");
  if (failed()) return;
  const auto found = std::find(kColorSpaceNames.begin(), kColorSpaceNames.end(), name);
  if (found == kColorSpaceNames.end()) {
    return Fail(place, "unknown colour space " + Quote(name) + KnownWords(name, kColorSpaceNames));
  }
  state_.color_space = static_cast<ColorSpaceName>(found - kColorSpaceNames.begin());
}

void PbrtReader::ConvertColors(Parameters& parameters, Target target) const {
  if (state_.color_space == ColorSpaceName::kSrgb) return;
  parameters.ConvertColors(state_.color_space,
                           target == Target::kLight ? ColorUse::kLight : ColorUse::kWeight);
}

// pbrt-v4's options, by name; some files put the type before it, as for parameters.
void PbrtReader::Option(Place place) {
  const std::string text = Text("the option's name");
  const Token value = tokens_.Next();
  if (failed()) return;
  if (value.kind == TokenKind::kEnd) {
    return Fail(place, "the value of " + Quote(text) + " is missing");
  }
  std::string name;
  for (const char c : text.substr(text.find_last_of(' ') + 1)) {
    if (c != '_' && c != '-') name += LowerCase(c);
  }
  if (is_import_) {
    return Warn(place, "an option of an imported file is ignored; give it in the scene's file");
  }
  if (name == "seed") {
    scene_.request.seed = static_cast<uint32_t>(ParseInteger(value, &diagnostics_));
    return;
  }
  const std::vector<std::string_view> same_picture = {
      "disablewavelengthjitter", "gpu", "pixelstats", "quiet", "rendercoordsys", "wavefront"};
  const std::vector<std::string_view> others = {
      "disablepixeljitter", "disabletexturefiltering", "displacementedgescale", "forcediffuse",
      "interactive",        "msereferenceimage",       "msereferenceout"};
  const auto is_in = [&](const std::vector<std::string_view>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is_in(same_picture) || (is_in(others) && value.text == "false")) return;
  if (is_in(others))
    return Warn(place, "option " + Quote(name) + " is not supported and is ignored");
  std::vector<std::string_view> known = same_picture;
  known.insert(known.end(), others.begin(), others.end());
  known.push_back("seed");
  Fail(place, "unknown option " + Quote(text) + KnownWords(name, known));
}

}  // namespace swell
