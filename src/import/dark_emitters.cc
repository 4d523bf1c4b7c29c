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

// Cells [first, end) along an axis; a range that wraps around is two.
struct Cells {
  size_t first, end;
};

class LitCells {
 public:
  explicit LitCells(const ImageLight& light);
  // Whether any texel is not black that bilinear lookups within the box may use.
  bool AnyWithin(const UvBox& box) const;

 private:
  std::vector<Cells> Reached(TextureWrap wrap, double low, double high, uint32_t texels) const;

  SurfaceLookup lookup_;
  uint32_t width_, height_;          // texels
  uint32_t side_, columns_, rows_;   // of cells; texels of each
  std::vector<uint32_t> lit_above_;  // rows_ + 1 by columns_ + 1: lit cells above and to the left
};

LitCells::LitCells(const ImageLight& light)
    : lookup_(light.lookup),
      width_(light.image.levels[0].width),
      height_(light.image.levels[0].height) {
  side_ = (std::max(width_, height_) + kMaxCells - 1) / kMaxCells;
  columns_ = (width_ + side_ - 1) / side_;
  rows_ = (height_ + side_ - 1) / side_;
  const size_t pitch = size_t{columns_} + 1;
  lit_above_.assign(pitch * (rows_ + 1), 0);
  for (uint32_t y = 0; y < height_; ++y) {
    for (uint32_t x = 0; x < width_; ++x) {
      if (TexelAt(light.image, 0, x, y) == std::array<float, 3>{}) continue;
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

// Cells from that of the first texel to that of the last, one beyond those that a lookup blends:
// coordinates within a triangle are rounded.
std::vector<Cells> LitCells::Reached(TextureWrap wrap, double low, double high,
                                     uint32_t texels) const {
  const double size = texels;
  double first = std::floor(low * size - 0.5) - 1.0, last = std::floor(high * size - 0.5) + 2.0;
  const auto cell = [&](double texel) {
    return static_cast<size_t>(std::clamp(texel, 0.0, size - 1.0)) / side_;
  };
  const bool wraps = wrap == TextureWrap::kRepeat || wrap == TextureWrap::kMirror;
  if (!wraps) return {{cell(first), cell(last) + 1}};  // beyond the edges the last texels go on
  const double turn = std::floor(first / size), last_turn = std::floor(last / size);
  const std::vector<Cells> all = {{0, cell(size) + 1}};
  if (!(last - first < size)) return all;
  first -= turn * size;
  last -= last_turn * size;
  if (wrap == TextureWrap::kMirror) {
    const auto mirrored = [](double which) { return std::fmod(which, 2.0) != 0.0; };
    const double a = mirrored(turn) ? size - 1.0 - first : first;
    const double b = mirrored(last_turn) ? size - 1.0 - last : last;
    const auto [low_texel, high_texel] = std::minmax(a, b);
    if (turn == last_turn) return {{cell(low_texel), cell(high_texel) + 1}};
    if (mirrored(turn)) return {{0, cell(high_texel) + 1}};  // around the first texel
    return {{cell(low_texel), cell(size) + 1}};              // around the last
  }
  if (first <= last) return {{cell(first), cell(last) + 1}};
  return {{cell(first), cell(size) + 1}, {0, cell(last) + 1}};
}

bool LitCells::AnyWithin(const UvBox& box) const {
  const size_t pitch = size_t{columns_} + 1;
  const auto wrap_t = lookup_.wrap_t == TextureWrap::kAsOther ? lookup_.wrap : lookup_.wrap_t;
  const auto columns = Reached(lookup_.wrap, box.low[0], box.high[0], width_);
  const auto rows = Reached(wrap_t, 1.0f - box.high[1], 1.0f - box.low[1], height_);
  for (const Cells& x : columns) {
    for (const Cells& y : rows) {
      const uint32_t lit = lit_above_[y.end * pitch + x.end] - lit_above_[y.first * pitch + x.end] -
                           lit_above_[y.end * pitch + x.first] +
                           lit_above_[y.first * pitch + x.first];
      if (lit != 0) return true;
    }
  }
  return false;
}

UvBox BoxOf(const Scene& scene, uint32_t uv_offset, size_t triangle) {
  if (uv_offset == kNone) return {{0, 0}, {1, 1}};
  constexpr float kFar = std::numeric_limits<float>::max();
  UvBox box{{kFar, kFar}, {-kFar, -kFar}};
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t row = scene.indices[3 * triangle + k] + uv_offset;
    for (size_t axis = 0; axis < 2; ++axis) {
      const float value = scene.uvs[2 * size_t{row} + axis];
      box.low[axis] = std::min(box.low[axis], value);
      box.high[axis] = std::max(box.high[axis], value);
    }
  }
  return box;
}

// Moves the triangles of a mesh that are dark behind the others, and returns how many are lit.
uint32_t PutLitFirst(const LitCells& lit_cells, const Shape& shape, bool second_uvs, Scene* scene) {
  const ShapeRecord& record = shape.record;
  const bool second = second_uvs && shape.second_uv_offset != kNone;
  const uint32_t uv_offset = second ? shape.second_uv_offset : record.uv_offset;
  const size_t first = record.first_prim, end = first + record.prim_count;
  std::vector<uint32_t> dark;
  size_t lit = first;
  for (size_t triangle = first; triangle < end; ++triangle) {
    const auto corners = scene->indices.begin() + static_cast<ptrdiff_t>(3 * triangle);
    if (lit_cells.AnyWithin(BoxOf(*scene, uv_offset, triangle))) {
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
    const ImageLight& light = scene->image_lights[whole.emission_image];
    const auto at = cells.try_emplace(whole.emission_image, light);
    const bool second_uvs = light.lookup.second_uvs != 0;
    const uint32_t lit = PutLitFirst(at.first->second, whole, second_uvs, scene);
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
