// Turns the counters of a run into text: aligned columns or JSON.
#include "src/stats/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/stats/text_table.h"

namespace swell {
namespace {

using Json = nlohmann::ordered_json;

template <class T> Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> Seconds(const RunReport& report, const StageRow& row) {
  if (!report.stages_timed) return std::nullopt;
  return static_cast<double>(row.nanoseconds) * 1e-9;
}

std::optional<double> Ratio(double numerator, double denominator) {
  if (!(denominator > 0)) return std::nullopt;
  return numerator / denominator;
}

std::optional<double> PerSecond(const RunReport& report, uint64_t count) {
  return Ratio(static_cast<double>(count), report.seconds.render.value_or(0));
}

uint64_t Rays(const StageStats& stats) { return stats.closest_rays + stats.shadow_rays; }

std::string MaterialLabel(const RunReport& report, uint32_t material) {
  if (material < report.material_labels.size()) return report.material_labels[material];
  return "#" + std::to_string(material);
}

// Calls visit(stage, bounce, material or -1, row) for all rows that carried something.
template <class Visit> void ForEachRow(const StageStats& stats, const Visit& visit) {
  for (uint32_t s = 0; s < kStageCount; ++s) {
    const Stage stage = static_cast<Stage>(s);
    for (uint32_t bounce = 0; bounce < kStatsBounces; ++bounce) {
      const StageRow& row = stats.row(stage, bounce);
      if (row.rows > 0) visit(stage, bounce, int64_t{-1}, row);
      if (stage != Stage::kShade) continue;
      for (uint32_t m = 0; m < stats.material_count(); ++m) {
        const StageRow& shaded = stats.shade_row(m, bounce);
        if (shaded.rows > 0) visit(stage, bounce, int64_t{m}, shaded);
      }
    }
  }
}

Json SettingsJson(const RunSettings& s) {
  return Json{{"scene_files", s.scene_files},
              {"outfile", s.outfiles},
              {"resolution", {s.width, s.height}},
              {"crop_pixels", s.crop_pixels},
              {"spp", s.samples_per_pixel},
              {"seed", s.seed},
              {"maxdepth", s.max_depth},
              {"roulette_start", s.roulette_start},
              {"nthreads", s.thread_count},
              {"engine", s.engine},
              {"wave", s.wave},
              {"window", s.window},
              {"wave_bytes", s.wave_bytes},
              {"traversal", s.traversal},
              {"isa", s.isa},
              {"diffuse_sampling", s.diffuse_sampling},
              {"sampler", s.sampler},
              {"light_sampler", s.light_sampler},
              {"regeneration", s.regeneration},
              {"repetitions", 1}};
}

Json MachineJson(const Machine& m) {
  return Json{{"cpu", OrNull(m.cpu)}, {"isa", m.isa},           {"lanes", m.lanes},
              {"threads", m.threads}, {"compiler", m.compiler}, {"git", OrNull(m.git)}};
}

Json TotalsJson(const RunReport& report) {
  const StageStats& stats = *report.stats;
  return Json{{"paths", stats.paths},
              {"closest_rays", stats.closest_rays},
              {"shadow_rays", stats.shadow_rays},
              {"rays_per_second", OrNull(PerSecond(report, Rays(stats)))},
              {"samples_per_second", OrNull(PerSecond(report, stats.paths))},
              {"non_finite_samples", stats.non_finite_samples},
              {"peak_rss_bytes", OrNull(report.peak_rss_bytes)}};
}

// Paths of files may hold any byte; JSON holds UTF-8 only.
std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// ---------------------------------------------------------------- text

// What all tables say of a row.
std::vector<std::string> Figures(const RunReport& report, const StageRow& row, double all_seconds) {
  const std::optional<double> seconds = Seconds(report, row);
  const std::optional<double> share = Ratio(seconds.value_or(0), all_seconds);
  const std::optional<double> rate =
      Ratio(static_cast<double>(row.rows) * 1e-6, seconds.value_or(0));
  const std::optional<double> full =
      Ratio(static_cast<double>(row.lanes_active), static_cast<double>(row.lanes_issued));
  return {FormatOr("%.3f", seconds), share ? Format("%.1f %%", 100 * *share) : "-",
          FormatCount(row.rows), FormatOr("%.2f", rate),
          full ? Format("%.1f %%", 100 * *full) : "-"};
}

void Append(std::vector<std::string>& cells, std::vector<std::string> more) {
  for (std::string& cell : more) cells.push_back(std::move(cell));
}

double AllSeconds(const RunReport& report) {
  double sum = 0;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    sum += Seconds(report, report.stats->total(static_cast<Stage>(s))).value_or(0);
  }
  return sum;
}

StageRow MaterialTotal(const StageStats& stats, uint32_t material) {
  StageRow sum;
  for (uint32_t b = 0; b < kStatsBounces; ++b) sum.Add(stats.shade_row(material, b));
  return sum;
}

std::string PhasesLine(const PhaseSeconds& s) {
  std::string text;
  const auto add = [&](const char* name, const std::optional<double>& seconds) {
    if (!seconds) return;
    text += (text.empty() ? "" : ", ") + std::string(name) + Format(" %.3f s", *seconds);
  };
  add("import", s.import_files);
  add("build", s.build);
  add("render", s.render);
  add("output", s.output);
  return text;
}

std::string TotalsText(const RunReport& report) {
  const StageStats& stats = *report.stats;
  const auto mega = [](std::optional<double> rate) {
    return rate ? Format("%.3f", *rate * 1e-6) : std::string("-");
  };
  TextTable table(2);
  table.Add({"phases", PhasesLine(report.seconds)});
  table.Add({"paths", FormatCount(stats.paths) + ", " + mega(PerSecond(report, stats.paths)) +
                          " Msamples/s"});
  table.Add({"rays", FormatCount(Rays(stats)) + " (" + FormatCount(stats.closest_rays) +
                         " closest, " + FormatCount(stats.shadow_rays) + " shadow), " +
                         mega(PerSecond(report, Rays(stats))) + " Mrays/s"});
  table.Add({"non-finite samples", FormatCount(stats.non_finite_samples)});
  table.Add({"peak memory",
             report.peak_rss_bytes ? FormatBytes(*report.peak_rss_bytes) : std::string("-")});
  table.Add({"machine", report.machine.cpu.value_or("unknown CPU") + ", " + report.machine.isa +
                            ", " + std::to_string(report.machine.lanes) + " lanes, " +
                            std::to_string(report.settings.thread_count) + " threads, wave " +
                            std::to_string(report.settings.wave) + ", window " +
                            std::to_string(report.settings.window)});
  return table.Text();
}

}  // namespace

std::string StatsJson(const RunReport& report) {
  const PhaseSeconds& s = report.seconds;
  const Json seconds{{"import", OrNull(s.import_files)},
                     {"build", OrNull(s.build)},
                     {"render", OrNull(s.render)},
                     {"output", OrNull(s.output)}};
  std::string text = "{\"schema\":1";
  text += ",\n\"scene\":" + Dump(report.scene);
  text += ",\n\"settings\":" + Dump(SettingsJson(report.settings));
  text += ",\n\"machine\":" + Dump(MachineJson(report.machine));
  text += ",\n\"seconds\":" + Dump(seconds);
  text += ",\n\"totals\":" + Dump(TotalsJson(report));
  text += ",\n\"stages\":[";
  const char* separator = "\n";
  ForEachRow(*report.stats, [&](Stage stage, uint32_t bounce, int64_t material,
                                const StageRow& row) {
    const Json name =
        material < 0 ? Json(nullptr) : Json(MaterialLabel(report, static_cast<uint32_t>(material)));
    text += separator + Dump(Json{{"stage", kStageNames[static_cast<uint32_t>(stage)]},
                                  {"bounce", bounce},
                                  {"material", name},
                                  {"calls", row.calls},
                                  {"rows", row.rows},
                                  {"lanes_active", row.lanes_active},
                                  {"lanes_issued", row.lanes_issued},
                                  {"seconds", OrNull(Seconds(report, row))},
                                  {"bytes_read", row.bytes_read},
                                  {"bytes_written", row.bytes_written},
                                  {"perf", nullptr}});
    separator = ",\n";
  });
  return text + "\n]}\n";
}

namespace {

// The materials with the most rows, and the rest as one line.
void AddMaterials(const RunReport& report, double all_seconds, TextTable& table) {
  constexpr size_t kShown = 8;
  const StageStats& stats = *report.stats;
  std::vector<std::pair<StageRow, uint32_t>> materials;
  for (uint32_t m = 0; m < stats.material_count(); ++m) {
    const StageRow shaded = MaterialTotal(stats, m);
    if (shaded.rows != 0) materials.push_back({shaded, m});
  }
  std::stable_sort(materials.begin(), materials.end(),
                   [](const auto& a, const auto& b) { return a.first.rows > b.first.rows; });
  const auto add = [&](const std::string& label, const StageRow& row) {
    std::vector<std::string> cells{"  " + label};
    Append(cells, Figures(report, row, all_seconds));
    table.Add(std::move(cells));
  };
  StageRow rest;
  for (size_t i = 0; i < materials.size(); ++i) {
    if (i < kShown || materials.size() == kShown + 1) {
      add(MaterialLabel(report, materials[i].second), materials[i].first);
    } else {
      rest.Add(materials[i].first);
    }
  }
  if (rest.rows != 0) add(std::to_string(materials.size() - kShown) + " more materials", rest);
}

}  // namespace

std::string SummaryTable(const RunReport& report) {
  const StageStats& stats = *report.stats;
  const double all = AllSeconds(report);
  TextTable table(1);
  table.Add({"stage", "worker s", "share", "rows", "Mrows/s", "lanes full"});
  for (uint32_t s = 0; s < kStageCount; ++s) {
    const StageRow row = stats.total(static_cast<Stage>(s));
    if (row.rows == 0) continue;
    std::vector<std::string> cells{kStageNames[s]};
    Append(cells, Figures(report, row, all));
    table.Add(std::move(cells));
    if (static_cast<Stage>(s) != Stage::kShade) continue;
    AddMaterials(report, all, table);
  }
  return table.Text() + "\n" + TotalsText(report);
}

std::string StageTable(const RunReport& report) {
  const double all = AllSeconds(report);
  TextTable table(2);
  table.Add({"stage", "material", "bounce", "calls", "worker s", "share", "rows", "Mrows/s",
             "lanes full"});
  ForEachRow(*report.stats, [&](Stage stage, uint32_t bounce, int64_t material,
                                const StageRow& row) {
    std::vector<std::string> cells{
        kStageNames[static_cast<uint32_t>(stage)],
        material < 0 ? "-" : MaterialLabel(report, static_cast<uint32_t>(material)),
        std::to_string(bounce) + (bounce + 1 == kStatsBounces ? "+" : ""), FormatCount(row.calls)};
    Append(cells, Figures(report, row, all));
    table.Add(std::move(cells));
  });
  return table.Text() + "\n" + TotalsText(report);
}

std::string FormatBytes(uint64_t bytes) {
  static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return unit == 0 ? std::to_string(bytes) + " B" : Format("%.2f %s", value, kUnits[unit]);
}

std::string FormatCount(uint64_t count) {
  std::string digits = std::to_string(count);
  for (size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

}  // namespace swell
