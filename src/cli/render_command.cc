// swell render: scene files in, images and statistics out.
#include <chrono>
#include <optional>
#include <utility>

#include "src/bvh/bvh.h"
#include "src/cli/commands.h"
#include "src/cli/progress.h"
#include "src/cli/resolve.h"
#include "src/cli/terminal.h"
#include "src/base/new_file.h"
#include "src/film/write_image.h"
#include "src/import/import_scene.h"
#include "src/import/read_meter.h"
#include "src/schedule/render.h"
#include "src/schedule/ticker.h"
#include "src/stats/isa.h"
#include "src/stats/report.h"

namespace swell {
namespace {

constexpr uint32_t kRouletteStart = 3;  // paths may end at random after this bounce

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Traversal ToTraversal(TraversalChoice choice) {
  switch (choice) {
    case TraversalChoice::kPacket:
      return Traversal::kPacket;
    case TraversalChoice::kSingle:
      return Traversal::kSingle;
    case TraversalChoice::kAuto:
      break;
  }
  return Traversal::kAuto;
}

RenderOptions ToRenderOptions(const RenderCommand& command, const RenderRequest& request,
                              const PixelBounds& crop) {
  RenderOptions options;
  options.width = request.width;
  options.height = request.height;
  options.crop = crop;
  options.samples_per_pixel = request.samples_per_pixel;
  options.thread_count = command.thread_count;
  options.path = {request.seed,
                  request.max_depth,
                  kRouletteStart,
                  command.diffuse_sampling,
                  {request.sampler, request.samples_per_pixel}};
  options.kernels = command.engine == Engine::kMegakernel ? Width::kOneLane : Width::kWide;
  options.wave = command.wave;
  options.window = command.window;
  // Depth first: one path at a time, from the camera to its end.
  if (command.engine == Engine::kMegakernel && options.window == 0) options.window = 1;
  options.regenerate = command.regenerate;
  options.traversal = ToTraversal(command.traversal);
  options.dump = {command.dump.stage, command.dump.bounce, command.dump.file, command.scenes[0]};
  return options;
}

RunSettings ToSettings(const RenderCommand& command, const std::vector<std::string>& outfiles,
                       const RenderOptions& options, const RenderResult& result,
                       const std::string& light_sampler) {
  RunSettings s;
  s.scene_files = command.scenes;
  s.outfiles = outfiles;
  s.width = options.width;
  s.height = options.height;
  s.crop_pixels = {options.crop.x0, options.crop.x1, options.crop.y0, options.crop.y1};
  s.samples_per_pixel = options.samples_per_pixel;
  s.seed = options.path.seed;
  s.max_depth = options.path.max_depth;
  s.roulette_start = options.path.roulette_start;
  s.thread_count = result.thread_count;
  s.engine = EngineName(command.engine);
  s.wave = result.wave;
  s.window = result.window;
  s.wave_bytes = result.wave_bytes;
  s.traversal = TraversalName(command.traversal);
  s.isa = command.isa;
  s.diffuse_sampling = DiffuseSamplingName(command.diffuse_sampling);
  s.sampler = SamplerName(options.path.sampler.kind);
  s.light_sampler = light_sampler;
  s.regeneration = options.regenerate;
  return s;
}

// Only what decides the picture, so that equal pictures are equal files.
ImageMetadata ToMetadata(const RenderCommand& command, const RenderOptions& options,
                         const std::string& light_sampler) {
  std::string scenes;
  for (const std::string& scene : command.scenes) scenes += (scenes.empty() ? "" : " ") + scene;
  ImageMetadata metadata;
  metadata.strings = {
      {"swell:version", SwellVersion()},
      {"swell:scene", scenes},
      {"swell:spp", std::to_string(options.samples_per_pixel)},
      {"swell:seed", std::to_string(options.path.seed)},
      {"swell:sampler", SamplerName(options.path.sampler.kind)},
      {"swell:maxdepth", std::to_string(options.path.max_depth)},
      {"swell:diffuse-sampling", DiffuseSamplingName(command.diffuse_sampling)},
      {"swell:lightsampler", light_sampler},
  };
  if (!command.camera.empty()) metadata.strings.emplace_back("swell:camera", command.camera);
  metadata.frame_width = options.width;
  metadata.frame_height = options.height;
  metadata.crop = options.crop;
  return metadata;
}

Status WriteText(const std::string& path, const std::string& text) {
  Result<NewFile> file = NewFile::Open(path);
  if (!file) return file.error();
  file->Write(text.data(), text.size());
  return file->Commit();
}

// One render from files to files. Every step is a method that fails with one line.
class RenderRun {
 public:
  explicit RenderRun(const RenderCommand& command)
      : command_(command),
        progress_(command.quiet ? ProgressStyle::kNone : StandardErrorStyle(),
                  StandardErrorColumns(), Now, WriteStandardError) {}

  Status Run() {
    if (Status s = SelectIsa(command_.isa); !s) return s;
    if (Status s = CheckOutputs(command_.outfiles); !s) return s;
    const Result<Scene> scene = Import();
    if (!scene) return scene.error();
    const RenderRequest request = Override(scene->request, command_);
    if (request.samples_per_pixel > kMaxSamplesPerPixel) {
      return Error{"the scene file asks for " + std::to_string(request.samples_per_pixel) +
                   " samples per pixel; at most " + std::to_string(kMaxSamplesPerPixel) +
                   " are possible, see --spp"};
    }
    const Result<PixelBounds> crop = CropPixels(request.width, request.height, request.crop_window);
    if (!crop) return crop.error();
    outfiles_ = command_.outfiles;
    if (outfiles_.empty()) {
      outfiles_.push_back(DefaultOutfile(request.filename, command_.scenes[0]));
      if (Status s = CheckOutputs(outfiles_); !s) return s;
    }
    options_ = ToRenderOptions(command_, request, *crop);

    progress_.Begin("build", "");
    const SceneTables tables = FinishScene(*scene, request.light_sampler);
    light_sampler_ = kLightSamplerNames[static_cast<size_t>(tables.light_sampler)];
    const Result<Bvh> bvh = Build(*scene);
    if (!bvh) return bvh.error();
    report_.seconds.build = progress_.End();

    progress_.Begin("render");
    const Result<RenderResult> result =
        Render(*scene, tables, *bvh, options_,
               [this](const Progress& p) { progress_.Update(p.samples_done, p.samples_total); });
    if (!result) return result.error();
    progress_.End();
    report_.seconds.render = result->seconds;
    WarnOf(*result);
    return Finish(*scene, request, *result);
  }

  void Clear() { progress_.Clear(); }

 private:
  Status CheckOutputs(const std::vector<std::string>& outfiles) const {
    const HoldSignals hold;  // the check makes a file and removes it
    for (const std::string& outfile : outfiles) {
      if (Status s = CheckOutput(outfile); !s) return s;
    }
    if (command_.stats_file.empty()) return Done{};
    if (const Result<NewFile> file = NewFile::Open(command_.stats_file); !file) {
      return file.error();
    }
    return Done{};
  }

  Result<Scene> Import() {
    progress_.Begin("import", "B");
    Result<Scene> scene = ReadScene();
    if (!scene) return scene;
    report_.seconds.import_files = progress_.End();
    for (const std::string& warning : scene->warnings) Warn(warning);
    return scene;
  }

  // The bytes of files that were found so far: what they name may add to them.
  Result<Scene> ReadScene() {
    const Ticker ticker([&] { progress_.Update(TheInputBytes().done, TheInputBytes().opened); });
    return ImportScene(command_.scenes, {command_.camera});
  }

  Result<Bvh> Build(const Scene& scene) {
    BuildProgress built;
    const uint64_t total =
        kBuildSteps * (scene.triangle_count() + scene.spheres.size() + scene.instances.size());
    const Ticker ticker([&] { progress_.Update(built.done, total); });
    return BuildBvh(scene, {.progress = &built});
  }

  void Warn(const std::string& message) {
    if (!command_.quiet) PrintWarning(message);
  }

  void WarnOf(const RenderResult& result) {
    if (command_.window > result.window) {
      Warn("--window: " + std::to_string(command_.window) + " is larger than the wave of " +
           std::to_string(result.wave) + " rows; the window is " + std::to_string(result.window));
    }
    if (result.stats.non_finite_samples > 0) {
      Warn(FormatCount(result.stats.non_finite_samples) +
           " samples were not finite or too large and were dropped");
    }
  }

  // Images, then statistics; a signal waits until all are there.
  Status Finish(const Scene& scene, const RenderRequest& request, const RenderResult& result) {
    const HoldSignals hold;
    progress_.Begin("output");
    const Image image = result.film.Resolve(options_.samples_per_pixel, request.image_scale);
    for (const std::string& outfile : outfiles_) {
      if (Status s = WriteImage(outfile, image, ToMetadata(command_, options_, light_sampler_)); !s)
        return s;
    }
    report_.seconds.output = progress_.End();

    report_.scene = command_.scenes[0];
    report_.settings = ToSettings(command_, outfiles_, options_, result, light_sampler_);
    report_.machine = DescribeMachine(options_.kernels);
    report_.peak_rss_bytes = PeakResidentBytes();
    report_.material_labels = MaterialLabels(scene.materials, {kMaterialKinds, kMaterialKindCount});
    report_.stats = &result.stats;
    report_.stages_timed = result.stages_timed;
    if (!command_.stats_file.empty()) {
      if (Status s = WriteText(command_.stats_file, StatsJson(report_)); !s) return s;
    }
    if (!command_.quiet) WriteStandardError("\n" + SummaryTable(report_));
    return command_.stats_table ? WriteStandardOutput(StageTable(report_)) : Done{};
  }

  const RenderCommand& command_;
  ProgressLine progress_;
  std::vector<std::string> outfiles_;
  RenderOptions options_;
  std::string light_sampler_;  // in effect
  RunReport report_;
};

}  // namespace

int RunRender(const RenderCommand& command) {
  RenderRun run(command);
  const Status status = run.Run();
  run.Clear();
  return ExitCode(status);
}

}  // namespace swell
