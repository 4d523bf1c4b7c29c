// Fuzzer of glTF files: .glb where the bytes begin as one, else .gltf.
#include "src/import/import_scene.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace swell;
  const std::string_view text = fuzz::Text(data, size);
  const bool binary = text.substr(0, 4) == "glTF";
  fuzz::Check(ImportScene({fuzz::WriteFile(binary ? "m.glb" : "m.gltf", text)}));
  return 0;
}
