// A material's parameters by name, for importers whose files do not name them: values, or textures
// that vary them.
#ifndef SWELL_IMPORT_MATERIAL_WORDS_H_
#define SWELL_IMPORT_MATERIAL_WORDS_H_

#include <array>
#include <string_view>

#include "src/scene/scene.h"

namespace swell {

// Brought to the parameter's range. The material's kind must have the parameter.
void SetNumber(std::string_view parameter, double value, Material* material);
void SetColor(std::string_view parameter, const std::array<double, 3>& value, Material* material);
// `node` is a row of the scene's texture_nodes.
void SetTexture(std::string_view parameter, uint32_t node, Material* material);

}  // namespace swell

#endif  // SWELL_IMPORT_MATERIAL_WORDS_H_
