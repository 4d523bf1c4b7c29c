// A buffer view compressed by EXT_meshopt_compression -> its bytes.
#include "src/import/gltf_meshopt.h"

#include <meshoptimizer.h>

#include "src/base/available_memory.h"
#include "src/import/diagnostics.h"
#include "src/import/gltf_file.h"
#include "src/import/gltf_values.h"

namespace swell {
namespace {

constexpr uint64_t kMaxStride = 256;  // of meshoptimizer's vertex codec

// What the codecs take for granted of their arguments.
Status CheckLayout(const std::string& mode, const std::string& filter, uint64_t count,
                   uint64_t stride) {
  if (mode == "ATTRIBUTES") {
    const bool octahedral = filter == "OCTAHEDRAL", quaternion = filter == "QUATERNION";
    if (stride == 0 || stride % 4 != 0 || stride > kMaxStride ||
        (octahedral && stride != 4 && stride != 8) || (quaternion && stride != 8)) {
      return Error{"\"byteStride\" is " + std::to_string(stride)};
    }
    if (!octahedral && !quaternion && filter != "NONE" && filter != "EXPONENTIAL" &&
        !filter.empty()) {
      return Error{"unknown filter " + Quote(filter)};
    }
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4) return Error{"\"byteStride\" is " + std::to_string(stride)};
    if (mode == "TRIANGLES" && count % 3 != 0) return Error{"\"count\" is no multiple of 3"};
  } else {
    return Error{"unknown mode " + Quote(mode)};
  }
  if (count > AvailableMemory() / stride) {
    return Error{std::to_string(count) + " elements need more memory than there is"};
  }
  return Done{};
}

}  // namespace

Result<std::string> DecodeMeshopt(const GltfFile& file, const tinygltf::Value& extension) {
  const std::string mode = WordOf(&extension, "mode"), filter = WordOf(&extension, "filter");
  const uint64_t count = WholeOf(&extension, "count").value_or(0);
  const uint64_t stride = WholeOf(&extension, "byteStride").value_or(0);
  if (Status layout = CheckLayout(mode, filter, count, stride); !layout) return layout.error();
  const auto buffer = WholeOf(&extension, "buffer"), length = WholeOf(&extension, "byteLength");
  if (!buffer || !length) return Error{"\"buffer\" or \"byteLength\" is missing"};
  const uint64_t offset = WholeOf(&extension, "byteOffset").value_or(0);
  const Result<std::string_view> packed = file.BufferRange(*buffer, offset, *length);
  if (!packed) return packed.error();

  std::string bytes(count * stride, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(packed->data());
  int failure = 0;
  if (mode == "ATTRIBUTES") {
    failure = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, packed->size());
  } else if (mode == "TRIANGLES") {
    failure = meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, packed->size());
  } else {
    failure = meshopt_decodeIndexSequence(bytes.data(), count, stride, from, packed->size());
  }
  if (failure != 0) return Error{"the data is damaged"};
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
  return bytes;
}

}  // namespace swell
