// The typed parameters of one directive ("float fov" 45 ...): read once, asked for by name; what
// nobody asked for is reported.
#ifndef SWELL_IMPORT_PARAMETERS_H_
#define SWELL_IMPORT_PARAMETERS_H_

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "src/import/color_space.h"
#include "src/import/tokens.h"

namespace swell {

class TextureNames;

struct Parameter {
  std::string type, name;
  Place place;
  std::vector<float> floats;  // every type but the following
  std::vector<int32_t> integers;
  std::vector<std::string> strings;  // string, texture, and spectrum by name
  std::vector<bool> bools;
  bool asked = false;
  bool is_default = false;  // of an Attribute directive: nobody need ask for it
  bool converted = false;   // from another colour space than linear sRGB

  std::string Title() const { return "\"" + type + " " + name + "\""; }
};

// Where the files that a directive names are looked for.
struct Folders {
  std::string main;       // of the scene file given to the program, as pbrt does
  std::string including;  // of the file that holds the directive
};

class Parameters {
 public:
  // `owner` names the directive in messages ("Camera 'perspective'").
  Parameters(Diagnostics* diagnostics, Place place, std::string owner, Folders folders)
      : diagnostics_(diagnostics),
        place_(place),
        owner_(std::move(owner)),
        folders_(std::move(folders)) {}

  // Reads "type name" value pairs up to the next word.
  void Parse(TokenStream& tokens);

  // Parameters that count where the directive has none of their name.
  void AddDefaults(const std::vector<Parameter>& defaults);
  // Makes them defaults; they replace those of the same name.
  void MoveTo(std::vector<Parameter>* defaults);
  // Those of type "rgb" to linear sRGB.
  void ConvertColors(ColorSpaceName space, ColorUse use);

  // One value, or the fallback if the parameter is absent. Wrong types and counts fail.
  float Float(std::string_view name, float fallback);
  float FloatWithin(std::string_view name, float fallback, float min, float max);
  float PositiveFloat(std::string_view name, float fallback);
  int32_t Int(std::string_view name, int32_t fallback);
  int32_t IntWithin(std::string_view name, int32_t fallback, int32_t min, int32_t max);
  bool Bool(std::string_view name, bool fallback);
  std::string String(std::string_view name, std::string_view fallback);
  std::array<float, 3> Point3(std::string_view name, std::array<float, 3> fallback);

  // All values; null if absent. `tuple` divides their number; with `count` they are that many.
  Parameter* Floats(std::string_view name, std::initializer_list<std::string_view> types,
                    size_t tuple, size_t count = 0);
  Parameter* Ints(std::string_view name);

  // Any type; the caller judges. Marks it as asked for.
  Parameter* Any(std::string_view name);

  // Warns if one of `names` is there: pbrt knows it, swell does not use it.
  void Ignore(std::initializer_list<std::string_view> names);
  // Accepts `names` without a word: they cannot change the picture.
  void Accept(std::initializer_list<std::string_view> names);

  // Warns of every parameter that nobody asked for.
  void ReportUnknown();

  // Whether there is such a file.
  bool HasFile(const std::string& name) const;
  // The path of a named file; fails if there is none.
  std::string ResolveFile(const std::string& name, Place place);

  void FailType(const Parameter& parameter, std::string_view expected);
  void Fail(Place place, std::string_view what) {
    diagnostics_->Fail(place, Prefix() + std::string(what));
  }
  void Warn(Place place, std::string_view what) {
    diagnostics_->Warn(place, Prefix() + std::string(what));
  }
  // Where parameters of type "texture" are looked up; null before the world begins.
  void SetTextures(TextureNames* textures) { textures_ = textures; }
  TextureNames* textures() { return textures_; }
  Diagnostics* diagnostics() { return diagnostics_; }
  std::string Prefix() const { return owner_ + ": "; }  // of messages
  Place place() const { return place_; }
  bool failed() const { return diagnostics_->failed(); }

 private:
  Parameter* OfType(std::string_view name, std::initializer_list<std::string_view> types);
  void ParseValue(const Token& token, Parameter& parameter);

  Diagnostics* diagnostics_;
  Place place_;
  std::string owner_;
  Folders folders_;
  TextureNames* textures_ = nullptr;
  std::vector<Parameter> list_;
  std::vector<std::string> known_;  // every name that was asked for
};

}  // namespace swell

#endif  // SWELL_IMPORT_PARAMETERS_H_
