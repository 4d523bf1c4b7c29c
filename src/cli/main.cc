// The program: its arguments to a command, the command to an exit code.
#include <exception>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "src/cli/commands.h"
#include "src/cli/options.h"
#include "src/cli/terminal.h"
#include "src/stats/isa.h"

namespace {

int Run(const swell::RenderCommand& command) { return swell::RunRender(command); }
int Run(const swell::InfoCommand& command) { return swell::RunInfo(command); }
int Run(const swell::ListCommand& command) { return swell::RunList(command); }
int Run(const swell::ShowText& command) {
  return swell::ExitCode(swell::WriteStandardOutput(command.text));
}

int RunArguments(const std::vector<std::string>& arguments) {
  const auto command = swell::ParseCommandLine(arguments, swell::UsableIsaNames());
  if (!command) {
    swell::PrintError(command.error().message);
    return swell::kExitUsage;
  }
  return std::visit([](const auto& chosen) { return Run(chosen); }, *command);
}

}  // namespace

int main(int argc, char** argv) {
  swell::PrepareProcess();
  try {
    return RunArguments({argv + (argc > 0 ? 1 : 0), argv + argc});
  } catch (const std::bad_alloc&) {
    swell::PrintError("not enough memory");
  } catch (const std::exception& error) {
    swell::PrintError(error.what());
  }
  return swell::kExitFailed;
}
