// A primitive of a glTF mesh -> rows of its vertices and triangles, compressed or not.
#ifndef SWELL_IMPORT_GLTF_PRIMITIVE_H_
#define SWELL_IMPORT_GLTF_PRIMITIVE_H_

#include <map>
#include <string>
#include <vector>

#include "src/import/gltf_accessor.h"

namespace swell {

struct GltfPrimitive {
  std::map<std::string, GltfRows> attributes;  // those asked for that it has, of equal counts
  std::vector<uint32_t> indices;               // three for each triangle
  size_t incomplete = 0;                       // indices left over
};

// Reads the attributes of these names. Vertices before the first and after the last that is used
// are left out. A primitive of points or lines has no indices.
Result<GltfPrimitive> ReadPrimitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                                    const std::vector<std::string>& names);

// As ReadPrimitive, of one with KHR_draco_mesh_compression.
Result<GltfPrimitive> ReadDracoPrimitive(const GltfFile& file, const tinygltf::Value& extension,
                                         const std::vector<std::string>& names);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_PRIMITIVE_H_
