// Reading, checking and handing out the parameters of a directive.
#include "src/import/parameters.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

#include "src/base/suggest.h"
#include "src/import/pbrt_v3.h"

namespace swell {
namespace {

const std::vector<std::string_view> kTypes = {
    "integer", "float",   "point2", "vector2",  "point3",    "vector3", "normal", "point",
    "vector",  "normal3", "rgb",    "spectrum", "blackbody", "bool",    "string", "texture"};

std::string ToText(float value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

bool Exists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace

void Parameters::Parse(TokenStream& tokens) {
  while (!failed() && tokens.Peek().kind == TokenKind::kString) {
    const Token head = tokens.Next();
    std::istringstream words{std::string(head.text)};
    Parameter parameter;
    std::string rest;
    words >> parameter.type >> parameter.name >> rest;
    parameter.place = head.place;
    if (parameter.name.empty() || !rest.empty()) {
      return Fail(head.place, "\"TYPE NAME\" of a parameter is expected, not " + Quote(head.text));
    }
    if (std::find(kTypes.begin(), kTypes.end(), parameter.type) == kTypes.end()) {
      return Fail(head.place, "unknown parameter type " + Quote(parameter.type) +
                                  DidYouMean(parameter.type, kTypes) + UpgradeHint(parameter.type));
    }
    for (const Parameter& other : list_) {
      if (other.name == parameter.name) {
        return Fail(head.place, Quote(parameter.name) + " is given twice; remove one of the two");
      }
    }
    if (tokens.Peek().kind == TokenKind::kOpen) {
      const Place open = tokens.Next().place;
      while (!failed() && tokens.Peek().kind != TokenKind::kClose) {
        if (tokens.Peek().kind == TokenKind::kEnd) {
          return Fail(open, "'[' has no ']' before the end of the file");
        }
        ParseValue(tokens.Next(), parameter);
      }
      tokens.Next();
    } else {
      ParseValue(tokens.Next(), parameter);
    }
    list_.push_back(std::move(parameter));
  }
}

void Parameters::ParseValue(const Token& token, Parameter& parameter) {
  if (token.kind == TokenKind::kEnd) {
    return Fail(parameter.place, "the value of " + parameter.Title() + " is missing");
  }
  const std::string& type = parameter.type;
  if (type == "string" || type == "texture" ||
      (type == "spectrum" && token.kind == TokenKind::kString)) {
    if (token.kind != TokenKind::kString) {
      return Fail(token.place,
                  parameter.Title() + " needs text in quotes, not " + Quote(token.text));
    }
    parameter.strings.emplace_back(token.text);
  } else if (type == "bool") {
    if (token.text != "true" && token.text != "false") {
      return Fail(token.place, parameter.Title() + " is true or false, not " + Quote(token.text));
    }
    parameter.bools.push_back(token.text == "true");
  } else if (token.kind != TokenKind::kNumber) {
    return Fail(token.place, parameter.Title() + " needs numbers, not " + Quote(token.text));
  } else if (type == "integer") {
    parameter.integers.push_back(ParseInteger(token, diagnostics_));
  } else {
    parameter.floats.push_back(ParseFloat(token, diagnostics_));
  }
}

void Parameters::AddDefaults(const std::vector<Parameter>& defaults) {
  const size_t own = list_.size();
  for (const Parameter& parameter : defaults) {
    const bool given = std::any_of(list_.begin(), list_.begin() + static_cast<ptrdiff_t>(own),
                                   [&](const Parameter& p) { return p.name == parameter.name; });
    if (!given) list_.push_back(parameter);
  }
}

void Parameters::MoveTo(std::vector<Parameter>* defaults) {
  for (Parameter& parameter : list_) {
    parameter.is_default = true;
    const auto same = [&](const Parameter& other) { return other.name == parameter.name; };
    defaults->erase(std::remove_if(defaults->begin(), defaults->end(), same), defaults->end());
    defaults->push_back(std::move(parameter));
  }
  list_.clear();
}

void Parameters::ConvertColors(ColorSpaceName space, ColorUse use) {
  for (Parameter& parameter : list_) {
    std::vector<float>& values = parameter.floats;
    const bool negative = std::any_of(values.begin(), values.end(), [](float v) { return v < 0; });
    if (parameter.type != "rgb" || values.size() != 3 || negative) continue;  // an error later
    const std::array<float, 3> color = ToSrgb(space, use, {values[0], values[1], values[2]});
    values.assign(color.begin(), color.end());
    parameter.converted = true;
  }
}

Parameter* Parameters::Any(std::string_view name) {
  if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.emplace_back(name);
  for (Parameter& parameter : list_) {
    if (parameter.name != name) continue;
    parameter.asked = true;
    return &parameter;
  }
  return nullptr;
}

void Parameters::FailType(const Parameter& parameter, std::string_view expected) {
  Fail(parameter.place, parameter.Title() + " has the wrong type; write \"" +
                            std::string(expected) + " " + parameter.name + "\"");
}

Parameter* Parameters::OfType(std::string_view name,
                              std::initializer_list<std::string_view> types) {
  Parameter* parameter = Any(name);
  if (parameter == nullptr) return nullptr;
  if (std::find(types.begin(), types.end(), parameter->type) == types.end()) {
    FailType(*parameter, *types.begin());
    return nullptr;
  }
  return parameter;
}

Parameter* Parameters::Floats(std::string_view name, std::initializer_list<std::string_view> types,
                              size_t tuple, size_t count) {
  Parameter* parameter = OfType(name, types);
  if (parameter == nullptr) return nullptr;
  const size_t size = parameter->floats.size();
  if (count > 0 && size != count) {
    Fail(parameter->place, parameter->Title() + " needs " + std::to_string(count) +
                               (count == 1 ? " value, not " : " values, not ") +
                               std::to_string(size));
    return nullptr;
  }
  if (size % tuple != 0) {
    Fail(parameter->place, parameter->Title() + " has " + std::to_string(size) +
                               " values, which is no multiple of " + std::to_string(tuple));
    return nullptr;
  }
  return parameter;
}

Parameter* Parameters::Ints(std::string_view name) { return OfType(name, {"integer"}); }

float Parameters::Float(std::string_view name, float fallback) {
  const Parameter* parameter = Floats(name, {"float"}, 1, 1);
  return parameter == nullptr ? fallback : parameter->floats[0];
}

float Parameters::FloatWithin(std::string_view name, float fallback, float min, float max) {
  const float value = Float(name, fallback);
  if (!failed() && !(value >= min && value <= max)) {
    Fail(Any(name)->place, Quote(name) + " is " + ToText(value) + " but must lie between " +
                               ToText(min) + " and " + ToText(max));
  }
  return value;
}

float Parameters::PositiveFloat(std::string_view name, float fallback) {
  const float value = Float(name, fallback);
  if (!failed() && !(value > 0.0f)) {
    const Parameter* parameter = Any(name);
    Fail(parameter == nullptr ? place_ : parameter->place,
         Quote(name) + " is " + ToText(value) + " but must be above 0");
  }
  return value;
}

int32_t Parameters::Int(std::string_view name, int32_t fallback) {
  const Parameter* parameter = OfType(name, {"integer"});
  if (parameter == nullptr) return fallback;
  if (parameter->integers.size() != 1) {
    Fail(parameter->place,
         parameter->Title() + " needs 1 value, not " + std::to_string(parameter->integers.size()));
    return fallback;
  }
  return parameter->integers[0];
}

int32_t Parameters::IntWithin(std::string_view name, int32_t fallback, int32_t min, int32_t max) {
  const int32_t value = Int(name, fallback);
  if (!failed() && !(value >= min && value <= max)) {
    const bool open = max == std::numeric_limits<int32_t>::max();
    Fail(Any(name)->place,
         Quote(name) + " is " + std::to_string(value) + " but must be " +
             (open ? "at least " + std::to_string(min)
                   : "between " + std::to_string(min) + " and " + std::to_string(max)));
  }
  return value;
}

bool Parameters::Bool(std::string_view name, bool fallback) {
  const Parameter* parameter = OfType(name, {"bool"});
  if (parameter == nullptr) return fallback;
  if (parameter->bools.size() != 1) {
    Fail(parameter->place, parameter->Title() + " needs one value, true or false");
    return fallback;
  }
  return parameter->bools[0];
}

std::string Parameters::String(std::string_view name, std::string_view fallback) {
  const Parameter* parameter = OfType(name, {"string"});
  if (parameter == nullptr) return std::string(fallback);
  if (parameter->strings.size() != 1) {
    Fail(parameter->place, parameter->Title() + " needs one text in quotes");
    return std::string(fallback);
  }
  return parameter->strings[0];
}

std::array<float, 3> Parameters::Point3(std::string_view name, std::array<float, 3> fallback) {
  const Parameter* parameter = Floats(name, {"point3", "point"}, 3, 3);
  if (parameter == nullptr) return fallback;
  return {parameter->floats[0], parameter->floats[1], parameter->floats[2]};
}

void Parameters::Ignore(std::initializer_list<std::string_view> names) {
  for (std::string_view name : names) {
    const Parameter* parameter = Any(name);
    if (parameter == nullptr) continue;
    Warn(parameter->place, parameter->Title() + " is not supported and is ignored");
  }
}

void Parameters::Accept(std::initializer_list<std::string_view> names) {
  for (std::string_view name : names) Any(name);
}

void Parameters::ReportUnknown() {
  if (failed()) return;
  const std::vector<std::string_view> known(known_.begin(), known_.end());
  for (const Parameter& parameter : list_) {
    if (parameter.asked || parameter.is_default) continue;
    Warn(parameter.place, "unknown parameter " + parameter.Title() + " is ignored" +
                              DidYouMean(parameter.name, known));
  }
}

bool Parameters::HasFile(const std::string& name) const {
  namespace fs = std::filesystem;
  const auto is_file = [](const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
  };
  if (fs::path(name).is_absolute()) return is_file(name);
  return is_file(fs::path(folders_.main) / name) || is_file(fs::path(folders_.including) / name);
}

std::string Parameters::ResolveFile(const std::string& name, Place place) {
  namespace fs = std::filesystem;
  const fs::path path(name);
  if (path.is_absolute()) return name;
  const fs::path from_main = fs::path(folders_.main) / path;
  const fs::path from_including = fs::path(folders_.including) / path;
  if (Exists(from_main)) return from_main.string();
  if (Exists(from_including)) return from_including.string();
  std::string what =
      "file " + Quote(name) + " is not in the folder of the scene (" + from_main.string() + ")";
  if (from_including != from_main)
    what += " nor beside this file (" + from_including.string() + ")";
  Fail(place, what);
  return from_main.string();
}

}  // namespace swell
