// What was read from a scene file, as tables for a person and as JSON for scripts.
#ifndef SWELL_CLI_SCENE_TEXT_H_
#define SWELL_CLI_SCENE_TEXT_H_

#include <string>

#include "src/cli/scene_facts.h"

namespace swell {

// Counts, bounds, materials by kind, lights by type, textures, camera, film, memory by part, the
// tree, time by phase, warnings. Ends in a newline.
std::string SceneText(const SceneFacts& facts);

// The same on one line, with stable names; what is not there is null or empty.
std::string SceneJson(const SceneFacts& facts);

}  // namespace swell

#endif  // SWELL_CLI_SCENE_TEXT_H_
