// What a glTF file may ask for at most; beyond, it is an error that names the limit.
#ifndef SWELL_IMPORT_GLTF_LIMITS_H_
#define SWELL_IMPORT_GLTF_LIMITS_H_

#include <cstddef>
#include <cstdint>

namespace swell {

inline constexpr size_t kMaxGltfJsonBytes = size_t{1} << 30;
inline constexpr size_t kMaxGltfJsonValues = size_t{1} << 26;  // of all kinds together
inline constexpr size_t kMaxGltfJsonDepth = 128;               // of lists and objects
inline constexpr size_t kMaxGltfNodeDepth = 4096;              // of children of children
inline constexpr uint64_t kMaxGltfAccessorCount = 0x7FFFFFFFu / 3;
// Of an accessor that names no data, and so is all zeros.
inline constexpr uint64_t kMaxGltfZeroCount = uint64_t{1} << 24;

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_LIMITS_H_
