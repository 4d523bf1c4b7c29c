// How far a run is, for a person: one line that updates on a terminal, a plain line now and then
// elsewhere.
#ifndef SWELL_CLI_PROGRESS_H_
#define SWELL_CLI_PROGRESS_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swell {

enum class ProgressStyle { kNone, kLines, kTerminal };

// Time left from the recent rate: the last third of the time so far, so that cheap first pixels or
// a busy minute do not count for ever. Fixed memory.
class TimeLeft {
 public:
  void Add(double seconds, uint64_t done);
  // Empty until there is a rate to judge by.
  std::optional<double> Estimate(uint64_t total) const;

 private:
  struct Point {
    double seconds;
    uint64_t done;
  };
  std::vector<Point> points_;
};

class ProgressLine {
 public:
  // `now` is in seconds from any start; `write` puts text on standard error; `columns` is the
  // width of the terminal.
  ProgressLine(ProgressStyle style, uint32_t columns, std::function<double()> now,
               std::function<void(std::string_view)> write);

  // Phases: "import", "build", "render", "output". The one before must have ended.
  // `unit` is what Update counts, where its rate says something.
  void Begin(const std::string& phase, const std::string& unit = "samples");
  // Within a phase; `done` of `total`.
  void Update(uint64_t done, uint64_t total);
  // Returns the seconds of the phase.
  double End();
  // Clears a line that is being updated, so that other text can be written.
  void Clear();

 private:
  std::string StatusText() const;

  ProgressStyle style_;
  uint32_t columns_;
  std::function<double()> now_;
  std::function<void(std::string_view)> write_;
  std::string phase_, unit_;
  double phase_start_ = 0;
  double last_write_ = 0;
  bool line_open_ = false;
  uint64_t done_ = 0, total_ = 0;
  double elapsed_ = 0;
  TimeLeft time_left_;
};

// "0:07", "12:34", "3:02:01"
std::string FormatDuration(double seconds);

}  // namespace swell

#endif  // SWELL_CLI_PROGRESS_H_
