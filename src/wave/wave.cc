// Lays the windows of a wave out over its tables.
#include "src/wave/wave.h"

#include <algorithm>

namespace swell {
namespace {

// A window starts on a whole vector, and a vector stored anywhere in its rows ends before the next
// one.
uint32_t WindowStride(uint32_t window_rows) {
  return static_cast<uint32_t>(RoundUpToPadding(window_rows) + kRowPadding);
}

uint32_t WindowCount(uint32_t row_count, uint32_t window_rows) {
  return std::max(1u, row_count / static_cast<uint32_t>(RoundUpToPadding(window_rows)));
}

size_t PhysicalRows(uint32_t row_count, uint32_t window_rows) {
  return size_t{WindowCount(row_count, window_rows)} * WindowStride(window_rows);
}

}  // namespace

Wave::Wave(uint32_t row_count, uint32_t window_rows, uint32_t material_count,
           uint32_t texture_columns, bool has_media)
    : windows(WindowCount(row_count, window_rows)),
      rays(PhysicalRows(row_count, window_rows)),
      next(rays.capacity()),
      hits(rays.capacity()),
      shadow_rays(rays.capacity()),
      paths(rays.capacity()),
      rows(rays.capacity() + kRowPadding),
      keys(rays.capacity() + kRowPadding),
      histogram(material_count + 2),
      runs(windows.size() * std::min<size_t>(material_count + 2, window_rows)),
      slots(rays.capacity() + kRowPadding),
      ended(rays.capacity() + kRowPadding),
      texture_cells(size_t{texture_columns} * WindowStride(window_rows)),
      texture_stride(WindowStride(window_rows)),
      path_medium(has_media ? rays.capacity() + kRowPadding : 0),
      shadow_medium(path_medium.size()),
      entered(path_medium.size()) {
  const uint32_t stride = WindowStride(window_rows);
  for (size_t w = 0; w < windows.size(); ++w) {
    Window& window = windows[w];
    window.first = static_cast<uint32_t>(w) * stride;
    window.capacity = window_rows;
    window.free_slots = window_rows;
    for (uint32_t i = 0; i < window_rows; ++i) slots[window.first + i] = i;
  }
}

uint32_t Wave::row_count() const {
  return static_cast<uint32_t>(windows.size()) * windows.front().capacity;
}

bool Wave::ok() const {
  return rays.ok() && next.ok() && hits.ok() && shadow_rays.ok() && paths.ok();
}

size_t Wave::bytes() const {
  const size_t lists = rows.size() + keys.size() + slots.size() + ended.size() + histogram.size() +
                       path_medium.size() + shadow_medium.size() + entered.size();
  return rays.bytes() + next.bytes() + hits.bytes() + shadow_rays.bytes() + paths.bytes() +
         (lists + texture_cells.size()) * sizeof(uint32_t) + runs.size() * sizeof(Run) +
         windows.size() * sizeof(Window);
}

}  // namespace swell
