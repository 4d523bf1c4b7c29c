// The report of a run: every name of the JSON contract, and tables a person can read.
#include "src/stats/report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace swell {
namespace {

using Json = nlohmann::json;

std::set<std::string> Names(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

StageStats MakeStats() {
  StageStats stats(3);
  BounceCounts camera{}, mixed{};
  camera[0] = 1000;
  mixed[0] = 600;
  mixed[1] = 200;
  stats.Record(Stage::kGenerate, camera, {1, 1000, 1000, 1000, 2000000, 0, 64000});
  stats.Record(Stage::kIntersect, mixed, {2, 800, 700, 1000, 4000000, 100, 200});
  stats.RecordShade(0, mixed, {1, 800, 790, 800, 3000000, 10, 20});
  stats.RecordShade(2, camera, {1, 1000, 900, 1000, 1000000, 10, 20});
  stats.paths = 1000;
  stats.closest_rays = 1234567;
  stats.shadow_rays = 765433;
  stats.non_finite_samples = 3;
  return stats;
}

RunReport MakeReport(const StageStats& stats) {
  RunReport report;
  report.scene = "cornell.pbrt";
  report.settings.scene_files = {"cornell.pbrt"};
  report.settings.outfiles = {"a.exr", "b.png"};
  report.settings.width = 64;
  report.settings.height = 48;
  report.settings.crop_pixels = {0, 32, 0, 48};
  report.settings.samples_per_pixel = 16;
  report.settings.thread_count = 2;
  report.settings.engine = "wavefront";
  report.settings.wave = 4096;
  report.settings.window = 64;
  report.settings.traversal = "auto";
  report.settings.isa = "auto";
  report.settings.diffuse_sampling = "disk";
  report.machine = {"a CPU", "avx2", 8, 2, "g++ 12.2.0", std::nullopt};
  report.seconds = {0.25, 0.5, 2.0, std::nullopt};
  report.peak_rss_bytes = 5u << 20;
  report.material_labels = {"white", "diffuse#1", "glass"};
  report.stats = &stats;
  return report;
}

TEST_CASE("StatsJson: has exactly the names of the contract") {
  const StageStats stats = MakeStats();
  const Json json = Json::parse(StatsJson(MakeReport(stats)));
  CHECK(Names(json) == std::set<std::string>{"schema", "scene", "settings", "machine", "seconds",
                                             "totals", "stages"});
  CHECK(json["schema"] == 1);
  CHECK(json["scene"] == "cornell.pbrt");
  CHECK(Names(json["machine"]) ==
        std::set<std::string>{"cpu", "isa", "lanes", "threads", "compiler", "git"});
  CHECK(Names(json["seconds"]) == std::set<std::string>{"import", "build", "render", "output"});
  CHECK(Names(json["totals"]) == std::set<std::string>{"paths", "closest_rays", "shadow_rays",
                                                       "rays_per_second", "samples_per_second",
                                                       "non_finite_samples", "peak_rss_bytes"});
  for (const Json& row : json["stages"]) {
    CHECK(Names(row) == std::set<std::string>{"stage", "bounce", "material", "calls", "rows",
                                              "lanes_active", "lanes_issued", "seconds",
                                              "bytes_read", "bytes_written", "perf"});
    CHECK(row["perf"].is_null());
    CHECK(row["rows"] > 0);
  }
}

TEST_CASE("StatsJson: has one row for each stage, bounce and material with rows") {
  const StageStats stats = MakeStats();
  const Json stages = Json::parse(StatsJson(MakeReport(stats)))["stages"];
  std::multiset<std::string> keys;
  for (const Json& row : stages) {
    keys.insert(row["stage"].get<std::string>() + " " + row["bounce"].dump() + " " +
                row["material"].dump() + " " + row["rows"].dump());
  }
  CHECK(keys == std::multiset<std::string>{"generate 0 null 1000", "intersect 0 null 600",
                                           "intersect 1 null 200", "shade 0 \"white\" 600",
                                           "shade 1 \"white\" 200", "shade 0 \"glass\" 1000"});
}

TEST_CASE("StatsJson: seconds, lanes and rates are the counters' own") {
  const StageStats stats = MakeStats();
  const Json json = Json::parse(StatsJson(MakeReport(stats)));
  const Json& generate = json["stages"][0];
  CHECK(generate["seconds"].get<double>() == doctest::Approx(0.002));
  CHECK(generate["lanes_active"] == 1000);
  CHECK(generate["bytes_written"] == 64000);
  CHECK(json["totals"]["rays_per_second"].get<double>() == doctest::Approx(1e6));
  CHECK(json["totals"]["samples_per_second"].get<double>() == doctest::Approx(500));
  CHECK(json["totals"]["peak_rss_bytes"] == 5 << 20);
  CHECK(json["totals"]["non_finite_samples"] == 3);
}

TEST_CASE("StatsJson: settings hold every option in effect") {
  const StageStats stats = MakeStats();
  const Json settings = Json::parse(StatsJson(MakeReport(stats)))["settings"];
  CHECK(settings["scene_files"] == Json({"cornell.pbrt"}));
  CHECK(settings["outfile"] == Json({"a.exr", "b.png"}));
  CHECK(settings["resolution"] == Json({64, 48}));
  CHECK(settings["crop_pixels"] == Json({0, 32, 0, 48}));
  CHECK(settings["spp"] == 16);
  CHECK(settings["nthreads"] == 2);
  CHECK(settings["wave"] == 4096);
  CHECK(settings["window"] == 64);
  CHECK(settings["regeneration"] == true);
  for (const char* name : {"seed", "maxdepth", "roulette_start", "engine", "wave_bytes",
                           "traversal", "isa", "diffuse_sampling", "sampler", "light_sampler"}) {
    INFO(name);
    CHECK(settings.contains(name));
  }
}

TEST_CASE("StatsJson: what was not measured is null, never 0") {
  const StageStats stats(0);
  RunReport report = MakeReport(stats);
  report.machine.cpu.reset();
  report.seconds = {};
  report.peak_rss_bytes.reset();
  const Json json = Json::parse(StatsJson(report));
  CHECK(json["machine"]["cpu"].is_null());
  CHECK(json["machine"]["git"].is_null());
  CHECK(json["seconds"]["render"].is_null());
  CHECK(json["totals"]["rays_per_second"].is_null());
  CHECK(json["totals"]["samples_per_second"].is_null());
  CHECK(json["totals"]["peak_rss_bytes"].is_null());
  CHECK(json["stages"].empty());
  CHECK(json["stages"].is_array());
}

TEST_CASE("StatsJson: stages that were not timed have no seconds") {
  const StageStats stats = MakeStats();
  RunReport report = MakeReport(stats);
  report.stages_timed = false;
  const Json json = Json::parse(StatsJson(report));
  REQUIRE(!json["stages"].empty());
  for (const Json& row : json["stages"]) CHECK(row["seconds"].is_null());
  CHECK(json["stages"][0]["rows"] == 1000);
  CHECK(json["seconds"]["render"] == 2.0);
}

TEST_CASE("StatsJson: names of any bytes still make valid JSON") {
  const StageStats stats = MakeStats();
  RunReport report = MakeReport(stats);
  report.scene = "a\"b\\c\n\xff.pbrt";
  report.material_labels[0] = "\xc3";
  CHECK(Json::accept(StatsJson(report)));
}

// The line of `text` that holds `word`, or "".
std::string LineWith(const std::string& text, const std::string& word) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(word) != std::string::npos) return line;
  }
  return "";
}

TEST_CASE("SummaryTable: says share, rows, rate and lane use of a stage") {
  const StageStats stats = MakeStats();
  const std::string table = SummaryTable(MakeReport(stats));
  const std::string line = LineWith(table, "intersect");
  CHECK(line.find("0.004") != std::string::npos);   // worker seconds
  CHECK(line.find("40.0 %") != std::string::npos);  // of 10 ms
  CHECK(line.find("800") != std::string::npos);
  CHECK(line.find("0.20") != std::string::npos);    // Mrows/s
  CHECK(line.find("70.0 %") != std::string::npos);  // lanes
}

TEST_CASE("SummaryTable: lists the materials that were shaded, and the totals") {
  const StageStats stats = MakeStats();
  const std::string table = SummaryTable(MakeReport(stats));
  CHECK(LineWith(table, "white").find("98.8 %") != std::string::npos);
  CHECK(LineWith(table, "glass").find("90.0 %") != std::string::npos);
  CHECK(LineWith(table, "diffuse#1").empty());
  CHECK(LineWith(table, "rays").find("2,000,000 (1,234,567 closest, 765,433 shadow)") !=
        std::string::npos);
  CHECK(LineWith(table, "rays").find("1.000 Mrays/s") != std::string::npos);
  CHECK(LineWith(table, "non-finite").find("3") != std::string::npos);
  CHECK(LineWith(table, "peak memory").find("5.00 MiB") != std::string::npos);
  CHECK(LineWith(table, "phases").find("import 0.250 s, build 0.500 s, render 2.000 s") !=
        std::string::npos);
}

TEST_CASE("SummaryTable: an empty run has no figures that were not measured") {
  const StageStats stats(0);
  RunReport report = MakeReport(stats);
  report.seconds.render.reset();
  const std::string table = SummaryTable(report);
  CHECK(table.find("nan") == std::string::npos);
  CHECK(table.find("inf") == std::string::npos);
  CHECK(LineWith(table, "paths").find("0, - Msamples/s") != std::string::npos);
}

TEST_CASE("SummaryTable: stages that were not timed show no seconds, share or rate") {
  const StageStats stats = MakeStats();
  RunReport report = MakeReport(stats);
  report.stages_timed = false;
  const std::string line = LineWith(SummaryTable(report), "intersect");
  CHECK(line.find("0.004") == std::string::npos);
  CHECK(line.find("70.0 %") != std::string::npos);  // lanes are counted all the same
  CHECK(std::count(line.begin(), line.end(), '-') == 3);
}

TEST_CASE("StageTable: has a line for each bounce and material") {
  const StageStats stats = MakeStats();
  const std::string table = StageTable(MakeReport(stats));
  size_t white = 0;
  for (size_t at = 0; (at = table.find("white", at)) != std::string::npos; ++at) ++white;
  CHECK(white == 2);
}

TEST_CASE("FormatCount: groups thousands") {
  CHECK(FormatCount(0) == "0");
  CHECK(FormatCount(999) == "999");
  CHECK(FormatCount(1000) == "1,000");
  CHECK(FormatCount(12345678901) == "12,345,678,901");
}

TEST_CASE("FormatBytes: takes the largest unit that fits") {
  CHECK(FormatBytes(0) == "0 B");
  CHECK(FormatBytes(1023) == "1023 B");
  CHECK(FormatBytes(1536) == "1.50 KiB");
  CHECK(FormatBytes(3ull << 40) == "3.00 TiB");
}

}  // namespace
}  // namespace swell
