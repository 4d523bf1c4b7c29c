// The JSON text of a glTF file -> tinygltf's model, and the buffers and images that it names.
#ifndef SWELL_IMPORT_GLTF_JSON_H_
#define SWELL_IMPORT_GLTF_JSON_H_

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/result.h"

namespace swell {

// A buffer or an image, as the text describes it.
struct GltfSource {
  std::string uri;        // "": none
  uint64_t bytes = 0;     // of a buffer
  int buffer_view = -1;   // of an image
  bool fallback = false;  // a buffer that only decoders without EXT_meshopt_compression need
};

// tinygltf reads neither files nor pixels and decodes no data: all bytes come through our own
// checks. The model's lists of buffers and images are empty.
struct GltfText {
  tinygltf::Model model;
  std::vector<GltfSource> buffers, images;
};

// Errors do not name the file.
Result<GltfText> ParseGltfText(std::string_view json);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_JSON_H_
