// Images to files, whole or not at all: written beside the target, synced, then renamed.
#ifndef SWELL_FILM_WRITE_IMAGE_H_
#define SWELL_FILM_WRITE_IMAGE_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/base/result.h"
#include "src/film/film.h"

namespace swell {

// What an EXR's header says of how it was made.
struct ImageMetadata {
  std::vector<std::pair<std::string, std::string>> strings;  // "swell:scene", "swell:seed", ...
  uint32_t frame_width = 0, frame_height = 0;  // display window; 0: the image is the whole frame
  PixelBounds crop;                            // data window, of the image's size
};

// Finds out before the render whether the path can be written: known ending (.exr, .png), the
// folder exists and takes a file. Leaves nothing behind.
Status CheckOutput(const std::string& path);

// .exr: linear float, Rec. 709 primaries; .png: 8-bit sRGB (IEC 61966-2-1), clipped, the crop only.
// Equal images and metadata give equal bytes. After an error neither a new file nor a changed one
// is under `path`; a symbolic link stays one, and what it points to is replaced.
Status WriteImage(const std::string& path, const Image& image, const ImageMetadata& metadata);

// The first three channels of an image file (one channel three times for grey ones). The values are
// as stored: linear for EXR, encoded and divided by 255 for an 8-bit PNG.
Result<Image> ReadImage(const std::string& path);

// The 8-bit code of a linear value: the sRGB curve of IEC 61966-2-1 times 255, rounded to nearest.
// NaN is 0.
uint8_t EncodeSrgb(float linear);

}  // namespace swell

#endif  // SWELL_FILM_WRITE_IMAGE_H_
