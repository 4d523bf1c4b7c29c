// The options of every command: their names, help, checks and defaults.
#include "src/cli/options.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "src/base/suggest.h"
#include "src/cli/option_set.h"
#include "src/cli/parse_values.h"
#include "src/cli/read_values.h"
#include "src/stats/machine.h"

namespace swell {
namespace {

const std::vector<std::string> kEngines{"wavefront", "megakernel"};
const std::vector<std::string> kTraversals{"auto", "packet", "single"};
const std::vector<std::string> kDiffuseSamplings{
    "disk", "normal-plus-sphere", "normal-plus-rejected-sphere", "normal-plus-gaussian"};
const std::vector<std::string> kTopics{"materials", "lights",  "textures", "shapes",
                                       "samplers",  "filters", "isas"};
const std::vector<std::string> kLightSamplers(std::begin(kLightSamplerNames),
                                              std::end(kLightSamplerNames));
const std::vector<std::string> kCommands{"render", "info", "list"};

constexpr const char* kSceneFiles = "scene files (.pbrt), or a model (.gltf, .glb, .obj, .ply)";

constexpr uint32_t kMaxThreads = 4096;
constexpr uint32_t kMaxWave = 1u << 20;

constexpr const char* kMainHelp =
    R"(swell: a path tracer built as a pipeline over columns.

Usage: swell COMMAND ...

Commands:
  render SCENE...    renders a scene file into images
  info SCENE...      says what was read: counts, bounds, materials, memory, warnings
  list TOPIC         materials, lights, textures, shapes, samplers, filters or isas

Options:
  -h,--help          this text; 'swell COMMAND --help' says more
  --version          version, revision, compiler and instruction sets

Example:
  swell render scene.pbrt --outfile scene.exr --outfile scene.png --spp 64

Exit codes: 0 done, 1 failed, 2 wrong usage.
)";

std::vector<std::string> SamplerNames() {
  std::vector<std::string> names;
  for (const SamplerInfo& sampler : kSamplers) names.push_back(sampler.name);
  return names;
}

void AddCameraOption(OptionSet& set, std::string& camera, const char* group) {
  set.Value("--camera", "NAME|INDEX", group,
            "of the scene file's cameras, by name or from 0 (default:\nthe first; glTF files only)",
            [&camera](const std::string& text) -> Status {
              if (text.empty()) return Error{"the camera's name is empty"};
              camera = text;
              return Done{};
            });
}

void AddPictureOptions(OptionSet& set, RenderCommand& c) {
  const char* group = "Picture (default: what the scene file says)";
  set.Value(
      "--outfile", "F.exr|F.png", group,
      "image to write; may be repeated. Default: the scene file's\n"
      "film filename, else the scene's name with .exr, here",
      [&c](const std::string& text) { return ReadOutfile(text, c); }, /*repeatable=*/true);
  set.Value("--spp", "N", group, "samples per pixel, 1 to 4194304",
            CountInto(c.samples_per_pixel, 1, kMaxSamplesPerPixel));
  set.Value("--seed", "N", group, "of the random numbers, 0 to 4294967295",
            CountInto(c.seed, 0, UINT32_MAX));
  set.Value("--maxdepth", "N", group,
            "surface scatterings of a path, 0 to 65534;\n0: emitted light only",
            CountInto(c.max_depth, 0, kMaxDepth));
  set.Value("--sampler", "NAME", group,
            "sobol, zsobol, halton, stratified or independent;\n'swell list samplers' says more",
            NameInto(c.sampler, "sampler", SamplerNames()));
  AddCameraOption(set, c.camera, group);
  set.Value("--resolution", "WxH", group, "of the full frame in pixels, each 1 to 65535",
            Into(c.resolution, ParseResolution));
  set.Value("--cropwindow", "x0,x1,y0,y1", group,
            "part of the frame to render, as fractions from 0 to 1",
            Into(c.crop_window, ParseCropWindow));
}

void AddLightOptions(OptionSet& set, RenderCommand& c) {
  set.Value("--lightsampler", "NAME", "Noise (the picture stays the same within noise)",
            "how a shaded point picks a light: uniform; power; bvh: a tree\n"
            "of lights, by what they may send there; auto: power for one\n"
            "lamp, else bvh (default: what the scene file says, else auto)",
            NameInto(c.light_sampler, "light sampler", kLightSamplers));
}

void AddRunOptions(OptionSet& set, RenderCommand& c) {
  const char* group = "Run";
  set.Value("--nthreads", "N", group, "worker threads; 0: all (default: 0)",
            CountInto(c.thread_count, 0, kMaxThreads));
  set.Flag("--quiet", c.quiet, group, "no progress, no warnings, no closing table; errors only");
  set.Value(
      "--stats", "table|F.json", group,
      "table: figures by stage, bounce and material on standard\n"
      "output; F.json: the same for scripts. May be repeated",
      [&c](const std::string& text) { return ReadStats(text, c); }, /*repeatable=*/true);
}

void AddPipelineOptions(OptionSet& set, RenderCommand& c, const std::vector<std::string>& isas) {
  const char* group = "Pipeline (the picture stays the same to the bit)";
  set.Value("--engine", "NAME", group,
            "wavefront: full vectors; megakernel: the same kernels\n"
            "one path at a time (default: wavefront)",
            NameInto(c.engine, "engine", kEngines));
  set.Value("--wave", "N", group,
            "rows of a worker's queues, 1 to 1048576\n(default: what fits a core's L2 cache)",
            CountInto(c.wave, 1, kMaxWave));
  set.Value("--window", "N", group,
            "neighbouring rows within which rows regroup,\n1 to the wave (default: the wave; "
            "megakernel: 1)",
            CountInto(c.window, 1, kMaxWave));
  set.Value("--regeneration", "on|off", group,
            "refill the rows of ended paths at once (default: on)",
            [&c](const std::string& text) -> Status {
              if (text != "on" && text != "off") return Error{"'" + text + "' is not on or off"};
              c.regenerate = text == "on";
              return Done{};
            });
  set.Value("--traversal", "NAME", group,
            "packet: a vector of rays against one node; single: one\n"
            "ray against all children; auto: chosen by bounce (default: auto)",
            NameInto(c.traversal, "traversal", kTraversals));
  set.Value("--isa", "NAME", group,
            "auto, avx3, avx2, sse4 or scalar (default: auto, the best\n"
            "of this CPU; sse4 and scalar round differently)",
            [&c, isas](const std::string& text) { return ReadIsa(text, isas, c.isa); });
  set.Value("--dump-wave", "STAGE:BOUNCE:FILE", group,
            "write the rows that enter a stage at a bounce, once,\nfor benchmarks",
            [&c](const std::string& text) { return ReadDump(text, c.dump); });
  set.Value("--diffuse-sampling", "NAME", "Study (the picture stays the same within noise)",
            "disk, normal-plus-sphere, normal-plus-rejected-sphere\n"
            "or normal-plus-gaussian (default: disk)",
            NameInto(c.diffuse_sampling, "diffuse sampling", kDiffuseSamplings));
}

// ParseCommandLine of one command: `finish` checks what options together must keep.
Result<Command> ParseWith(OptionSet& set, const std::vector<std::string>& arguments,
                          const std::function<Result<Command>()>& finish) {
  const Result<bool> help = set.Parse(arguments);
  if (!help) return help.error();
  if (*help) return Command{ShowText{set.HelpText()}};
  return finish();
}

Error NoScene(const char* command) {
  return Error{std::string("no scene file given; see 'swell ") + command + " --help'"};
}

Result<Command> ParseRender(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& isas) {
  RenderCommand command;
  OptionSet set("Renders a scene file into images. Several files are read as one scene, in order.",
                "render", "SCENE...", kSceneFiles);
  AddPictureOptions(set, command);
  AddLightOptions(set, command);
  AddRunOptions(set, command);
  AddPipelineOptions(set, command, isas);
  set.Footer(
      "Example:\n"
      "  swell render scene.pbrt --outfile scene.exr --outfile scene.png --spp 64 --nthreads 2\n\n"
      "Progress and the closing table go to standard error.\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage.");
  return ParseWith(set, arguments, [&]() -> Result<Command> {
    command.scenes = set.positionals();
    if (command.scenes.empty()) return NoScene("render");
    if (command.wave != 0 && command.window > command.wave) {
      return Error{"--window: " + std::to_string(command.window) + " is larger than the wave of " +
                   std::to_string(command.wave) + " rows"};
    }
    return Command{command};
  });
}

Result<Command> ParseInfo(const std::vector<std::string>& arguments) {
  InfoCommand command;
  OptionSet set("Says what was read: counts, bounds, materials, memory, camera, film, warnings.",
                "info", "SCENE...", kSceneFiles);
  set.Flag("--json", command.json, "Output", "one line of JSON with stable names, for scripts");
  AddCameraOption(set, command.camera, "Scene");
  set.Footer("Example:\n  swell info scene.pbrt");
  return ParseWith(set, arguments, [&]() -> Result<Command> {
    command.scenes = set.positionals();
    if (command.scenes.empty()) return NoScene("info");
    return Command{command};
  });
}

Result<Command> ParseList(const std::vector<std::string>& arguments) {
  OptionSet set("Lists what this build supports, with parameters and defaults.", "list", "TOPIC",
                "materials, lights, textures, shapes, samplers, filters or isas");
  set.Footer("Example:\n  swell list materials");
  return ParseWith(set, arguments, [&]() -> Result<Command> {
    const std::vector<std::string>& topics = set.positionals();
    if (topics.size() != 1) return Error{"list needs one of " + OneOf(kTopics)};
    const Result<uint32_t> topic = ParseName("topic", topics[0], kTopics);
    if (!topic) return topic.error();
    return Command{ListCommand{static_cast<ListTopic>(*topic)}};
  });
}

std::string VersionText(const std::vector<std::string>& isas) {
  std::string text = std::string("swell ") + SwellVersion() + "\n";
  text += "revision " + SourceRevision().value_or("unknown") + "\n";
  text += "compiler " + CompilerName() + "\n";
  text += "instruction sets usable here: " + OneOf(isas) + "\n";
  return text;
}

}  // namespace

Result<Command> ParseCommandLine(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& usable_isas) {
  if (arguments.empty()) return Error{"no command given; see 'swell --help'"};
  const std::string& first = arguments[0];
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (first == "render") return ParseRender(rest, usable_isas);
  if (first == "info") return ParseInfo(rest);
  if (first == "list") return ParseList(rest);
  if (first == "--help" || first == "-h") return Command{ShowText{kMainHelp}};
  if (first == "--version") return Command{ShowText{VersionText(usable_isas)}};
  if (first[0] == '-' && first.size() > 1) {
    std::string close = DidYouMean(first, {"--help", "--version"});
    if (close.empty()) close = "; options come after the command, see 'swell --help'";
    return Error{"unknown option '" + first + "'" + close};
  }
  std::string close = DidYouMean(first, {kCommands.begin(), kCommands.end()});
  if (close.empty()) close = "; the commands are " + OneOf(kCommands);
  return Error{"unknown command '" + first + "'" + close};
}

const char* EngineName(Engine engine) { return kEngines[static_cast<size_t>(engine)].c_str(); }
const char* TraversalName(TraversalChoice traversal) {
  return kTraversals[static_cast<size_t>(traversal)].c_str();
}
const char* DiffuseSamplingName(DiffuseSampling sampling) {
  return kDiffuseSamplings[static_cast<size_t>(sampling)].c_str();
}
const char* SamplerName(SamplerKind sampler) {
  return kSamplers[static_cast<size_t>(sampler)].name;
}

}  // namespace swell
