// The words of one option in, a part of the command out, or what is wrong with them.
#ifndef SWELL_CLI_READ_VALUES_H_
#define SWELL_CLI_READ_VALUES_H_

#include <string>
#include <vector>

#include "src/cli/options.h"

namespace swell {

Status ReadStats(const std::string& text, RenderCommand& command);
Status ReadOutfile(const std::string& text, RenderCommand& command);
// `usable`: the sets that work on this machine.
Status ReadIsa(const std::string& text, const std::vector<std::string>& usable, std::string& isa);
Status ReadDump(const std::string& text, DumpRequest& dump);

}  // namespace swell

#endif  // SWELL_CLI_READ_VALUES_H_
