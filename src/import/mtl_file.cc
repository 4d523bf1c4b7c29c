// Checks the statements of MTL files and hands them to tinyobjloader, material by material, in the
// form that it reads right: it takes words that are no numbers for 0, and file names for numbers.
#include "src/import/mtl_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "src/base/suggest.h"
#include "src/base/text.h"
#include "src/import/statements.h"

namespace swell {
namespace {

constexpr size_t kMaxMtlMaterials = 1u << 20;
constexpr double kMaxMtlNumber = 1e9;

struct Statement {
  std::string_view name;  // as tinyobjloader spells it
  uint32_t numbers;       // 0: a texture
  const char* ignored;    // why it does not matter; null: it does
};

constexpr const char* kNothing = "";  // ignored without a word
constexpr const char* kUnsupported = "is not supported and is ignored";
constexpr Statement kStatements[] = {{"Kd", 3, nullptr},          {"Ks", 3, nullptr},
                                     {"Ke", 3, nullptr},          {"Tf", 3, nullptr},
                                     {"Kt", 3, nullptr},          {"Ni", 1, nullptr},
                                     {"Ns", 1, nullptr},          {"d", 1, nullptr},
                                     {"Tr", 1, nullptr},          {"illum", 1, nullptr},
                                     {"Pr", 1, nullptr},          {"Pm", 1, nullptr},
                                     {"Ps", 1, nullptr},          {"Pc", 1, nullptr},
                                     {"Pcr", 1, nullptr},         {"map_Kd", 0, nullptr},
                                     {"map_Ks", 0, nullptr},      {"map_Ke", 0, nullptr},
                                     {"map_d", 0, nullptr},       {"map_bump", 0, nullptr},
                                     {"bump", 0, nullptr},        {"norm", 0, nullptr},
                                     {"map_Pr", 0, nullptr},      {"map_Pm", 0, nullptr},
                                     {"map_Ps", 0, nullptr},      {"Ka", 3, kNothing},
                                     {"map_Ka", 0, kNothing},     {"sharpness", 1, kNothing},
                                     {"map_aat", 0, kNothing},    {"aniso", 1, kUnsupported},
                                     {"anisor", 1, kUnsupported}, {"map_Ns", 0, kUnsupported},
                                     {"disp", 0, kUnsupported},   {"map_disp", 0, kUnsupported},
                                     {"refl", 0, kUnsupported},   {"map_refl", 0, kUnsupported},
                                     {"decal", 0, kUnsupported},  {"map_Tr", 0, kUnsupported},
                                     {"map_Pc", 0, kUnsupported}, {"map_Pcr", 0, kUnsupported}};

// Options of textures, with the numbers or words that follow.
struct TextureOption {
  std::string_view name;
  uint32_t words, optional_numbers;
};
constexpr TextureOption kTextureOptions[] = {
    {"-blendu", 1, 0}, {"-blendv", 1, 0},  {"-cc", 1, 0}, {"-clamp", 1, 0},     {"-boost", 1, 0},
    {"-bm", 1, 0},     {"-o", 1, 2},       {"-s", 1, 2},  {"-t", 1, 2},         {"-type", 1, 0},
    {"-texres", 1, 0}, {"-imfchan", 1, 0}, {"-mm", 2, 0}, {"-colorspace", 1, 0}};

bool SameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return LowerCase(x) == LowerCase(y); });
}

// Exporters differ in capitals; "Pr" and "pr" are one, "Tr" and "d" are not.
const Statement* FindStatement(std::string_view name) {
  for (const Statement& statement : kStatements) {
    if (SameWord(statement.name, name)) return &statement;
  }
  return nullptr;
}

const TextureOption* FindOption(std::string_view name) {
  for (const TextureOption& option : kTextureOptions) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

bool IsNumber(std::string_view word) {
  double value = 0.0;
  return TakeNumber(&word, &value) && word.empty() && std::abs(value) <= kMaxMtlNumber;
}

// Plain decimals: tinyobjloader's own reader of exponents overflows.
std::string Plain(std::string_view word) {
  double value = 0.0;
  TakeNumber(&word, &value);
  char text[64];
  std::snprintf(text, sizeof(text), "%.9f", value);
  return text;
}

class MtlReader {
 public:
  MtlReader(std::string_view text, const std::string* file, Diagnostics* diagnostics,
            MtlMaterials* materials)
      : statements_(text), file_(file), diagnostics_(*diagnostics), materials_(*materials) {}

  void Read() {
    while (statements_.Next()) {
      std::string_view rest = statements_.statement();
      const std::string_view keyword = TakeWord(&rest);
      if (SameWord(keyword, "newmtl")) {
        Finish();
        if (materials_.size() >= kMaxMtlMaterials) {
          return diagnostics_.Fail(
              {file_, statements_.line()},
              "more than " + std::to_string(kMaxMtlMaterials) + " materials are not supported");
        }
        name_ = Trim(rest);
        open_ = true;
        material_ = {};
        material_.place = {file_, statements_.line()};
      } else {
        ReadStatement(keyword, rest);
      }
    }
    Finish();
  }

 private:
  void Warn(const std::string& what) { diagnostics_.Warn({file_, statements_.line()}, what); }

  void ReadStatement(std::string_view keyword, std::string_view rest) {
    const Statement* statement = FindStatement(keyword);
    if (statement == nullptr) {
      std::vector<std::string_view> names{"newmtl"};
      for (const Statement& known : kStatements) names.push_back(known.name);
      return Warn("unknown statement " + Quote(keyword) + " is ignored" +
                  DidYouMean(keyword, names));
    }
    if (!open_) return Warn(Quote(keyword) + " comes before any newmtl and is ignored");
    if (statement->ignored == kNothing) return;
    if (statement->ignored != nullptr) return Warn(Quote(statement->name) + " " + kUnsupported);
    const std::string values =
        statement->numbers > 0 ? Numbers(*statement, rest) : TextureWords(*statement, rest);
    if (values.empty()) return;
    material_.given.emplace(statement->name);
    text_.append(statement->name).append(values).append("\n");
  }

  // " 1 1 1"; empty, and a warning, if they are none.
  std::string Numbers(const Statement& statement, std::string_view rest) {
    std::string text;
    uint32_t count = 0;
    for (std::string_view word = TakeWord(&rest); !word.empty() && count < statement.numbers;
         word = TakeWord(&rest)) {
      if (statement.name == "d" && word == "-halo") continue;
      if (!IsNumber(word)) {
        Warn(Quote(statement.name) + " has " + Quote(word) +
             ", which is no number of use here; the line is ignored");
        return {};
      }
      text += " " + Plain(word);
      ++count;
    }
    if (count == 1 && statement.numbers == 3) text += text + text;  // grey
    if (count == 1 || count == statement.numbers) return text;
    Warn(Quote(statement.name) + " needs " + std::to_string(statement.numbers) + " numbers, not " +
         std::to_string(count) + "; the line is ignored");
    return {};
  }

  // " -o 0.1 0 0 file name.png": options first and with all their numbers.
  std::string TextureWords(const Statement& statement, std::string_view rest) {
    std::string options, name;
    for (std::string_view word = TakeWord(&rest); !word.empty(); word = TakeWord(&rest)) {
      const TextureOption* option = FindOption(word);
      if (option == nullptr) {
        name.append(" ").append(word);
        continue;
      }
      options.append(" ").append(option->name);
      if (!TakeOption(*option, &rest, &options)) {
        Warn(Quote(statement.name) + ": the option " + Quote(option->name) +
             " lacks its value; the line is ignored");
        return {};
      }
    }
    if (name.empty()) Warn(Quote(statement.name) + " names no file and is ignored");
    return name.empty() ? name : options + name;
  }

  static bool TakeOption(const TextureOption& option, std::string_view* rest, std::string* text) {
    for (uint32_t i = 0; i < option.words + option.optional_numbers; ++i) {
      std::string_view after = *rest;
      const std::string_view word = TakeWord(&after);
      const bool number = IsNumber(word);
      if (i >= option.words && !number) {
        text->append(option.name == "-s" ? " 1" : " 0");
        continue;
      }
      if (word.empty() || (option.optional_numbers > 0 && !number)) return false;
      text->append(" ").append(number ? Plain(word) : std::string(word));
      *rest = after;
    }
    return true;
  }

  void Finish() {
    if (open_) {
      std::istringstream stream("newmtl m\n" + text_);
      std::map<std::string, int> rows;
      std::vector<tinyobj::material_t> read;
      std::string warning, error;
      tinyobj::LoadMtl(&rows, &read, &stream, &warning, &error);
      if (!read.empty()) material_.values = read.back();
      material_.values.name = name_;
      if (!materials_.emplace(name_, std::move(material_)).second) {
        diagnostics_.Warn(material_.place, "a material of that name came before; the first counts");
      }
    }
    text_.clear();
    open_ = false;
  }

  Statements statements_;
  const std::string* file_;
  Diagnostics& diagnostics_;
  MtlMaterials& materials_;
  bool open_ = false;
  std::string name_;
  std::string text_;  // the open material's statements
  MtlMaterial material_;
};

}  // namespace

void ReadMtl(std::string_view text, const std::string* file, Diagnostics* diagnostics,
             MtlMaterials* materials) {
  MtlReader(text, file, diagnostics, materials).Read();
}

}  // namespace swell
