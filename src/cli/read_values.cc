// Values of options that take several shapes: outputs, statistics, instruction sets, dumps.
#include "src/cli/read_values.h"

#include <algorithm>
#include <string_view>

#include "src/base/suggest.h"
#include "src/cli/parse_values.h"
#include "src/stats/isa.h"

namespace swell {
namespace {

bool EndsWith(const std::string& text, std::string_view end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Status ReadStats(const std::string& text, RenderCommand& command) {
  if (text == "table") {
    command.stats_table = true;
  } else if (EndsWith(text, ".json")) {
    command.stats_file = text;
  } else {
    return Error{"'" + text + "' is neither 'table' nor a file that ends in .json"};
  }
  return Done{};
}

Status ReadOutfile(const std::string& text, RenderCommand& command) {
  if (!EndsWith(text, ".exr") && !EndsWith(text, ".png")) {
    return Error{"'" + text + "' does not end in .exr or .png"};
  }
  const auto& known = command.outfiles;
  if (std::find(known.begin(), known.end(), text) != known.end()) {
    return Error{"'" + text + "' is given twice"};
  }
  command.outfiles.push_back(text);
  return Done{};
}

Status ReadIsa(const std::string& text, const std::vector<std::string>& usable, std::string& isa) {
  isa = text;
  if (text == "auto" || std::find(usable.begin(), usable.end(), text) != usable.end()) {
    return Done{};
  }
  std::vector<std::string> choices{"auto"};
  choices.insert(choices.end(), usable.begin(), usable.end());
  for (const IsaInfo& known : Isas()) {
    if (known.name == text) {
      return Error{"'" + text + "' does not work on this machine; use " + OneOf(choices)};
    }
  }
  return Error{"unknown instruction set '" + text + "'; use " + OneOf(choices)};
}

Status ReadDump(const std::string& text, DumpRequest& dump) {
  const size_t first = text.find(':');
  const size_t second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos || second + 1 == text.size()) {
    return Error{"'" + text + "' is not STAGE:BOUNCE:FILE, such as intersect:2:wave.bin"};
  }
  const std::vector<std::string> stages(std::begin(kStageNames), std::end(kStageNames));
  const Result<uint32_t> stage = ParseName("stage", text.substr(0, first), stages);
  if (!stage) return stage.error();
  const Result<uint32_t> bounce =
      ParseCount(text.substr(first + 1, second - first - 1), 0, kMaxDepth);
  if (!bounce) return Error{"bounce " + bounce.error().message};
  dump = {static_cast<Stage>(*stage), *bounce, text.substr(second + 1)};
  return Done{};
}

}  // namespace swell
