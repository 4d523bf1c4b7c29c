// swell info: reads a scene, builds its tree, and says what is there.
#include <chrono>

#include "src/bvh/bvh.h"
#include "src/cli/commands.h"
#include "src/cli/scene_text.h"
#include "src/cli/terminal.h"
#include "src/import/import_scene.h"
#include "src/stats/machine.h"

namespace swell {
namespace {

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Ends a phase: how long it took, and the most memory up to now.
class Phases {
 public:
  explicit Phases(SceneFacts* facts) : facts_(*facts), start_(Now()) {}
  void End(const char* phase) {
    const double now = Now();
    facts_.seconds.emplace_back(phase, now - start_);
    facts_.peak_rss_bytes.emplace_back(phase, PeakResidentBytes());
    start_ = now;
  }

 private:
  SceneFacts& facts_;
  double start_;
};

Status Describe(const InfoCommand& command) {
  SceneFacts measured;
  Phases phases(&measured);
  const Result<Scene> scene = ImportScene(command.scenes, {command.camera});
  if (!scene) return scene.error();
  phases.End("import");
  const SceneTables tables = FinishScene(*scene);
  phases.End("lights");
  const Result<Bvh> bvh = BuildBvh(*scene);
  if (!bvh) return bvh.error();
  phases.End("build");
  const TreeSummary tree{bvh->nodes.size(), bvh->blocks.size(), bvh->depth, bvh->bytes()};
  SceneFacts facts = CollectFacts(*scene, tables, {kMaterialKinds, kMaterialKindCount}, tree);
  facts.seconds = measured.seconds;
  facts.peak_rss_bytes = measured.peak_rss_bytes;
  return WriteStandardOutput(command.json ? SceneJson(facts) : SceneText(facts));
}

}  // namespace

int RunInfo(const InfoCommand& command) { return ExitCode(Describe(command)); }

}  // namespace swell
