// swell info: reads a scene, builds its tree, and says what is there.
#include <chrono>

#include "src/bvh/bvh.h"
#include "src/cli/commands.h"
#include "src/cli/scene_text.h"
#include "src/cli/terminal.h"
#include "src/import/import_scene.h"

namespace swell {
namespace {

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Status Describe(const InfoCommand& command) {
  const double start = Now();
  const Result<Scene> scene = ImportScene(command.scenes, {command.camera});
  if (!scene) return scene.error();
  const double imported = Now();
  const SceneTables tables = FinishScene(*scene);
  const Result<Bvh> bvh = BuildBvh(*scene);
  if (!bvh) return bvh.error();
  const TreeSummary tree{bvh->nodes.size(), bvh->blocks.size(), bvh->depth, bvh->bytes(),
                         Now() - imported};
  return WriteStandardOutput(
      SceneText(*scene, tables, {kMaterialKinds, kMaterialKindCount}, tree, imported - start));
}

}  // namespace

int RunInfo(const InfoCommand& command) { return ExitCode(Describe(command)); }

}  // namespace swell
