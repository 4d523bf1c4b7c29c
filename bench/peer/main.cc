// swell_bench_peer: scenes in, a table of swell's rates beside those of a path tracer on Embree
// out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bench/peer/measure.h"
#include "bench/peer/tables.h"
#include "bench/scenes.h"
#include "src/film/write_image.h"
#include "src/stats/machine.h"

namespace swell::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes = {"cornell", "room"};
  std::vector<uint32_t> thread_counts = {2, 1};
  MeasureOptions measure;
  std::vector<std::string> light_samplers = {"auto"};
  std::string json_file;
  std::string image_folder;
};

Status WriteImages(const SceneFigures& figures, const std::string& folder) {
  for (size_t e = 0; e < 2; ++e) {
    const Image& image = figures.engines[e].image;
    const std::string path = folder + "/" + figures.scene + (e == 0 ? "_peer.exr" : "_swell.exr");
    if (Status s = WriteImage(path, image, {}); !s) return s;
  }
  return Done{};
}

LightSampler SamplerOf(const std::string& name) {
  const auto found = std::find(std::begin(kLightSamplerNames), std::end(kLightSamplerNames), name);
  return static_cast<LightSampler>(found - std::begin(kLightSamplerNames));
}

Status Run(const Arguments& arguments) {
  std::vector<SceneFigures> all;
  const LightSampler sampler = SamplerOf(arguments.light_samplers[0]);
  for (const std::string& name : arguments.scenes) {
    const Result<std::unique_ptr<BuiltScene>> scene = BuildScene(name, sampler);
    if (!scene) return scene.error();
    for (uint32_t threads : arguments.thread_counts) {
      MeasureOptions options = arguments.measure;
      options.thread_count = threads;
      for (size_t i = 1; i < arguments.light_samplers.size(); ++i) {
        options.other_samplers.push_back(SamplerOf(arguments.light_samplers[i]));
      }
      Result<SceneFigures> figures = Measure(name, **scene, options);
      if (!figures) return figures.error();
      std::printf("%s\n", Details(*figures).c_str());
      std::fflush(stdout);
      all.push_back(std::move(*figures));
    }
    if (arguments.image_folder.empty()) continue;
    if (Status s = WriteImages(all.back(), arguments.image_folder); !s) return s;
  }
  if (!arguments.json_file.empty()) {
    std::ofstream file(arguments.json_file);
    file << ToJson(all);
    if (!file.flush()) return Error{arguments.json_file + ": cannot be written"};
  }
  const Machine machine = DescribeMachine(Width::kWide);
  std::printf("%s, %s, %u threads, %s; %u samples per pixel, %u repetitions\n\n",
              machine.cpu.value_or("unknown CPU").c_str(), machine.isa.c_str(), machine.threads,
              machine.compiler.c_str(), arguments.measure.samples_per_pixel,
              arguments.measure.repetitions);
  std::printf("%s", MarkdownTable(all).c_str());
  const std::string errors = ErrorTable(all);
  if (!errors.empty()) std::printf("\n%s", errors.c_str());
  return Done{};
}

}  // namespace
}  // namespace swell::bench

int main(int argc, char** argv) {
  swell::bench::Arguments arguments;
  CLI::App app("Renders scenes with a path tracer on Embree 3 and with swell, in alternation.");
  app.add_option("scenes", arguments.scenes, "cornell, room, bigmesh, lights-1000 or scene files")
      ->capture_default_str();
  app.add_option("--spp", arguments.measure.samples_per_pixel, "samples per pixel")
      ->check(CLI::Range(1, 1 << 16))
      ->capture_default_str();
  app.add_option("--reps", arguments.measure.repetitions, "repetitions of each engine")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--nthreads", arguments.thread_counts, "numbers of threads, one table row each")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--maxdepth", arguments.measure.max_depth, "scatterings, instead of the scene's");
  app.add_option("--wave", arguments.measure.wave, "rows of swell's waves; 0: its default")
      ->capture_default_str();
  app.add_option("--lightsampler", arguments.light_samplers,
                 "how lights are drawn; the peer, as the first of several says, knows uniform and "
                 "power, and takes power for bvh")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(swell::kLightSamplerNames),
                                                     std::end(swell::kLightSamplerNames))))
      ->capture_default_str();
  app.add_flag("!--no-window-8", arguments.measure.window_8, "leave out swell --window 8");
  app.add_flag("!--no-megakernel", arguments.measure.megakernel,
               "leave out swell --engine megakernel");
  app.add_option("--error", arguments.measure.true_samples,
                 "samples per pixel of a picture to compare with: also tells mean squared error x "
                 "time")
      ->check(CLI::Range(2, 1 << 20));
  app.add_option("--json", arguments.json_file, "also write all figures to this file");
  app.add_option("--images", arguments.image_folder, "also write the pictures to this folder");
  CLI11_PARSE(app, argc, argv);

  const swell::Status status = swell::bench::Run(arguments);
  if (status) return 0;
  std::fprintf(stderr, "swell_bench_peer: %s\n", status.error().message.c_str());
  return 1;
}
