// Fuzzer of the pbrt reader: the bytes are a scene file, beside which stand a mesh.ply and an
// image.pfm that it may name.
#include "src/import/import_scene.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace swell;
  static const bool ready = [] {
    fuzz::WriteFile("mesh.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    fuzz::WriteFile("image.pfm", "Pf\n1 1\n-1.0\n" + std::string(4, '\0'));
    return true;
  }();
  (void)ready;
  fuzz::Check(ImportScene({fuzz::WriteFile("scene.pbrt", fuzz::Text(data, size))}));
  return 0;
}
