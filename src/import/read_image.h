// An image file -> its pixels, with the few things that textures and lights ask of them.
#ifndef SWELL_IMPORT_READ_IMAGE_H_
#define SWELL_IMPORT_READ_IMAGE_H_

#include <string>
#include <string_view>
#include <vector>

#include "src/base/result.h"
#include "src/scene/image.h"

namespace swell {

// How integer codes mean light: the sRGB curve, the code itself, or its power.
struct Encoding {
  enum class Curve { kSrgb, kLinear, kGamma } curve = Curve::kSrgb;
  float gamma = 2.2f;

  float Decode(double code) const;  // of [0, 1]
};

enum class ImageUse {
  kColor,   // 3 channels; grey images have 1
  kScalar,  // 1 channel: alpha where some pixel has one below 1, else the mean of the colours
  kRed,     // 1 channel, as the others below
  kGreen,
  kBlue,
  kAlpha,  // never encoded; 1 where a file has none
};

// An image: the file of that path, or, if there are any, encoded bytes (PNG, JPEG or WebP) that
// messages call so.
struct ImageSource {
  std::string name;
  std::string_view bytes;
};

struct ImagePick {
  ImageUse use = ImageUse::kColor;
  Encoding encoding;
};

struct ReadPixels {
  Pixels pixels;
  uint64_t not_finite = 0;  // values that were; they are 0 now
};

// Files of floating point are linear whatever the encoding. An error names the file.
Result<ReadPixels> ReadImagePixels(const std::string& path, ImageUse use, const Encoding& encoding);

// Several uses of an image that is decoded once, in the order of `picks`.
Result<std::vector<ReadPixels>> ReadImagePicks(const ImageSource& source,
                                               const std::vector<ImagePick>& picks);

}  // namespace swell

#endif  // SWELL_IMPORT_READ_IMAGE_H_
