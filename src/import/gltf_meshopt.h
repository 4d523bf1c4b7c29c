// A buffer view compressed by EXT_meshopt_compression -> its bytes.
#ifndef SWELL_IMPORT_GLTF_MESHOPT_H_
#define SWELL_IMPORT_GLTF_MESHOPT_H_

#include <tiny_gltf.h>

#include <string>

#include "src/base/result.h"

namespace swell {

class GltfFile;

Result<std::string> DecodeMeshopt(const GltfFile& file, const tinygltf::Value& extension);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_MESHOPT_H_
