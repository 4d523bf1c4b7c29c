// Statements of OBJ and MTL files: lines, continuations, words and numbers; and files in UTF-16.
#include "src/import/statements.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "src/import/text_file.h"
#include "tests/support/temporary_folder.h"

namespace swell {
namespace {

std::vector<std::pair<uint32_t, std::string>> All(std::string_view text) {
  Statements statements(text);
  std::vector<std::pair<uint32_t, std::string>> all;
  while (statements.Next()) all.emplace_back(statements.line(), statements.statement());
  return all;
}
using Lines = std::vector<std::pair<uint32_t, std::string>>;

TEST_CASE("Statements: lines end in LF, CR or both, and are counted") {
  CHECK(All("a\nb\r\nc\rd") == Lines{{1, "a"}, {2, "b"}, {3, "c"}, {4, "d"}});
  CHECK(All("\n\n  a b \t\n# no\n\r\n\tc\n") == Lines{{3, "a b"}, {6, "c"}});
  CHECK(All("").empty());
  CHECK(All("# only\n#this").empty());
}

TEST_CASE("Statements: a backslash continues a line, but not a comment") {
  CHECK(All("f 1 \\\n2\\\r\n 3\nx") == Lines{{1, "f 1  2 3"}, {4, "x"}});
  CHECK(All("a\\") == Lines{{1, "a"}});
  CHECK(All("\\\n\\\nb\\\n") == Lines{{1, "b"}});
  CHECK(All("\\\n").empty());
  CHECK(All("a\\\n\nb") == Lines{{1, "a"}, {3, "b"}});
  CHECK(All("# a \\\nb") == Lines{{2, "b"}});
}

TEST_CASE("TakeWord: words up to a comment") {
  std::string_view text = " one\t two#2 # three";
  CHECK(TakeWord(&text) == "one");
  CHECK(TakeWord(&text) == "two#2");
  CHECK(TakeWord(&text) == "");
  CHECK(TakeWord(&text) == "");
}

TEST_CASE("TakeNumber: the number at the front, the rest left behind") {
  const auto number = [](std::string_view word, std::string_view rest) {
    double value = 99.0;
    CHECK(TakeNumber(&word, &value));
    CHECK(word == rest);
    return value;
  };
  CHECK(number("+1.5", "") == 1.5);
  CHECK(number("-.5e2", "") == -50.0);
  CHECK(number("3.1+e2", "+e2") == 3.1);
  CHECK(number("2.", "") == 2.0);
  CHECK(number("1e999", "") == INFINITY);
  CHECK(number("1e-999", "") == 0.0);
  double value = 0.0;
  for (std::string_view word : {"", "x", "+", "e5", ",1"}) CHECK_FALSE(TakeNumber(&word, &value));
}

TEST_CASE("TextFile: UTF-16 of both orders and byte order marks become UTF-8") {
  const test::TemporaryFolder folder;
  const auto read = [&](std::string_view bytes) {
    const Result<TextFile> file = TextFile::Open(folder.Write("t", bytes));
    REQUIRE(file);
    return std::string(file->text());
  };
  using namespace std::string_view_literals;
  CHECK(read("plain") == "plain");
  CHECK(read("\xEF\xBB\xBFmark") == "mark");
  CHECK(read("\xFE\xFF\0v\0 \0\xE9"sv) == "v \xC3\xA9");
  CHECK(read("\xFF\xFEv\0 \0\xE9\0"sv) == "v \xC3\xA9");
  CHECK(read("\xFE\xFF\x20\xAC\xD8\x3D\xDE\x00"sv) == "\xE2\x82\xAC\xF0\x9F\x98\x80");
  CHECK(read("\xFE\xFF\xD8\x3D\0v\0"sv) == "\xEF\xBF\xBDv");  // half a pair, half a unit
}

}  // namespace
}  // namespace swell
