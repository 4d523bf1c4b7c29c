// Types with their parameters, which swell list shows as text.
#ifndef SWELL_CLI_LIST_ENTRIES_H_
#define SWELL_CLI_LIST_ENTRIES_H_

#include <string>
#include <vector>

namespace swell {

// A parameter of a type of a directive: "type name", default, meaning.
struct Param {
  const char* name;
  const char* fallback;
  const char* help;
};

struct Entry {
  const char* name;
  const char* help;
  std::vector<Param> params;
};

// `text` and blanks up to `width`.
std::string Padded(std::string text, size_t width);
std::string EntriesText(const std::vector<Entry>& entries);

}  // namespace swell

#endif  // SWELL_CLI_LIST_ENTRIES_H_
