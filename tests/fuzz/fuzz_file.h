// Bytes of the fuzzer -> files in a folder of this process's own, as importers take paths; and what
// must hold of every scene that they return.
#ifndef SWELL_TESTS_FUZZ_FUZZ_FILE_H_
#define SWELL_TESTS_FUZZ_FUZZ_FILE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell::fuzz {

inline std::string_view Text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// The path of the file in the folder that is removed at the end. In memory where there is /dev/shm.
std::string WriteFile(const std::string& name, std::string_view bytes);

// Ends the process if the scene names rows that are not there, or an error says nothing.
void Check(const Result<Scene>& scene);

}  // namespace swell::fuzz

#endif  // SWELL_TESTS_FUZZ_FUZZ_FILE_H_
