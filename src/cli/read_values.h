// The words of one option in, a part of the command out, or what is wrong with them.
#ifndef SWELL_CLI_READ_VALUES_H_
#define SWELL_CLI_READ_VALUES_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/base/result.h"
#include "src/cli/option_set.h"
#include "src/cli/options.h"
#include "src/cli/parse_values.h"

namespace swell {

// A reader that stores what `parse` returns.
template <class T, class Parse> OptionSet::Read Into(T& target, Parse parse) {
  return [&target, parse](const std::string& text) -> Status {
    auto value = parse(text);
    if (!value) return value.error();
    target = *value;
    return Done{};
  };
}

template <class T> OptionSet::Read CountInto(T& target, uint32_t min, uint32_t max) {
  return Into(target, [=](const std::string& text) { return ParseCount(text, min, max); });
}

template <class T>
OptionSet::Read NameInto(T& target, const char* what, const std::vector<std::string>& names) {
  return [&target, what, names](const std::string& text) -> Status {
    const Result<uint32_t> index = ParseName(what, text, names);
    if (!index) return index.error();
    target = static_cast<T>(*index);
    return Done{};
  };
}

template <class T>
OptionSet::Read NameInto(std::optional<T>& target, const char* what,
                         const std::vector<std::string>& names) {
  return [&target, what, names](const std::string& text) -> Status {
    T chosen{};
    Status status = NameInto(chosen, what, names)(text);
    if (status) target = chosen;
    return status;
  };
}

Status ReadStats(const std::string& text, RenderCommand& command);
Status ReadOutfile(const std::string& text, RenderCommand& command);
// `usable`: the sets that work on this machine.
Status ReadIsa(const std::string& text, const std::vector<std::string>& usable, std::string& isa);
Status ReadDump(const std::string& text, DumpRequest& dump);

}  // namespace swell

#endif  // SWELL_CLI_READ_VALUES_H_
