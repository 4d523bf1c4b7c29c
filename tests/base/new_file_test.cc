// Bytes and names of files in, claims about what is under the name when out.
#include "src/base/new_file.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/error_lines.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

TEST_CASE("NewFile: nothing is under the name before Commit, and nothing at all without it") {
  const TemporaryFolder folder;
  {
    Result<NewFile> file = NewFile::Open(folder / "a");
    REQUIRE(file);
    file->Write("hello", 5);
    const std::vector<std::string> entries = folder.Entries();
    REQUIRE(entries.size() == 1);
    CHECK(entries[0].rfind(".swell-" + std::to_string(getpid()), 0) == 0);
  }
  CHECK(folder.Entries().empty());

  Result<NewFile> file = NewFile::Open(folder / "a");
  REQUIRE(file);
  file->Write("hello", 5);
  file->Seek(1);
  file->Write("a", 1);
  CHECK(file->position() == 2);
  CHECK(file->size() == 5);
  REQUIRE(file->Commit());
  CHECK(folder.Entries() == std::vector<std::string>{"a"});
  CHECK(Contents(folder / "a") == "hallo");
}

TEST_CASE("NewFile: a folder that takes the name before Commit is an error") {
  const TemporaryFolder folder;
  Result<NewFile> file = NewFile::Open(folder / "a");
  REQUIRE(file);
  file->Write("hello", 5);
  std::filesystem::create_directory(folder / "a");
  const Status status = file->Commit();
  REQUIRE_FALSE(status);
  CheckIsLineAbout(status.error(), folder / "a");
  CHECK(folder.Entries() == std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace swell::test
