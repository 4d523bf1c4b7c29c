// Sums over coarse cells of an image tell whether the box around a triangle's coordinates is black.
#include "src/import/dark_emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace swell {
namespace {

constexpr uint32_t kMaxCells = 1024;  // along a side, so that the sums stay small

// A box of an image: u to the right, v upwards, as coordinates are stored.
struct UvBox {
  std::array<float, 2> low{}, high{};
};

class LitCells {
 public:
  explicit LitCells(const TexelImage& image);
  // Whether any texel is not black that bilinear lookups within the box may use.
  bool AnyWithin(const UvBox& box) const;

 private:
  uint32_t width_, height_;          // texels
  uint32_t side_, columns_, rows_;   // of cells; texels of each
  std::vector<uint32_t> lit_above_;  // rows_ + 1 by columns_ + 1: lit cells above and to the left
};

LitCells::LitCells(const TexelImage& image)
    : width_(image.levels[0].width), height_(image.levels[0].height) {
  side_ = (std::max(width_, height_) + kMaxCells - 1) / kMaxCells;
  columns_ = (width_ + side_ - 1) / side_;
  rows_ = (height_ + side_ - 1) / side_;
  const size_t pitch = size_t{columns_} + 1;
  lit_above_.assign(pitch * (rows_ + 1), 0);
  for (uint32_t y = 0; y < height_; ++y) {
    for (uint32_t x = 0; x < width_; ++x) {
      if (TexelAt(image, 0, x, y) == std::array<float, 3>{}) continue;
      lit_above_[(y / side_ + 1) * pitch + x / side_ + 1] = 1;
    }
  }
  for (size_t row = 1; row <= rows_; ++row) {
    for (size_t column = 1; column <= columns_; ++column) {
      const size_t at = row * pitch + column;
      lit_above_[at] += lit_above_[at - 1] + lit_above_[at - pitch] - lit_above_[at - pitch - 1];
    }
  }
}

bool LitCells::AnyWithin(const UvBox& box) const {
  // Cells from that of the first texel to that of the last, one beyond those that a lookup blends:
  // coordinates within a triangle are rounded. Beyond the edges the image's last texels go on.
  const auto cell = [&](float coordinate, uint32_t texels, double beyond) {
    const double texel = std::floor(double{coordinate} * texels - 0.5) + beyond;
    return static_cast<size_t>(std::clamp(texel, 0.0, texels - 1.0)) / side_;
  };
  const size_t pitch = size_t{columns_} + 1;
  const size_t left = cell(box.low[0], width_, -1.0), right = cell(box.high[0], width_, 2.0) + 1;
  const size_t top = cell(1.0f - box.high[1], height_, -1.0);
  const size_t bottom = cell(1.0f - box.low[1], height_, 2.0) + 1;
  return lit_above_[bottom * pitch + right] - lit_above_[top * pitch + right] -
             lit_above_[bottom * pitch + left] + lit_above_[top * pitch + left] !=
         0;
}

UvBox BoxOf(const Scene& scene, const ShapeRecord& record, size_t triangle) {
  if (record.uv_offset == kNone) return {{0, 0}, {1, 1}};
  constexpr float kFar = std::numeric_limits<float>::max();
  UvBox box{{kFar, kFar}, {-kFar, -kFar}};
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t row = scene.indices[3 * triangle + k] + record.uv_offset;
    for (size_t axis = 0; axis < 2; ++axis) {
      const float value = scene.uvs[2 * size_t{row} + axis];
      box.low[axis] = std::min(box.low[axis], value);
      box.high[axis] = std::max(box.high[axis], value);
    }
  }
  return box;
}

// Moves the triangles of a mesh that are dark behind the others, and returns how many are lit.
uint32_t PutLitFirst(const LitCells& lit_cells, const ShapeRecord& record, Scene* scene) {
  const size_t first = record.first_prim, end = first + record.prim_count;
  std::vector<uint32_t> dark;
  size_t lit = first;
  for (size_t triangle = first; triangle < end; ++triangle) {
    const auto corners = scene->indices.begin() + static_cast<ptrdiff_t>(3 * triangle);
    if (lit_cells.AnyWithin(BoxOf(*scene, record, triangle))) {
      std::copy(corners, corners + 3, scene->indices.begin() + static_cast<ptrdiff_t>(3 * lit++));
    } else {
      dark.insert(dark.end(), corners, corners + 3);
    }
  }
  std::copy(dark.begin(), dark.end(), scene->indices.begin() + static_cast<ptrdiff_t>(3 * lit));
  return static_cast<uint32_t>(lit - first);
}

}  // namespace

void LeaveDarkUnlit(Scene* scene) {
  std::map<uint32_t, LitCells> cells;  // by image
  const size_t shapes = scene->shapes.size();
  for (size_t s = 0; s < shapes; ++s) {
    const Shape whole = scene->shapes[s];
    const bool sphere = (whole.record.flags & kShapeIsSphere) != 0;
    if (!whole.emits || sphere || whole.emission_image == kNoTexture) continue;
    const auto at =
        cells.try_emplace(whole.emission_image, scene->image_lights[whole.emission_image].image);
    const uint32_t lit = PutLitFirst(at.first->second, whole.record, scene);
    if (lit == whole.record.prim_count) continue;
    Shape dark = whole;
    dark.emits = false;
    dark.emission_image = kNoTexture;
    if (lit == 0) {
      scene->shapes[s] = dark;
      continue;
    }
    scene->shapes[s].record.prim_count = lit;
    dark.record.first_prim += lit;
    dark.record.prim_count -= lit;
    std::fill_n(scene->prim_shape.begin() + dark.record.first_prim, dark.record.prim_count,
                static_cast<uint32_t>(scene->shapes.size()));
    scene->shapes.push_back(dark);
  }
}

}  // namespace swell
