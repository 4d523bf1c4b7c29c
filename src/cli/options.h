// The command line in, a checked request out; or help; or one line that says what is wrong.
#ifndef SWELL_CLI_OPTIONS_H_
#define SWELL_CLI_OPTIONS_H_

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kernels/scene_view.h"
#include "src/base/result.h"
#include "src/scene/scene.h"
#include "src/stats/stats.h"

namespace swell {

inline constexpr uint32_t kMaxSamplesPerPixel = 1u
                                                << 22;  // what the film's exact sums have room for
inline constexpr uint32_t kMaxDepth = 65534;            // a bounce is 16 bits of a ray's state

enum class Engine { kWavefront, kMegakernel };
enum class TraversalChoice { kAuto, kPacket, kSingle };

struct DumpRequest {
  Stage stage = Stage::kIntersect;
  uint32_t bounce = 0;
  std::string file;  // "": none
};

// Empty optionals: the scene file decides.
struct RenderCommand {
  std::vector<std::string> scenes;
  std::vector<std::string> outfiles;
  std::optional<uint32_t> samples_per_pixel;
  std::optional<uint32_t> seed;
  std::optional<uint32_t> max_depth;
  std::optional<SamplerKind> sampler;
  std::string camera;                                 // name or index; "": the scene file's
  std::optional<std::array<uint32_t, 2>> resolution;  // width, height
  std::optional<std::array<float, 4>> crop_window;    // x0 x1 y0 y1, fractions of the frame
  std::optional<LightSampler> light_sampler;
  uint32_t thread_count = 0;  // 0: all
  bool quiet = false;
  Engine engine = Engine::kWavefront;
  uint32_t wave = 0;    // rows; 0: to fit the L2 cache
  uint32_t window = 0;  // rows; 0: the wave
  TraversalChoice traversal = TraversalChoice::kAuto;
  std::string isa = "auto";
  DiffuseSampling diffuse_sampling = DiffuseSampling::kDisk;
  bool regenerate = true;
  bool stats_table = false;
  std::string stats_file;  // "": none
  DumpRequest dump;
};

struct InfoCommand {
  std::vector<std::string> scenes;
  bool json = false;
  std::string camera;  // as of RenderCommand
};

enum class ListTopic { kMaterials, kLights, kTextures, kShapes, kSamplers, kFilters, kIsas };
struct ListCommand {
  ListTopic topic = ListTopic::kMaterials;
};

// Text that was asked for (--help, --version) and goes to standard output.
struct ShowText {
  std::string text;
};

using Command = std::variant<RenderCommand, InfoCommand, ListCommand, ShowText>;

// `arguments` without the program's name. An error is wrong usage (exit code 2). `usable_isas` are
// the values of --isa beside "auto" that work on this machine.
Result<Command> ParseCommandLine(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& usable_isas);

const char* EngineName(Engine engine);
const char* TraversalName(TraversalChoice traversal);
const char* DiffuseSamplingName(DiffuseSampling sampling);
const char* SamplerName(SamplerKind sampler);

}  // namespace swell

#endif  // SWELL_CLI_OPTIONS_H_
