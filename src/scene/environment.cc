// Brightness of an image's cells -> tables by which directions are drawn.
#include "src/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace swell {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kMaxCells = 1024;  // per side; larger images share cells

double Brightness(const std::array<float, 3>& rgb) {
  return (std::max(0.0f, rgb[0]) + std::max(0.0f, rgb[1]) + std::max(0.0f, rgb[2])) / 3.0;
}

double RowCosine(uint32_t row, uint32_t rows) { return std::cos(kPi * row / rows); }

double CellSolidAngle(ImageMapping mapping, uint32_t row, uint32_t rows, uint32_t columns) {
  if (mapping != ImageMapping::kLatLong) return 4.0 * kPi / rows / columns;
  return 2.0 * kPi / columns * (RowCosine(row, rows) - RowCosine(row + 1, rows));
}

// Shares from 0 to exactly 1 of the weights, equal ones if there are none. Returns the sum.
double Accumulate(const double* weights, uint32_t count, float* cdf) {
  const double sum = std::accumulate(weights, weights + count, 0.0);
  double so_far = 0.0;
  for (uint32_t i = 0; i < count; ++i) {
    cdf[i] = static_cast<float>(sum > 0.0 ? so_far / sum : double{1} * i / count);
    so_far += weights[i];
  }
  cdf[count] = 1.0f;
  // Cells after the last that weighs anything must stay empty.
  for (uint32_t i = count; i > 1 && sum > 0.0 && weights[i - 1] == 0.0; --i) cdf[i - 1] = 1.0f;
  return sum;
}

// Mean brightness of every cell.
std::vector<double> CellBrightness(const TexelImage& image, ImageMapping mapping, uint32_t rows,
                                   uint32_t columns) {
  const ImageLevel& level = image.levels[0];
  std::vector<double> sums(size_t{rows} * columns), angles(size_t{rows} * columns);
  for (uint32_t y = 0; y < level.height; ++y) {
    const uint32_t row = static_cast<uint32_t>(uint64_t{y} * rows / level.height);
    const double angle = PixelSolidAngle(image, mapping, y);
    for (uint32_t x = 0; x < level.width; ++x) {
      const size_t cell =
          size_t{row} * columns + static_cast<size_t>(uint64_t{x} * columns / level.width);
      sums[cell] += angle * Brightness(TexelAt(image, 0, x, y));
      angles[cell] += angle;
    }
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= angles[i];
  return sums;
}

}  // namespace

double PixelSolidAngle(const TexelImage& image, ImageMapping mapping, uint32_t row) {
  return CellSolidAngle(mapping, row, image.levels[0].height, image.levels[0].width);
}

std::array<double, 3> PixelDirection(const TexelImage& image, ImageMapping mapping, uint32_t x,
                                     uint32_t y) {
  const double u = (x + 0.5) / image.levels[0].width, v = (y + 0.5) / image.levels[0].height;
  if (mapping == ImageMapping::kLatLong) {
    const double radius = std::sin(kPi * v), phi = 2.0 * kPi * u;
    return {radius * std::cos(phi), radius * std::sin(phi), std::cos(kPi * v)};
  }
  // Clarberg 2008; see kernels/sphere_map-inl.h.
  const double a = 2 * u - 1, b = 2 * v - 1;
  const double height = 1 - std::abs(a) - std::abs(b), r = 1 - std::abs(height);
  const double phi = r > 0.0 ? kPi / 4 * ((std::abs(b) - std::abs(a)) / r + 1) : 0.0;
  const double radius = r * std::sqrt(2 - r * r);
  return {std::copysign(radius * std::cos(phi), a), std::copysign(radius * std::sin(phi), b),
          std::copysign(1 - r * r, height)};
}

SkyTable MakeSkyTable(const TexelImage& image, ImageMapping mapping) {
  SkyTable table;
  const uint32_t rows = std::min(image.levels[0].height, kMaxCells);
  const uint32_t columns = std::min(image.levels[0].width, kMaxCells);
  table.rows = rows;
  table.columns = columns;
  std::vector<double> weights = CellBrightness(image, mapping, rows, columns);
  double mean = 0.0;
  for (uint32_t y = 0; y < rows; ++y) {
    const double angle = CellSolidAngle(mapping, y, rows, columns) / (4.0 * kPi);
    for (uint32_t x = 0; x < columns; ++x) mean += angle * weights[size_t{y} * columns + x];
  }
  double most = 0.0;
  for (double& weight : weights) {
    weight = std::max(0.0, weight - mean);
    most = std::max(most, weight);
  }
  // An even sky has nothing above its mean but rounding.
  if (!(most > 1e-6 * mean)) std::fill(weights.begin(), weights.end(), 1.0);

  table.row_cdf.resize(rows + 1);
  table.column_cdf.resize(size_t{rows} * (columns + 1));
  std::vector<double> row_sums(rows);
  for (uint32_t y = 0; y < rows; ++y) {
    const double angle = CellSolidAngle(mapping, y, rows, columns);
    const double sum = Accumulate(&weights[size_t{y} * columns], columns,
                                  &table.column_cdf[size_t{y} * (columns + 1)]);
    row_sums[y] = sum * angle;
    table.inverse_angle.push_back(static_cast<float>(1.0 / angle));
  }
  for (uint32_t y = 0; y <= rows; ++y) {
    table.row_cosine.push_back(static_cast<float>(RowCosine(y, rows)));
  }
  Accumulate(row_sums.data(), rows, table.row_cdf.data());
  return table;
}

double MeanLevel(const ImageLight& light) {
  const ImageLevel& level = light.image.levels[0];
  const bool plane =
      light.mapping == ImageMapping::kProjection || light.mapping == ImageMapping::kSurface;
  const ImageMapping mapping = plane ? ImageMapping::kEqualArea : light.mapping;
  double sum = 0.0;
  for (uint32_t y = 0; y < level.height; ++y) {
    double row = 0.0;
    for (uint32_t x = 0; x < level.width; ++x) {
      const auto rgb = TexelAt(light.image, 0, x, y);
      row += std::max({0.0f, rgb[0], rgb[1], rgb[2]});
    }
    sum += row * PixelSolidAngle(light.image, mapping, y);
  }
  return sum / (4.0 * kPi);
}

ImageLightView MakeImageLightView(const ImageLight& light, const SkyTable& table) {
  ImageLightView view{};
  view.image = light.image.view();
  view.mapping = light.mapping;
  std::copy(light.light_from_world.begin(), light.light_from_world.end(), view.light_from_world);
  std::copy(light.world_from_light.begin(), light.world_from_light.end(), view.world_from_light);
  const auto& m = light.light_from_world;
  const double determinant = double{m[0]} * (double{m[4]} * m[8] - double{m[5]} * m[7]) -
                             double{m[1]} * (double{m[3]} * m[8] - double{m[5]} * m[6]) +
                             double{m[2]} * (double{m[3]} * m[7] - double{m[4]} * m[6]);
  view.jacobian = static_cast<float>(std::abs(determinant));
  std::copy(light.half_width.begin(), light.half_width.end(), view.half_width);
  view.lookup = light.lookup;
  view.rows = table.rows;
  view.columns = table.columns;
  view.row_cdf = table.row_cdf.data();
  view.column_cdf = table.column_cdf.data();
  view.row_cosine = table.row_cosine.data();
  view.inverse_angle = table.inverse_angle.data();
  return view;
}

}  // namespace swell
