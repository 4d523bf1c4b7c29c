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

Status Describe(const InfoCommand& command) {
  const double start = Now();
  const Result<Scene> scene = ImportScene(command.scenes);
  if (!scene) return scene.error();
  const double imported = Now();
  const SceneTables tables = FinishScene(*scene);
  const double finished = Now();
  const Result<Bvh> bvh = BuildBvh(*scene);
  if (!bvh) return bvh.error();
  const TreeSummary tree{bvh->nodes.size(), bvh->blocks.size(), bvh->depth, bvh->bytes()};
  SceneFacts facts = CollectFacts(*scene, tables, {kMaterialKinds, kMaterialKindCount}, tree);
  facts.seconds = {
      {"import", imported - start}, {"lights", finished - imported}, {"build", Now() - finished}};
  facts.peak_rss_bytes = PeakResidentBytes();
  return WriteStandardOutput(command.json ? SceneJson(facts) : SceneText(facts));
}

}  // namespace

int RunInfo(const InfoCommand& command) { return ExitCode(Describe(command)); }

}  // namespace swell
