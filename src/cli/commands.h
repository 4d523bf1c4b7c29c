// What the program does, one function for each command.
#ifndef SWELL_CLI_COMMANDS_H_
#define SWELL_CLI_COMMANDS_H_

#include "src/cli/options.h"

namespace swell {

// Exit codes; a contract.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

// All print for themselves and return the exit code.
int RunRender(const RenderCommand& command);
int RunInfo(const InfoCommand& command);
int RunList(const ListCommand& command);

}  // namespace swell

#endif  // SWELL_CLI_COMMANDS_H_
