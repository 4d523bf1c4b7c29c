// The progress of a run as text, under a clock that the test turns.
#include "src/cli/progress.h"

#include <doctest/doctest.h>

namespace swell {
namespace {

// A progress line with its clock and all it wrote.
struct Fixture {
  double now = 100;
  std::string text;
  ProgressLine line;

  explicit Fixture(ProgressStyle style, uint32_t columns = 200)
      : line(
            style, columns, [this] { return now; },
            [this](std::string_view more) { text += more; }) {}

  std::string Take() {
    std::string taken;
    taken.swap(text);
    return taken;
  }
};

TEST_CASE("ProgressLine: without a terminal it writes whole lines, at most every 5 seconds") {
  Fixture f(ProgressStyle::kLines);
  f.line.Begin("render");
  int lines = 0;
  for (int i = 1; i <= 200; ++i) {
    f.now = 100 + 0.1 * i;
    f.line.Update(static_cast<uint64_t>(i), 200);
    const std::string text = f.Take();
    if (text.empty()) continue;
    ++lines;
    CHECK(text.back() == '\n');
    CHECK(text.find('\r') == std::string::npos);
    CHECK(text.find('\x1b') == std::string::npos);
  }
  CHECK(lines >= 3);
  CHECK(lines <= 4);
  f.line.End();
  CHECK(f.text.rfind("swell: render 20.00 s", 0) == 0);
}

TEST_CASE("ProgressLine: a line names phase, percent, rate, time elapsed and left") {
  Fixture f(ProgressStyle::kLines);
  f.line.Begin("render");
  f.now = 103;
  f.line.Update(12'500'000, 100'000'000);
  f.now = 106;
  f.line.Update(25'000'000, 100'000'000);
  CHECK(f.text == "swell: render 25.0 %, 4.17 Msamples/s, 0:06 elapsed, 0:18 left\n");
}

TEST_CASE("ProgressLine: a phase without a unit shows no rate") {
  Fixture f(ProgressStyle::kLines);
  f.line.Begin("build", "");
  f.now += 6;
  f.line.Update(1, 4);
  f.now += 1;
  f.line.End();
  CHECK(f.text.find("25.0 %, 0:06 elapsed") != std::string::npos);
  CHECK(f.text.find("build 7.00 s\n") != std::string::npos);
}

TEST_CASE("ProgressLine: on a terminal one line is written over") {
  Fixture f(ProgressStyle::kTerminal);
  f.line.Begin("import");
  CHECK(f.Take() == "\r\x1b[Kimport ...");
  f.now += 0.5;
  f.line.End();
  CHECK(f.Take() == "\r\x1b[Kimport 0.50 s\n");
  f.line.Begin("render");
  f.Take();
  f.now += 2;
  f.line.Update(50, 100);
  const std::string text = f.Take();
  CHECK(text.rfind("\r\x1b[Krender [############------------] 50.0 %", 0) == 0);
  CHECK(text.find('\n') == std::string::npos);
  f.line.Clear();
  CHECK(f.Take() == "\r\x1b[K");
  f.line.Clear();
  CHECK(f.Take().empty());
}

TEST_CASE("ProgressLine: never reaches the terminal's last column") {
  Fixture f(ProgressStyle::kTerminal, 30);
  f.line.Begin("render");
  f.Take();
  f.now += 2;
  f.line.Update(50, 100);
  CHECK(f.text.size() == std::string("\r\x1b[K").size() + 29);
}

TEST_CASE("ProgressLine: says 100 % only when all is done") {
  Fixture f(ProgressStyle::kLines);
  f.line.Begin("render");
  f.now += 10;
  f.line.Update(999'999, 1'000'000);
  CHECK(f.Take().find("99.9 %") != std::string::npos);
  f.now += 10;
  f.line.Update(1'000'000, 1'000'000);
  CHECK(f.Take().find("100.0 %") != std::string::npos);
}

TEST_CASE("ProgressLine: quiet writes nothing but still measures") {
  Fixture f(ProgressStyle::kNone);
  f.line.Begin("render");
  f.now += 7;
  f.line.Update(1, 2);
  CHECK(f.line.End() == doctest::Approx(7));
  CHECK(f.text.empty());
}

TEST_CASE("TimeLeft: says nothing before it has a rate") {
  TimeLeft left;
  CHECK(!left.Estimate(100));
  left.Add(0, 0);
  CHECK(!left.Estimate(100));
  left.Add(0.5, 1);
  CHECK(!left.Estimate(100));
  left.Add(5, 0);
  CHECK(!left.Estimate(100));
}

TEST_CASE("TimeLeft: a steady rate gives the exact rest") {
  TimeLeft left;
  for (int i = 0; i <= 1000; ++i) left.Add(0.1 * i, static_cast<uint64_t>(10 * i));
  REQUIRE(left.Estimate(20000).has_value());
  CHECK(*left.Estimate(20000) == doctest::Approx(100).epsilon(0.001));
}

TEST_CASE("TimeLeft: forgets a fast start") {
  TimeLeft left;
  uint64_t done = 0;
  for (int i = 0; i <= 600; ++i) {
    left.Add(0.1 * i, done);
    done += i < 200 ? 1000 : 10;  // 20 s of sky, then 40 s of glass at 100 per second
  }
  const uint64_t total = done + 10000;
  CHECK(*left.Estimate(total) == doctest::Approx(100).epsilon(0.05));
}

TEST_CASE("TimeLeft: is 0 at the end and finite before") {
  TimeLeft left;
  left.Add(0, 0);
  left.Add(10, 100);
  left.Add(20, 100);  // a stall
  CHECK(*left.Estimate(100) == 0);
  CHECK(*left.Estimate(200) > 0);
  CHECK(*left.Estimate(200) < 1000);
}

TEST_CASE("FormatDuration: minutes and seconds, hours where needed") {
  CHECK(FormatDuration(-1) == "0:00");
  CHECK(FormatDuration(0.4) == "0:00");
  CHECK(FormatDuration(7) == "0:07");
  CHECK(FormatDuration(59.6) == "1:00");
  CHECK(FormatDuration(3599.4) == "59:59");
  CHECK(FormatDuration(3 * 3600 + 2 * 60 + 1) == "3:02:01");
}

}  // namespace
}  // namespace swell
