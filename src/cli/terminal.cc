// Text to the standard streams by plain writes, and what SIGINT and SIGTERM do.
#include "src/cli/terminal.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "src/cli/commands.h"

namespace swell {
namespace {

volatile sig_atomic_t signals_held = 0;
volatile sig_atomic_t signal_waiting = 0;

// Only calls that are safe in a signal handler.
void Stop(int signal_number) {
  if (signals_held != 0) {
    signal_waiting = signal_number;
    return;
  }
  static constexpr char kText[] = "\nswell: error: interrupted; no image was written\n";
  // The line break ends a progress line; without a terminal there is none.
  const size_t skip = isatty(STDERR_FILENO) != 0 ? 0 : 1;
  [[maybe_unused]] const ssize_t ignored =
      write(STDERR_FILENO, kText + skip, sizeof(kText) - 1 - skip);
  // To die by the signal itself tells the shell what happened (status 128 + signal).
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

void Handle(int signal_number) {
  struct sigaction before;
  // A signal that is ignored from outside (nohup) stays ignored.
  if (sigaction(signal_number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = Stop;
  action.sa_flags = SA_RESTART;
  sigaction(signal_number, &action, nullptr);
}

// False with errno if not everything could be written.
bool WriteAll(int stream, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(stream, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    text.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

}  // namespace

void PrepareProcess() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The lowest free number is this stream's. Writing to it fails, as to the closed one.
    if (open("/dev/null", O_RDONLY) < 0) std::abort();
  }
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  Handle(SIGINT);
  Handle(SIGTERM);
}

HoldSignals::HoldSignals() { signals_held = 1; }

HoldSignals::~HoldSignals() {
  signals_held = 0;
  if (signal_waiting == 0) return;
  // The outputs are there, so the usual message would not be true.
  signal(signal_waiting, SIG_DFL);
  raise(signal_waiting);
}

void PrintError(const std::string& message) {
  WriteStandardError("swell: error: " + OneLine(message) + "\n");
}

void PrintWarning(const std::string& message) {
  WriteStandardError("swell: warning: " + OneLine(message) + "\n");
}

void WriteStandardError(std::string_view text) { (void)WriteAll(STDERR_FILENO, text); }

Status WriteStandardOutput(std::string_view text) {
  if (WriteAll(STDOUT_FILENO, text) || errno == EPIPE) return Done{};
  return Error{std::string("standard output cannot be written: ") + std::strerror(errno)};
}

int ExitCode(const Status& status) {
  if (status) return kExitDone;
  PrintError(status.error().message);
  return kExitFailed;
}

ProgressStyle StandardErrorStyle() {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::strcmp(terminal, "dumb") == 0;
  return isatty(STDERR_FILENO) != 0 && !dumb ? ProgressStyle::kTerminal : ProgressStyle::kLines;
}

uint32_t StandardErrorColumns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

}  // namespace swell
