// Images to files, whole or not at all: written beside the target, synced, then renamed.
#ifndef SWELL_FILM_WRITE_IMAGE_H_
#define SWELL_FILM_WRITE_IMAGE_H_

#include <string>
#include <vector>

#include "src/base/result.h"
#include "src/film/film.h"

namespace swell {

// What an EXR's header says of how it was made.
struct ImageMetadata {
  std::vector<std::pair<std::string, std::string>> strings;  // "swell:scene", "swell:seed", ...
  uint32_t frame_width = 0, frame_height = 0;  // display window; the crop is the data window
  PixelBounds crop;
};

// Finds out before the render whether the path can be written: known ending (.exr, .png), the
// folder exists and takes a file.
Status CheckOutput(const std::string& path);

// .exr: linear float; .png: 8-bit sRGB (IEC 61966-2-1), clipped.
Status WriteImage(const std::string& path, const Image& image, const ImageMetadata& metadata);

}  // namespace swell

#endif  // SWELL_FILM_WRITE_IMAGE_H_
