// Pixel filters in, claims about the offsets and weights of the camera rays that they draw out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "kernels/generate_rays.h"
#include "src/scene/views.h"
#include "src/wave/table.h"
#include "tests/reference/filter.h"
#include "tests/support/probe.h"

namespace swell::test {
namespace {

// pbrt-v4's defaults, and each filter wider, narrower and with other parameters.
const Filter kFilters[] = {
    {FilterType::kBox, 0.5f, 0.5f, 0, 0},
    {FilterType::kBox, 1.25f, 3, 0, 0},
    {FilterType::kTriangle, 2, 2, 0, 0},
    {FilterType::kTriangle, 0.5f, 1.25f, 0, 0},
    {FilterType::kGaussian, 1.5f, 1.5f, 0.5f, 0},
    {FilterType::kGaussian, 3, 1, 1, 0},
    {FilterType::kMitchell, 2, 2, 1.0f / 3, 1.0f / 3},
    {FilterType::kMitchell, 3, 1.5f, 0.0f, 0.75f},
    {FilterType::kSinc, 4, 4, 3, 0},
    {FilterType::kSinc, 2.5f, 6, 2, 0},
};

struct Draws {
  std::vector<double> x, y, weight;
};

// Offsets of one camera ray for each of side x side pixels from their pixels' centres. The camera
// maps the film to the plane z = 0 as it is.
Draws DrawOffsets(const Filter& filter, uint32_t side, uint32_t sample) {
  CameraView camera{};
  camera.type = CameraType::kOrthographic;
  camera.raster_to_screen[0] = camera.raster_to_screen[2] = 1;
  for (int i : {0, 5, 10}) camera.camera_to_world[i] = 1;
  const FilterTables tables = MakeFilterTables(filter);
  const uint32_t count = side * side;
  std::vector<uint32_t> pixels(count + kRowPadding), slots(count + kRowPadding);
  for (uint32_t i = 0; i < count; ++i) pixels[i] = i % side | i / side << 16;
  std::iota(slots.begin(), slots.end(), 0u);
  Table<RayFields> rays(count);
  Table<PathFields> paths(count);
  GenerateRays(Width::kWide,
               {camera,
                tables.view(),
                /*seed=*/1,
                sample,
                pixels.data(),
                slots.data(),
                count,
                {SamplerKind::kIndependent, 4}},
               rays.Columns(), paths.Columns());
  Draws draws;
  const RaysIn rows = rays.ReadColumns();
  for (uint32_t i = 0; i < count; ++i) {
    draws.x.push_back(double{rows.org.x[i]} - (i % side + 0.5));
    draws.y.push_back(double{rows.org.y[i]} - (i / side + 0.5));
    draws.weight.push_back(rows.throughput.r[i]);
  }
  return draws;
}

// Integrals of |f| and of f over [a, b].
struct Share {
  double absolute = 0, plain = 0;
};
Share Integrate(const Filter& f, double r, double a, double b) {
  constexpr int kSteps = 2000;
  Share share;
  for (int i = 0; i < kSteps; ++i) {
    const double value =
        reference::FilterValue(f, r, a + (b - a) * (i + 0.5) / kSteps) * (b - a) / kSteps;
    share.absolute += std::abs(value);
    share.plain += value;
  }
  return share;
}

// Edges of cells of the axis, each at least one part in 64 of the filter's absolute integral.
std::vector<double> CellEdges(const Filter& f, double r) {
  constexpr int kFine = 512;
  const double least = Integrate(f, r, -r, r).absolute / 64;
  std::vector<double> edges{-r};
  double gathered = 0;
  for (int i = 0; i < kFine; ++i) {
    const double end = -r + 2 * r * (i + 1) / kFine;
    gathered += Integrate(f, r, end - 2 * r / kFine, end).absolute;
    if (gathered < least) continue;
    edges.push_back(end);
    gathered = 0;
  }
  edges.back() = r;
  return edges;
}

TEST_CASE("filters: drawn offsets are distributed as |f|, weights as its sign, with mean 1") {
  constexpr uint32_t kSide = 256;
  for (size_t which = 0; which < std::size(kFilters); ++which) {
    const Filter& filter = kFilters[which];
    Draws draws;
    for (uint32_t sample = 0; sample < 4; ++sample) {
      const Draws more = DrawOffsets(filter, kSide, sample);
      draws.x.insert(draws.x.end(), more.x.begin(), more.x.end());
      draws.y.insert(draws.y.end(), more.y.begin(), more.y.end());
      draws.weight.insert(draws.weight.end(), more.weight.begin(), more.weight.end());
    }
    const double count = double(draws.x.size());
    for (int axis = 0; axis < 2; ++axis) {
      CAPTURE(which);
      CAPTURE(axis);
      const std::vector<double>& offsets = axis == 0 ? draws.x : draws.y;
      const double r = axis == 0 ? filter.radius_x : filter.radius_y;
      const std::vector<double> edges = CellEdges(filter, r);
      const size_t cells = edges.size() - 1;
      std::vector<double> hits(cells, 0.0), weights(cells, 0.0), squares(cells, 0.0);
      for (size_t i = 0; i < offsets.size(); ++i) {
        // Film positions are floats up to 256: offsets are off by 2^-17 at most.
        REQUIRE(std::abs(offsets[i]) <= r + 1e-5);
        const size_t above =
            size_t(std::upper_bound(edges.begin(), edges.end(), offsets[i]) - edges.begin());
        const size_t cell = std::min(std::max(above, size_t{1}), cells) - 1;
        ++hits[cell];
        weights[cell] += draws.weight[i];
        squares[cell] += draws.weight[i] * draws.weight[i];
      }

      const Share whole = Integrate(filter, r, -r, r);
      double statistic = 0;
      for (size_t cell = 0; cell < cells; ++cell) {
        const Share share = Integrate(filter, r, edges[cell], edges[cell + 1]);
        const double expected = count * share.absolute / whole.absolute;
        statistic += (hits[cell] - expected) * (hits[cell] - expected) / expected;
        // Each cell gathers its part of the filter's integral, whatever the other axis weighs.
        const double error = std::sqrt(squares[cell]) / count;
        CHECK(std::abs(weights[cell] / count - share.plain / whole.plain) < 4.5 * error);
      }
      const double freedom = double(cells) - 1;
      CHECK((statistic - freedom) / std::sqrt(2 * freedom) < 4.5);
    }
    double sum = 0, square = 0;
    for (double w : draws.weight) sum += w, square += w * w;
    CHECK(std::abs(sum / count - 1) < 1e-5 + 4.5 * std::sqrt((square / count - 1) / count));
  }
}

}  // namespace
}  // namespace swell::test
