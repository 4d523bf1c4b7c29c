// Command lines: good ones and what they ask for, bad ones and what is said of them.
#include "src/cli/options.h"

#include <doctest/doctest.h>

#include <sstream>

namespace swell {
namespace {

const std::vector<std::string> kUsable{"avx2", "sse4", "scalar"};

Result<Command> Parse(const std::string& line) {
  std::istringstream words(line);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  return ParseCommandLine(arguments, kUsable);
}

RenderCommand ParseRender(const std::string& line) {
  const Result<Command> command = Parse(line);
  INFO(line, ": ", command ? "" : command.error().message);
  REQUIRE(static_cast<bool>(command));
  REQUIRE(std::holds_alternative<RenderCommand>(*command));
  return std::get<RenderCommand>(*command);
}

TEST_CASE("options: a scene alone leaves all to the file and the defaults") {
  const RenderCommand c = ParseRender("render a.pbrt");
  CHECK(c.scenes == std::vector<std::string>{"a.pbrt"});
  CHECK(c.outfiles.empty());
  CHECK(!c.samples_per_pixel);
  CHECK(!c.seed);
  CHECK(!c.max_depth);
  CHECK(!c.resolution);
  CHECK(!c.crop_window);
  CHECK(c.thread_count == 0);
  CHECK(!c.quiet);
  CHECK(c.engine == Engine::kWavefront);
  CHECK(c.wave == 0);
  CHECK(c.window == 0);
  CHECK(c.traversal == TraversalChoice::kAuto);
  CHECK(c.isa == "auto");
  CHECK(c.diffuse_sampling == DiffuseSampling::kDisk);
  CHECK(!c.sampler);
  CHECK(!c.light_sampler);
  CHECK(c.regenerate);
  CHECK(!c.stats_table);
  CHECK(c.stats_file.empty());
  CHECK(c.dump.file.empty());
}

TEST_CASE("options: every option arrives") {
  const RenderCommand c = ParseRender(
      "render a.pbrt b.pbrt --outfile o.exr --outfile o.png --spp 4194304 --seed 4294967295 "
      "--maxdepth 0 --resolution 640x480 --cropwindow 0,0.5,0.5,1 --nthreads 2 --quiet "
      "--engine megakernel --wave 1048576 --window 8 --traversal single --isa sse4 --stats table "
      "--stats s.json --diffuse-sampling normal-plus-rejected-sphere --regeneration off --sampler "
      "zsobol --lightsampler bvh "
      "--dump-wave shade_miss:3:dir/w:1.bin");
  CHECK(c.scenes == std::vector<std::string>{"a.pbrt", "b.pbrt"});
  CHECK(c.outfiles == std::vector<std::string>{"o.exr", "o.png"});
  CHECK(c.samples_per_pixel == 4194304u);
  CHECK(c.seed == 4294967295u);
  CHECK(c.max_depth == 0u);
  CHECK(*c.resolution == std::array<uint32_t, 2>{640, 480});
  CHECK(*c.crop_window == std::array<float, 4>{0, 0.5f, 0.5f, 1});
  CHECK(c.thread_count == 2);
  CHECK(c.quiet);
  CHECK(c.engine == Engine::kMegakernel);
  CHECK(c.wave == 1048576);
  CHECK(c.window == 8);
  CHECK(c.traversal == TraversalChoice::kSingle);
  CHECK(c.isa == "sse4");
  CHECK(c.stats_table);
  CHECK(c.stats_file == "s.json");
  CHECK(c.diffuse_sampling == DiffuseSampling::kNormalPlusRejectedSphere);
  CHECK(c.sampler == SamplerKind::kZSobol);
  CHECK(c.light_sampler == LightSampler::kBvh);
  CHECK(!c.regenerate);
  CHECK(c.dump.stage == Stage::kShadeMiss);
  CHECK(c.dump.bounce == 3);
  CHECK(c.dump.file == "dir/w:1.bin");
}

TEST_CASE("options: other good command lines") {
  CHECK(ParseRender("render --spp 4 a.pbrt").scenes.size() == 1);
  CHECK(ParseRender("render --spp=4 a.pbrt").samples_per_pixel == 4u);
  CHECK(ParseRender("render --outfile o.exr a.pbrt b.pbrt").scenes.size() == 2);
  CHECK(ParseRender("render list info").scenes == std::vector<std::string>{"list", "info"});
  CHECK(ParseRender("render -- -a.pbrt").scenes == std::vector<std::string>{"-a.pbrt"});
  CHECK(ParseRender("render a.pbrt --wave 64 --window 64").window == 64);
  CHECK(std::get<InfoCommand>(*Parse("info a.pbrt b.ply")).scenes.size() == 2);
  CHECK(std::get<ListCommand>(*Parse("list isas")).topic == ListTopic::kIsas);
  CHECK(std::get<ListCommand>(*Parse("list materials")).topic == ListTopic::kMaterials);
}

TEST_CASE("options: bad command lines end in one line that says what is wrong") {
  const struct {
    const char* line;
    const char* message;  // a part of it
  } kCases[] = {
      {"", "no command given"},
      {"rendr a.pbrt", "unknown command 'rendr'; did you mean 'render'?"},
      {"study plan.toml", "unknown command 'study'; the commands are render, info or list"},
      {"merge a.exr", "unknown command 'merge'"},
      {"--versoin", "did you mean '--version'?"},
      {"--spp 4 render a.pbrt", "options come after the command"},
      {"render", "no scene file given"},
      {"info", "no scene file given"},
      {"list", "list needs one of materials, lights, textures, shapes, samplers, filters or isas"},
      {"list materials lights", "list needs one of"},
      {"list material", "did you mean 'materials'?"},
      {"render a.pbrt --ssp 4", "unknown option '--ssp'; did you mean '--spp'?"},
      {"render a.pbrt --outfiel=o.exr", "unknown option '--outfiel'; did you mean '--outfile'?"},
      {"render a.pbrt --sort-rays octant", "unknown option '--sort-rays'"},
      {"render a.pbrt --perf", "unknown option '--perf'"},
      {"render a.pbrt --checkpoint f", "unknown option '--checkpoint'"},
      {"render a.pbrt --resume f", "unknown option '--resume'"},
      {"render a.pbrt --aov normal", "unknown option '--aov'"},
      {"render a.pbrt -q", "unknown option '-q'"},
      {"info a.pbrt --spp 4", "unknown option '--spp'"},
      {"render a.pbrt --spp", "option '--spp' needs a value"},
      {"render a.pbrt --spp 4 --spp 8", "option '--spp' is given twice"},
      {"render a.pbrt --spp 0", "--spp: '0' is not a whole number from 1 to 4194304"},
      {"render a.pbrt --spp 4194305", "--spp: '4194305' is not"},
      {"render a.pbrt --spp 4.5", "--spp: '4.5' is not"},
      {"render a.pbrt --spp --quiet", "--spp"},
      {"render a.pbrt --seed -1", "--seed: '-1' is not"},
      {"render a.pbrt --seed 4294967296", "--seed:"},
      {"render a.pbrt --maxdepth 65535", "--maxdepth:"},
      {"render a.pbrt --resolution 0x480", "--resolution: '0x480' is not WIDTHxHEIGHT"},
      {"render a.pbrt --resolution 65536x480", "--resolution:"},
      {"render a.pbrt --cropwindow 0,2,0,1", "--cropwindow: '0,2,0,1' leaves the frame"},
      {"render a.pbrt --cropwindow 0.5,0.5,0,1", "--cropwindow: '0.5,0.5,0,1' is empty"},
      {"render a.pbrt --nthreads x", "--nthreads:"},
      {"render a.pbrt --engine wave", "unknown engine 'wave'; use wavefront or megakernel"},
      {"render a.pbrt --wave 0", "--wave: '0' is not a whole number from 1 to 1048576"},
      {"render a.pbrt --wave 1048577", "--wave:"},
      {"render a.pbrt --window 0", "--window:"},
      {"render a.pbrt --wave 64 --window 65", "65 is larger than the wave of 64 rows"},
      {"render a.pbrt --traversal stream",
       "unknown traversal 'stream'; use auto, packet or single"},
      {"render a.pbrt --isa avx3", "--isa: 'avx3' does not work on this machine; use auto, avx2"},
      {"render a.pbrt --isa avx", "--isa: unknown instruction set 'avx'; use auto, avx2, sse4 or"},
      {"render a.pbrt --stats yaml", "--stats: 'yaml' is neither 'table' nor a file"},
      {"render a.pbrt --outfile o.jpg", "--outfile: 'o.jpg' does not end in .exr or .png"},
      {"render a.pbrt --outfile .exr", "--outfile:"},
      {"render a.pbrt --outfile o.exr --outfile o.exr", "'o.exr' is given twice"},
      {"render a.pbrt --diffuse-sampling disc", "did you mean 'disk'?"},
      {"render a.pbrt --sampler halten", "did you mean 'halton'?"},
      {"render a.pbrt --lightsampler powr", "did you mean 'power'?"},
      {"render a.pbrt --regeneration yes", "--regeneration: 'yes' is not on or off"},
      {"render a.pbrt --dump-wave intersect", "is not STAGE:BOUNCE:FILE"},
      {"render a.pbrt --dump-wave intersect:2:", "is not STAGE:BOUNCE:FILE"},
      {"render a.pbrt --dump-wave intersct:2:f", "did you mean 'intersect'?"},
      {"render a.pbrt --dump-wave intersect:x:f", "bounce 'x' is not a whole number"},
      {"render a.pbrt --quiet=maybe", "--quiet"},
  };
  for (const auto& [line, message] : kCases) {
    INFO(line);
    const Result<Command> command = Parse(line);
    REQUIRE(!command);
    INFO(command.error().message);
    CHECK(command.error().message.find(message) != std::string::npos);
    CHECK(command.error().message.find('\n') == std::string::npos);
  }
}

TEST_CASE("options: help names every option with its default and an example") {
  const Result<Command> command = Parse("render --help");
  REQUIRE(static_cast<bool>(command));
  const std::string help = std::get<ShowText>(*command).text;
  for (const char* name : {"--outfile",
                           "--spp",
                           "--seed",
                           "--maxdepth",
                           "--resolution",
                           "--cropwindow",
                           "--nthreads",
                           "--quiet",
                           "--engine",
                           "--wave",
                           "--window",
                           "--traversal",
                           "--isa",
                           "--stats",
                           "--diffuse-sampling",
                           "--sampler",
                           "--lightsampler",
                           "--regeneration",
                           "--dump-wave",
                           "(default: wavefront)",
                           "(default: disk)",
                           "Example:",
                           "swell render scene.pbrt",
                           "SCENE"}) {
    INFO(name);
    CHECK(help.find(name) != std::string::npos);
  }
  for (const char* later : {"--sort-rays", "--perf", "--checkpoint", "--spectral"}) {
    INFO(later);
    CHECK(help.find(later) == std::string::npos);
  }
}

TEST_CASE("options: help and version are answers, not errors") {
  for (const char* line : {"--help", "-h", "render -h", "info --help", "list --help", "--version",
                           "render a.pbrt --spp 4 --help"}) {
    INFO(line);
    const Result<Command> command = Parse(line);
    REQUIRE(static_cast<bool>(command));
    CHECK(std::holds_alternative<ShowText>(*command));
  }
  CHECK(std::get<ShowText>(*Parse("--version")).text.rfind("swell 0.", 0) == 0);
}

}  // namespace
}  // namespace swell
