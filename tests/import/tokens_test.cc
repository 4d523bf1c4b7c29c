// The tokenizer: kinds, places, escapes, numbers.
#include "src/import/tokens.h"

#include <vector>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

struct Seen {
  TokenKind kind;
  std::string text;
  uint32_t line;
  bool operator==(const Seen&) const = default;
};

std::vector<Seen> AllTokens(std::string_view text, Diagnostics* diagnostics) {
  const test::TemporaryFolder folder;
  TokenStream tokens(diagnostics);
  tokens.Open(folder.Write("a.pbrt", text), {});
  std::vector<Seen> seen;
  while (true) {
    const Token token = tokens.Next();
    if (token.kind == TokenKind::kEnd) return seen;
    seen.push_back({token.kind, std::string(token.text), token.place.line});
  }
}

Token NumberToken(std::string_view text) { return {TokenKind::kNumber, text, {}}; }

}  // namespace

TEST_CASE("TokenStream: splits text into words, strings, numbers and brackets with their lines") {
  Diagnostics diagnostics;
  const std::vector<Seen> seen = AllTokens(
      "Shape \"sphere\" # a comment \"not a string\"\n\r\n  \"float radius\" [1.5e3 -2]#end\nX",
      &diagnostics);
  CHECK(!diagnostics.failed());
  const std::vector<Seen> expected = {{TokenKind::kWord, "Shape", 1},
                                      {TokenKind::kString, "sphere", 1},
                                      {TokenKind::kString, "float radius", 3},
                                      {TokenKind::kOpen, "[", 3},
                                      {TokenKind::kNumber, "1.5e3", 3},
                                      {TokenKind::kNumber, "-2", 3},
                                      {TokenKind::kClose, "]", 3},
                                      {TokenKind::kWord, "X", 4}};
  CHECK(seen == expected);
}

TEST_CASE("TokenStream: decodes escapes and skips a byte order mark") {
  Diagnostics diagnostics;
  const auto seen = AllTokens("\xEF\xBB\xBF\"a\\\"b\\\\c\\td\" \"\" # \\q", &diagnostics);
  CHECK(!diagnostics.failed());
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].text == "a\"b\\c\td");
  CHECK(seen[1].text == "");
}

TEST_CASE("ParseDouble: reads what pbrt reads and rejects what is no finite float") {
  const auto value = [](std::string_view text) {
    Diagnostics diagnostics;
    const double parsed = ParseDouble(NumberToken(text), &diagnostics);
    CHECK(!diagnostics.failed());
    return parsed;
  };
  CHECK(value("1") == 1.0);
  CHECK(value("+2.5") == 2.5);
  CHECK(value("-.5") == -0.5);
  CHECK(value("3.") == 3.0);
  CHECK(value("1e-3") == 1e-3);
  CHECK(value("1e-400") == 0.0);
  for (std::string_view bad : {"1e39", "-1e400", "-nan", "-inf", "1.2.3", "12abc", "-", "."}) {
    Diagnostics diagnostics;
    ParseDouble(NumberToken(bad), &diagnostics);
    INFO(bad);
    CHECK(diagnostics.failed());
  }
}

TEST_CASE("ParseInteger: rejects fractions and what does not fit 32 bits") {
  Diagnostics diagnostics;
  CHECK(ParseInteger(NumberToken("-2147483648"), &diagnostics) == -2147483647 - 1);
  CHECK(ParseInteger(NumberToken("+7"), &diagnostics) == 7);
  CHECK(!diagnostics.failed());
  for (std::string_view bad : {"2147483648", "1.5", "1e3", "99999999999999999999"}) {
    Diagnostics failing;
    ParseInteger(NumberToken(bad), &failing);
    INFO(bad);
    CHECK(failing.failed());
  }
}

}  // namespace swell
