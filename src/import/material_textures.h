// What textures do to a material: parameters that vary, and relief of the surface.
#ifndef SWELL_IMPORT_MATERIAL_TEXTURES_H_
#define SWELL_IMPORT_MATERIAL_TEXTURES_H_

#include "kernels/material.h"
#include "src/import/parameters.h"
#include "src/scene/scene.h"

namespace swell {

// Lets the texture `node`, a row of the scene's texture_nodes, give parameter `index` of a kind
// that takes_columns().
void BindTexture(const MaterialInfo& info, uint32_t index, uint32_t node, Material* material);

// Reads parameter `index` of a kind, given as a texture. True if the texture is constant: then its
// value is in material->params, yet to be checked against the parameter's range.
bool ReadTexturedParameter(Parameters& parameters, const Parameter& parameter,
                           const MaterialInfo& info, uint32_t index, Material* material);

// "displacement" and "normalmap"; then checks that one program can compute all of its textures.
void ReadRelief(Parameters& parameters, Material* material);

}  // namespace swell

#endif  // SWELL_IMPORT_MATERIAL_TEXTURES_H_
