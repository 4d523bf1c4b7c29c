// Fuzzer of PLY files as scenes.
#include "src/import/import_scene.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace swell;
  fuzz::Check(ImportScene({fuzz::WriteFile("mesh.ply", fuzz::Text(data, size))}));
  return 0;
}
