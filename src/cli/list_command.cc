// swell list: what this build supports.
#include "src/cli/commands.h"
#include "src/cli/list_text.h"
#include "src/cli/terminal.h"

namespace swell {

int RunList(const ListCommand& command) {
  switch (command.topic) {
    case ListTopic::kMaterials:
      return ExitCode(WriteStandardOutput(MaterialsText({kMaterialKinds, kMaterialKindCount})));
    case ListTopic::kLights:
      return ExitCode(WriteStandardOutput(LightsText()));
    case ListTopic::kTextures:
      return ExitCode(WriteStandardOutput(TexturesText()));
    case ListTopic::kShapes:
      return ExitCode(WriteStandardOutput(ShapesText()));
    case ListTopic::kSamplers:
      return ExitCode(WriteStandardOutput(SamplersText()));
    case ListTopic::kFilters:
      return ExitCode(WriteStandardOutput(FiltersText()));
    case ListTopic::kIsas:
      break;
  }
  return ExitCode(WriteStandardOutput(IsasText(Isas())));
}

}  // namespace swell
