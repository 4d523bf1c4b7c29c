// Figures in, Markdown, plain lines and JSON out.
#include "bench/peer/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/spread.h"
#include "src/stats/machine.h"

namespace swell::bench {
namespace {

[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

std::vector<double> RatesOf(const SceneFigures& scene, const EngineFigures& engine) {
  std::vector<double> rates;
  for (double s : engine.seconds) rates.push_back(static_cast<double>(scene.samples) / s / 1e6);
  return rates;
}

// Of repetitions that ran next to each other, so that a busy machine slows both.
std::vector<double> RatiosOf(const EngineFigures& peer, const EngineFigures& engine) {
  std::vector<double> ratios;
  for (size_t i = 0; i < engine.seconds.size(); ++i) {
    ratios.push_back(peer.seconds[i] / engine.seconds[i]);
  }
  return ratios;
}

// Error times seconds, by repetition: what independent samples do not change by their number.
struct Costs {
  std::vector<double> squared, relative;
};
Costs CostsOf(const EngineFigures& engine) {
  Costs costs;
  for (size_t i = 0; i < engine.errors.size(); ++i) {
    costs.squared.push_back(engine.errors[i].squared * engine.seconds[i]);
    costs.relative.push_back(engine.errors[i].relative * engine.seconds[i]);
  }
  return costs;
}
std::vector<double> Over(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return ratios;
}

uint64_t StageNanoseconds(const StageStats& stats) {
  uint64_t sum = 0;
  for (uint32_t s = 0; s < kStageCount; ++s) sum += stats.total(static_cast<Stage>(s)).nanoseconds;
  return sum;
}

double Percent(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string StageShares(const EngineFigures& engine) {
  const uint64_t whole = StageNanoseconds(engine.stats);
  if (whole == 0) return "stages not timed";
  std::string text;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    const StageRow row = engine.stats.total(static_cast<Stage>(s));
    if (row.nanoseconds == 0) continue;
    text += Format("%s%s %.1f %%", text.empty() ? "" : ", ", kStageNames[s],
                   Percent(row.nanoseconds, whole));
  }
  return text;
}

double LaneUse(const EngineFigures& engine) {
  const StageRow shade = engine.stats.total(Stage::kShade);
  return Percent(shade.lanes_active, shade.lanes_issued);
}

double RegroupingShare(const EngineFigures& engine) {
  return Percent(engine.stats.total(Stage::kSort).nanoseconds +
                     engine.stats.total(Stage::kCompact).nanoseconds,
                 StageNanoseconds(engine.stats));
}

}  // namespace

std::string MarkdownTable(const std::vector<SceneFigures>& scenes) {
  std::string text =
      "| scene | threads | engine | Msamples/s, median | quartiles | range | ratio to the peer |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SceneFigures& scene : scenes) {
    for (const EngineFigures& engine : scene.engines) {
      const Spread rate = SpreadOf(RatesOf(scene, engine));
      const Spread ratio = SpreadOf(RatiosOf(scene.engines[0], engine));
      text += Format("| %s | %u | %s | %.3f | %.3f-%.3f | %.3f-%.3f | %.2f (%.2f-%.2f) |\n",
                     scene.scene.c_str(), scene.thread_count, engine.name.c_str(), rate.median,
                     rate.lower, rate.upper, rate.least, rate.most, ratio.median, ratio.lower,
                     ratio.upper);
    }
  }
  return text;
}

std::string ErrorTable(const std::vector<SceneFigures>& scenes) {
  std::string text;
  for (const SceneFigures& scene : scenes) {
    const EngineFigures& peer = scene.engines[0];
    for (const EngineFigures& engine : scene.engines) {
      if (engine.errors.empty()) continue;
      const Costs costs = CostsOf(engine), others = CostsOf(peer);
      const Spread squared = SpreadOf(costs.squared), relative = SpreadOf(costs.relative);
      const Spread gain = SpreadOf(Over(others.squared, costs.squared));
      const Spread relative_gain = SpreadOf(Over(others.relative, costs.relative));
      text += Format(
          "| %s | %u | %s | %u | %.3g (%.3g-%.3g) | %.2f (%.2f-%.2f) | %.3g | %.2f (%.2f-%.2f) |\n",
          scene.scene.c_str(), scene.thread_count, engine.name.c_str(), scene.samples_per_pixel,
          squared.median, squared.lower, squared.upper, gain.median, gain.lower, gain.upper,
          relative.median, relative_gain.median, relative_gain.lower, relative_gain.upper);
    }
  }
  if (text.empty()) return text;
  return "| scene | threads | engine | samples | MSE x s | the peer's over it | relative MSE x s | "
         "the peer's over it |\n|---|---|---|---|---|---|---|---|\n" +
         text;
}

std::string Details(const SceneFigures& scene) {
  const Agreement& agreement = scene.agreement;
  const bool agrees = std::abs(agreement.difference) <= 3 * agreement.noise;
  std::string text = Format(
      "%s, %u threads, %zu repetitions of %llu samples\n"
      "  mean pixel against the peer: %+.3f %% (standard error %.3f %%): %s\n",
      scene.scene.c_str(), scene.thread_count, scene.engines[0].seconds.size(),
      static_cast<unsigned long long>(scene.samples), 100 * agreement.difference,
      100 * agreement.noise, agrees ? "within noise" : "DIFFERENT");
  for (size_t e = 1; e < scene.engines.size(); ++e) {
    const EngineFigures& engine = scene.engines[e];
    const auto paths = static_cast<double>(engine.stats.paths);
    const char* picture = e == 1                 ? "is the reference"
                          : !engine.same_picture ? "has other samples"
                          : *engine.same_picture ? "equal to the bit"
                                                 : "DIFFERENT";
    text +=
        Format("  %s: picture %s; %s\n", engine.name.c_str(), picture, StageShares(engine).c_str());
    text += "    ";
    // Small windows are not timed stage by stage: what was not measured is left out.
    const double regrouping = RegroupingShare(engine);
    if (regrouping > 0.0) text += Format("sort + compact %.1f %% of the stages, ", regrouping);
    text += Format("shading lanes %.1f %% full, %.2f closest + %.2f shadow rays a sample\n",
                   LaneUse(engine), static_cast<double>(engine.stats.closest_rays) / paths,
                   static_cast<double>(engine.stats.shadow_rays) / paths);
  }
  return text;
}

std::string ToJson(const std::vector<SceneFigures>& scenes) {
  using nlohmann::json;
  const auto optional = [](const auto& value) { return value ? json(*value) : json(nullptr); };
  json rows = json::array();
  for (const SceneFigures& scene : scenes) {
    for (const EngineFigures& engine : scene.engines) {
      json row = {{"scene", scene.scene},
                  {"threads", scene.thread_count},
                  {"engine", engine.name},
                  {"samples", scene.samples},
                  {"seconds", engine.seconds}};
      json stages = json::object();
      for (uint32_t s = 0; s < kStageCount; ++s) {
        const StageRow total = engine.stats.total(static_cast<Stage>(s));
        if (total.nanoseconds == 0) continue;
        stages[kStageNames[s]] = {{"seconds", static_cast<double>(total.nanoseconds) * 1e-9},
                                  {"rows", total.rows},
                                  {"lanes_active", total.lanes_active},
                                  {"lanes_issued", total.lanes_issued}};
      }
      for (const PictureError& error : engine.errors) {
        row["squared_errors"].push_back(error.squared);
        row["relative_squared_errors"].push_back(error.relative);
      }
      if (engine.same_picture) row["same_picture"] = *engine.same_picture;
      row["stages"] = stages.empty() ? json(nullptr) : stages;
      rows.push_back(row);
    }
    rows.push_back({{"scene", scene.scene},
                    {"threads", scene.thread_count},
                    {"mean_difference", scene.agreement.difference},
                    {"mean_difference_noise", scene.agreement.noise}});
  }
  const Machine machine = DescribeMachine(Width::kWide);
  const json document = {{"machine",
                          {{"cpu", optional(machine.cpu)},
                           {"isa", machine.isa},
                           {"lanes", machine.lanes},
                           {"threads", machine.threads},
                           {"compiler", machine.compiler},
                           {"git", optional(machine.git)}}},
                         {"runs", rows}};
  return document.dump(1) + "\n";
}

}  // namespace swell::bench
