// Collects what a reader has to say about its input: the first error, which ends the reading, and
// warnings, each with its place; equal warnings are counted instead of repeated.
#ifndef SWELL_IMPORT_DIAGNOSTICS_H_
#define SWELL_IMPORT_DIAGNOSTICS_H_

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/result.h"

namespace swell {

// A line of an input file. Line 0 means the file as a whole.
struct Place {
  const std::string* file = nullptr;  // owned by Diagnostics
  uint32_t line = 0;
};

class Diagnostics {
 public:
  // Keeps `path` for the places that name it.
  const std::string* AddFile(const std::string& path);

  // The first failure wins: what follows it is a consequence.
  void Fail(Place place, std::string_view what);
  void Warn(Place place, std::string_view what);

  // Adds what was said to `other`, which has no files of its own; its error replaces one here.
  void Take(const Diagnostics& other);

  bool silent() const { return !error_ && warnings_.empty(); }
  bool failed() const { return error_.has_value(); }
  const Error& error() const { return *error_; }
  std::vector<std::string> TakeWarnings();

 private:
  struct Warning {
    std::string text;  // with its place
    std::string what;  // without
    uint32_t repeats = 0;
  };
  std::deque<std::string> files_;
  std::optional<Error> error_;
  std::vector<Warning> warnings_;
  std::map<std::string, size_t, std::less<>> first_by_text_;
};

std::string ToString(Place place);

// 'text', cut to a readable length, with unprintable bytes as '?'.
std::string Quote(std::string_view text);

}  // namespace swell

#endif  // SWELL_IMPORT_DIAGNOSTICS_H_
