// Fuzzer of OBJ and MTL files: the bytes up to a zero are the model, those behind it its m.mtl.
#include <algorithm>

#include "src/import/import_scene.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace swell;
  static const std::string image =
      fuzz::WriteFile("i.pfm", "Pf\n1 1\n-1.0\n" + std::string(4, '\0'));
  const std::string_view text = fuzz::Text(data, size);
  const size_t end = std::min(text.find('\0'), text.size());
  fuzz::WriteFile("m.mtl", text.substr(std::min(end + 1, text.size())));
  fuzz::Check(ImportScene({fuzz::WriteFile("m.obj", text.substr(0, end))}));
  return 0;
}
