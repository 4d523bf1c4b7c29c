// Samples done and a clock in, lines of text out.
#include "src/cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace swell {
namespace {

constexpr double kTerminalInterval = 0.1;  // seconds between updates
constexpr double kLinesInterval = 5.0;
constexpr double kFirstEstimate = 1.0;  // seconds before a time left is shown
constexpr size_t kPoints = 96;
constexpr int kBarWidth = 24;
constexpr const char* kClearLine = "\r\x1b[K";

std::string Bar(double fraction) {
  const int full = static_cast<int>(fraction * kBarWidth);
  return "[" + std::string(full, '#') + std::string(kBarWidth - full, '-') + "]";
}

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

}  // namespace

void TimeLeft::Add(double seconds, uint64_t done) {
  if (!points_.empty() && (done < points_.back().done || seconds < points_.back().seconds)) return;
  if (points_.size() == kPoints) {
    // Thin out: every second point is enough to look back by a third.
    size_t kept = 0;
    for (size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
    points_.resize(kept);
  }
  points_.push_back({seconds, done});
}

std::optional<double> TimeLeft::Estimate(uint64_t total) const {
  if (points_.size() < 2) return std::nullopt;
  const Point& first = points_.front();
  const Point& last = points_.back();
  const double elapsed = last.seconds - first.seconds;
  if (elapsed < kFirstEstimate || last.done == first.done) return std::nullopt;
  const double since = last.seconds - std::max(elapsed / 3, kFirstEstimate);
  Point from = first;
  for (const Point& point : points_) {
    if (point.seconds <= since && point.done < last.done) from = point;
  }
  const double rate = static_cast<double>(last.done - from.done) / (last.seconds - from.seconds);
  return static_cast<double>(total - std::min(total, last.done)) / rate;
}

ProgressLine::ProgressLine(ProgressStyle style, uint32_t columns, std::function<double()> now,
                           std::function<void(std::string_view)> write)
    : style_(style), columns_(columns), now_(std::move(now)), write_(std::move(write)) {}

void ProgressLine::Begin(const std::string& phase, const std::string& unit) {
  phase_ = phase;
  unit_ = unit;
  phase_start_ = last_write_ = now_();
  done_ = total_ = 0;
  elapsed_ = 0;
  time_left_ = TimeLeft();
  time_left_.Add(0, 0);
  if (style_ != ProgressStyle::kTerminal) return;
  write_(kClearLine + phase_ + " ...");
  line_open_ = true;
}

void ProgressLine::Update(uint64_t done, uint64_t total) {
  if (style_ == ProgressStyle::kNone) return;
  const double now = now_();
  const double interval = style_ == ProgressStyle::kTerminal ? kTerminalInterval : kLinesInterval;
  elapsed_ = now - phase_start_;
  done_ = done;
  total_ = total;
  time_left_.Add(elapsed_, done);
  if (now - last_write_ < interval) return;
  last_write_ = now;
  const std::string text = StatusText();
  if (style_ == ProgressStyle::kLines) {
    write_("swell: " + text + "\n");
    return;
  }
  write_(kClearLine + text.substr(0, columns_ > 1 ? columns_ - 1 : 0));
  line_open_ = true;
}

double ProgressLine::End() {
  const double seconds = now_() - phase_start_;
  if (style_ == ProgressStyle::kNone) return seconds;
  std::string text = phase_ + " " + Number("%.2f s", seconds);
  if (total_ > 0 && seconds > 0 && !unit_.empty()) {
    text += ", " + Number("%.2f M", static_cast<double>(total_) / seconds * 1e-6) + unit_ + "/s";
  }
  Clear();
  write_((style_ == ProgressStyle::kLines ? "swell: " : "") + text + "\n");
  return seconds;
}

void ProgressLine::Clear() {
  if (!line_open_) return;
  write_(kClearLine);
  line_open_ = false;
}

std::string ProgressLine::StatusText() const {
  const double fraction =
      total_ == 0 ? 0 : std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_));
  std::string text = phase_ + " ";
  if (style_ == ProgressStyle::kTerminal) text += Bar(fraction) + " ";
  // Rounded down: 100 % is said only when all is done.
  text += Number("%.1f %%", std::floor(fraction * 1000) / 10);
  if (elapsed_ > 0 && !unit_.empty()) {
    text += ", " + Number("%.2f M", static_cast<double>(done_) / elapsed_ * 1e-6) + unit_ + "/s";
  }
  text += ", " + FormatDuration(elapsed_) + " elapsed";
  const std::optional<double> left = time_left_.Estimate(total_);
  if (left) text += ", " + FormatDuration(*left) + " left";
  return text;
}

std::string FormatDuration(double seconds) {
  const uint64_t whole = static_cast<uint64_t>(std::llround(std::clamp(seconds, 0.0, 1e9)));
  char text[48];
  if (whole < 3600) {
    std::snprintf(text, sizeof(text), "%u:%02u", static_cast<unsigned>(whole / 60),
                  static_cast<unsigned>(whole % 60));
  } else {
    std::snprintf(text, sizeof(text), "%llu:%02u:%02u",
                  static_cast<unsigned long long>(whole / 3600),
                  static_cast<unsigned>(whole / 60 % 60), static_cast<unsigned>(whole % 60));
  }
  return text;
}

}  // namespace swell
