// A scene in, seconds and pictures of all engines out.
#include "bench/peer/measure.h"

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "bench/peer/embree_tracer.h"
#include "src/schedule/render.h"

namespace swell::bench {
namespace {

constexpr uint32_t kRouletteStart = 3;  // as swell render has it

struct Rendered {
  Image image;
  double seconds = 0;
  std::optional<StageStats> stats;
};

struct Engine {
  std::string name;
  std::function<Result<Rendered>(uint32_t seed)> render;
};

Engine PeerEngine(const EmbreeTracer& tracer, const RenderRequest& request,
                  const MeasureOptions& options) {
  PeerOptions peer;
  peer.width = request.width;
  peer.height = request.height;
  peer.samples_per_pixel = options.samples_per_pixel;
  peer.thread_count = options.thread_count;
  peer.max_depth = options.max_depth.value_or(request.max_depth);
  peer.roulette_start = kRouletteStart;
  return {"Embree 3 path tracer", [&tracer, peer](uint32_t seed) mutable -> Result<Rendered> {
            peer.seed = seed;
            PeerImage rendered = tracer.Render(peer);
            return Rendered{std::move(rendered.image), rendered.seconds, std::nullopt};
          }};
}

Engine SwellEngine(const std::string& name, const BuiltScene& scene, const SceneTables& tables,
                   RenderOptions options) {
  return {name, [&scene, &tables, options](uint32_t seed) mutable -> Result<Rendered> {
            options.path.seed = seed;
            const Result<RenderResult> result = Render(scene.scene, tables, scene.bvh, options, {});
            if (!result) return result.error();
            return Rendered{
                result->film.Resolve(options.samples_per_pixel, scene.scene.request.image_scale),
                result->seconds, result->stats};
          }};
}

RenderOptions SwellOptions(const RenderRequest& request, const MeasureOptions& options) {
  RenderOptions swell;
  swell.width = request.width;
  swell.height = request.height;
  swell.crop = {0, 0, request.width, request.height};
  swell.samples_per_pixel = options.samples_per_pixel;
  swell.thread_count = options.thread_count;
  swell.path = {0, options.max_depth.value_or(request.max_depth), kRouletteStart,
                DiffuseSampling::kDisk};
  swell.wave = options.wave;
  return swell;
}

std::vector<Engine> MakeEngines(const EmbreeTracer& tracer, const BuiltScene& scene,
                                const MeasureOptions& options) {
  const RenderRequest& request = scene.scene.request;
  const RenderOptions swell = SwellOptions(request, options);
  std::vector<Engine> engines = {PeerEngine(tracer, request, options),
                                 SwellEngine("swell", scene, scene.tables, swell)};
  if (options.window_8) {
    RenderOptions window = swell;
    window.window = 8;
    engines.push_back(SwellEngine("swell --window 8", scene, scene.tables, window));
  }
  if (options.megakernel) {
    RenderOptions megakernel = swell;
    megakernel.kernels = Width::kOneLane;
    megakernel.wave = 1;
    megakernel.window = 1;
    engines.push_back(SwellEngine("swell --engine megakernel", scene, scene.tables, megakernel));
  }
  return engines;
}

// By swell, with seeds that no repetition has and the light sampler of its choice.
Result<std::optional<TruePicture>> RenderTruth(const BuiltScene& scene,
                                               const MeasureOptions& options) {
  if (options.true_samples == 0) return std::optional<TruePicture>();
  RenderOptions swell = SwellOptions(scene.scene.request, options);
  swell.samples_per_pixel = (options.true_samples + 1) / 2;
  const SceneTables tables = FinishScene(scene.scene, LightSampler::kAuto);
  const Engine engine = SwellEngine("", scene, tables, swell);
  constexpr uint32_t kFirstSeed = 1u << 30;
  Result<Rendered> a = engine.render(kFirstSeed);
  if (!a) return a.error();
  Result<Rendered> b = engine.render(kFirstSeed + 1);
  if (!b) return b.error();
  return std::optional<TruePicture>(TruePicture(a->image, b->image));
}

double MeanOf(const Image& image) {
  double sum = 0;
  for (float v : image.rgb) sum += v;
  return sum / static_cast<double>(image.rgb.size());
}

// Mean and standard error of the repetitions' differences.
void Summarise(const std::vector<double>& differences, Agreement& agreement) {
  const auto n = static_cast<double>(differences.size());
  double sum = 0, squares = 0;
  for (double d : differences) sum += d;
  for (double d : differences) squares += (d - sum / n) * (d - sum / n);
  agreement.difference = sum / n;
  agreement.noise = n > 1 ? std::sqrt(squares / (n - 1) / n) : 0;
}

}  // namespace

Result<SceneFigures> Measure(const std::string& name, const BuiltScene& scene,
                             const MeasureOptions& options) {
  const Result<std::unique_ptr<EmbreeTracer>> tracer =
      EmbreeTracer::Make(scene.scene, scene.tables);
  if (!tracer) return Error{name + ": " + tracer.error().message};
  std::vector<Engine> engines = MakeEngines(**tracer, scene, options);
  const size_t same_pictures = engines.size();
  std::vector<SceneTables> others;
  others.reserve(options.other_samplers.size());
  for (LightSampler sampler : options.other_samplers) {
    others.push_back(FinishScene(scene.scene, sampler));
    const std::string name = kLightSamplerNames[static_cast<size_t>(sampler)];
    engines.push_back(SwellEngine("swell --lightsampler " + name, scene, others.back(),
                                  SwellOptions(scene.scene.request, options)));
  }
  const RenderRequest& request = scene.scene.request;
  SceneFigures figures;
  figures.scene = name;
  figures.thread_count = options.thread_count;
  figures.samples_per_pixel = options.samples_per_pixel;
  figures.samples = uint64_t{request.width} * request.height * options.samples_per_pixel;
  for (const Engine& engine : engines) {
    EngineFigures& added = figures.engines.emplace_back();
    added.name = engine.name;
    added.stats = StageStats(scene.tables.view.materials.count);
  }

  const Result<std::optional<TruePicture>> truth = RenderTruth(scene, options);
  if (!truth) return truth.error();
  std::vector<double> differences;
  for (uint32_t repetition = 0; repetition < options.repetitions; ++repetition) {
    for (size_t turn = 0; turn < engines.size(); ++turn) {
      const size_t e = (turn + repetition) % engines.size();
      Result<Rendered> rendered = engines[e].render(repetition);
      if (!rendered) return rendered.error();
      EngineFigures& engine = figures.engines[e];
      engine.seconds.push_back(rendered->seconds);
      engine.image = std::move(rendered->image);
      if (*truth) engine.errors.push_back((*truth)->ErrorOf(engine.image));
      if (rendered->stats) engine.stats.Merge(*rendered->stats);
    }
    const double peer = MeanOf(figures.engines[0].image);
    differences.push_back((MeanOf(figures.engines[1].image) - peer) / peer);
    for (size_t e = 2; e < same_pictures; ++e) {
      EngineFigures& engine = figures.engines[e];
      engine.same_picture =
          engine.same_picture.value_or(true) && engine.image.rgb == figures.engines[1].image.rgb;
    }
  }
  Summarise(differences, figures.agreement);
  return figures;
}

}  // namespace swell::bench
