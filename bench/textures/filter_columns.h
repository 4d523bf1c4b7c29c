// Columns of texture coordinates and widths -> columns of filtered texels.
#ifndef SWELL_BENCH_TEXTURES_FILTER_COLUMNS_H_
#define SWELL_BENCH_TEXTURES_FILTER_COLUMNS_H_

#include <cstddef>

#include "kernels/kernel.h"
#include "kernels/texture_view.h"

namespace swell {

struct FilterColumnsArgs {
  const ImageView* image;
  TextureWrap wrap;
  TextureFilter filter;
  const float* s;
  const float* t;      // from the top
  const float* width;  // part of the image's side
  float* rgb[3];
  size_t count;  // whole vectors
};
SWELL_KERNEL(void, FilterColumns, const FilterColumnsArgs& args);

}  // namespace swell

#endif  // SWELL_BENCH_TEXTURES_FILTER_COLUMNS_H_
