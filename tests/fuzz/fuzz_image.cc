// Fuzzer of images as textures: the first byte chooses how the rest is named and used.
#include "src/import/read_image.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace swell;
  constexpr const char* kNames[] = {"t.png", "t.exr", "t.hdr", "t.pfm", "t.tga", "t.jpg", "t.bmp"};
  if (size == 0) return 0;
  const std::string name = kNames[data[0] % std::size(kNames)];
  const std::string path = fuzz::WriteFile(name, fuzz::Text(data + 1, size - 1));
  const ImageUse use = data[0] < 128 ? ImageUse::kColor : ImageUse::kScalar;
  const Result<ReadPixels> read = ReadImagePixels(path, use, {});
  if (read) MakeTexelImage(read->pixels, Levels::kAll);
  return 0;
}
