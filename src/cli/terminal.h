// The process's edges: standard output and error, and signals.
#ifndef SWELL_CLI_TERMINAL_H_
#define SWELL_CLI_TERMINAL_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "src/base/result.h"
#include "src/cli/progress.h"

namespace swell {

// First thing in main: closed standard streams become ones that fail, so that no other file takes
// their place; a closed pipe and a file at its size limit are error codes, not signals; an
// interrupt says so.
void PrepareProcess();

// While one lives, SIGINT and SIGTERM wait: outputs that were begun are finished first.
class HoldSignals {
 public:
  HoldSignals();
  ~HoldSignals();
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
};

// "swell: error: ..." on one line of standard error.
void PrintError(const std::string& message);
void PrintWarning(const std::string& message);
// As it is; a failure is ignored, because there is nowhere to tell it.
void WriteStandardError(std::string_view text);
// A reader that has closed its end has seen enough; that is no failure.
Status WriteStandardOutput(std::string_view text);
// Prints the error, if there is one, and returns the exit code.
int ExitCode(const Status& status);

// How progress shows: updating on a terminal, lines elsewhere.
ProgressStyle StandardErrorStyle();
uint32_t StandardErrorColumns();

}  // namespace swell

#endif  // SWELL_CLI_TERMINAL_H_
