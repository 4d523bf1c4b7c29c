// Cameras, filters and pixels in, camera rays out: against a camera in double precision.
#include "kernels/generate_rays.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "kernels/dimensions.h"
#include "src/scene/views.h"
#include "src/wave/table.h"
#include "tests/reference/sampler.h"
#include "tests/support/probe.h"

namespace swell::test {
namespace {

using Vector = std::array<double, 3>;

constexpr uint32_t kWidth = 640, kHeight = 480, kSeed = 11, kSample = 3;

struct ReferenceRay {
  Vector org, dir;
  double weight;
};

// Concentric disk by polar coordinates (Shirley and Chiu 1997).
std::array<double, 2> Disk(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1, quarter = std::numbers::pi / 4;
  if (a == 0 && b == 0) return {0, 0};
  const double r = std::abs(a) > std::abs(b) ? a : b;
  const double phi = std::abs(a) > std::abs(b) ? quarter * b / a : 2 * quarter - quarter * a / b;
  return {r * std::cos(phi), r * std::sin(phi)};
}

ReferenceRay Reference(const Camera& camera, const FilterTables& filter, uint32_t pixel) {
  const auto invert = [](const std::vector<float>& quantiles, double u) {
    const size_t bin = size_t(u * kFilterBins);
    const double f = u * kFilterBins - double(bin);
    return quantiles[bin] * (1 - f) + quantiles[bin + 1] * f;
  };
  const reference::Pair u = reference::SamplePair(pixel, kSample, kSeed, kPairFilm);
  const double px = (pixel & 0xFFFFu) + 0.5 + invert(filter.quantiles_x, u.x);
  const double py = (pixel >> 16) + 0.5 + invert(filter.quantiles_y, u.y);
  const double weight = double{filter.weight_x[size_t(u.x * kFilterBins)]} *
                        filter.weight_y[size_t(u.y * kFilterBins)];

  // The shorter side of the screen spans [-1, 1], y up.
  const double aspect = double(kWidth) / kHeight;
  const double sx = (2 * px / kWidth - 1) * aspect, sy = 1 - 2 * py / kHeight;
  const bool perspective = camera.type == CameraType::kPerspective;
  const double scale = std::tan(camera.fov_degrees / 2 * std::numbers::pi / 180);
  Vector org = perspective ? Vector{0, 0, 0} : Vector{sx, sy, 0};
  Vector dir = perspective ? Vector{sx * scale, sy * scale, 1} : Vector{0, 0, 1};
  if (camera.lens_radius > 0) {
    const reference::Pair l = reference::SamplePair(pixel, kSample, kSeed, kPairLens);
    const std::array<double, 2> lens = Disk(l.x, l.y);
    Vector focus;
    for (int i = 0; i < 3; ++i) focus[i] = org[i] + camera.focal_distance * dir[i];
    for (int i = 0; i < 2; ++i) org[i] += camera.lens_radius * lens[i];
    for (int i = 0; i < 3; ++i) dir[i] = focus[i] - org[i];
  }
  ReferenceRay ray{{}, {}, weight};
  double length = 0;
  for (int r = 0; r < 3; ++r) {
    const float* m = &camera.camera_to_world[4 * r];
    for (int c = 0; c < 3; ++c) ray.org[r] += m[c] * org[c];
    for (int c = 0; c < 3; ++c) ray.dir[r] += m[c] * dir[c];
    ray.org[r] += m[3];
    length += ray.dir[r] * ray.dir[r];
  }
  for (double& d : ray.dir) d /= std::sqrt(length);
  return ray;
}

struct Generated {
  Table<RayFields> rays;
  Table<PathFields> paths;
  std::vector<uint32_t> pixels, slots;

  // Rays start at row `first`; slots are spread over three times as many rows.
  Generated(const CameraView& camera, const FilterTables& filter, size_t count, size_t first,
            Width width, uint32_t only_pixel = kNone)
      : rays(first + count), paths(3 * count + 1) {
    std::mt19937 random(5);
    for (size_t i = 0; i < count; ++i) {
      pixels.push_back(only_pixel != kNone
                           ? only_pixel
                           : uint32_t(random() % kWidth | random() % kHeight << 16));
      slots.push_back(uint32_t((i * 2 + 1) % (3 * count + 1)));
    }
    for (uint32_t* column : rays.Words()) std::fill_n(column, Physical(rays), kScratchWord);
    for (uint32_t* column : paths.Words()) std::fill_n(column, Physical(paths), kScratchWord);
    std::vector<uint32_t> pixel_column = pixels, slot_column = slots;
    pixel_column.resize(RoundUpToPadding(count) + kRowPadding, 0xFFFFFFFFu);
    slot_column.resize(RoundUpToPadding(count) + kRowPadding, 0xF0000000u);
    GenerateRays(
        width,
        {camera, filter.view(), kSeed, kSample, pixel_column.data(), slot_column.data(), count},
        rays.Columns(first), paths.Columns());
  }
  template <class T> static size_t Physical(const T& table) {
    return table.capacity() + kRowPadding;
  }
};

const Affine kSkewed{0.6f, 0, -0.8f, 3, 0.2f, 0.9f, 0.1f, -20, 0.8f, 0, 0.6f, 100};

std::vector<Camera> Cameras() {
  Camera pinhole;
  pinhole.fov_degrees = 47;
  pinhole.camera_to_world = kSkewed;
  Camera orthographic = pinhole;
  orthographic.type = CameraType::kOrthographic;
  Camera lens = pinhole, orthographic_lens = orthographic;
  for (Camera* camera : {&lens, &orthographic_lens}) {
    camera->lens_radius = 0.25f;
    camera->focal_distance = 7.5f;
  }
  return {pinhole, orthographic, lens, orthographic_lens};
}

TEST_CASE("GenerateRays: rays and paths equal the camera in double precision") {
  const FilterTables filter =
      MakeFilterTables({FilterType::kMitchell, 2, 1.5f, 1.0f / 3, 1.0f / 3});
  for (const Camera& camera : Cameras()) {
    const CameraView view = MakeCameraView(camera, kWidth, kHeight);
    for (size_t count : kRowCounts) {
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
        Generated g(view, filter, count, 5, width);
        const RaysIn rays = g.rays.ReadColumns(5);
        const PathsIn paths = g.paths.ReadColumns();
        for (size_t i = 0; i < count; ++i) {
          const ReferenceRay expected = Reference(camera, filter, g.pixels[i]);
          REQUIRE(std::abs(rays.org.x[i] - expected.org[0]) < 1e-6 * 100);
          REQUIRE(std::abs(rays.org.y[i] - expected.org[1]) < 1e-6 * 100);
          REQUIRE(std::abs(rays.org.z[i] - expected.org[2]) < 1e-6 * 100);
          REQUIRE(std::abs(rays.dir.x[i] - expected.dir[0]) < 1e-6);
          REQUIRE(std::abs(rays.dir.y[i] - expected.dir[1]) < 1e-6);
          REQUIRE(std::abs(rays.dir.z[i] - expected.dir[2]) < 1e-6);
          REQUIRE(rays.throughput.r[i] == doctest::Approx(expected.weight).epsilon(1e-6));
          REQUIRE(rays.throughput.g[i] == rays.throughput.r[i]);
          REQUIRE(rays.throughput.b[i] == rays.throughput.r[i]);
          REQUIRE(rays.eta_scale[i] == 1.0f);
          REQUIRE(rays.state[i] == kSpecularRay);
          const uint32_t slot = rays.path[i];
          REQUIRE(slot == g.slots[i]);
          REQUIRE(paths.pixel[slot] == g.pixels[i]);
          REQUIRE(paths.sample[slot] == kSample);
          REQUIRE(paths.radiance.r[slot] == 0.0f);
          REQUIRE(paths.radiance.g[slot] == 0.0f);
          REQUIRE(paths.radiance.b[slot] == 0.0f);
        }
      });
    }
  }
}

TEST_CASE("GenerateRays: writes its own rows of rays and paths and no others") {
  const FilterTables filter = MakeFilterTables({});
  for (size_t count : kRowCounts) {
    for (size_t first : {0, 3, 16}) {
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count,
             " from ", first);
        Generated g(MakeCameraView(Cameras()[2], kWidth, kHeight), filter, count, first, width);
        for (const uint32_t* column : g.rays.Words()) {
          for (size_t i = 0; i < Generated::Physical(g.rays); ++i) {
            if (i < first || i >= first + count) REQUIRE(column[i] == kScratchWord);
          }
        }
        std::vector<bool> used(Generated::Physical(g.paths), false);
        for (uint32_t slot : g.slots) used[slot] = true;
        for (const uint32_t* column : g.paths.Words()) {
          for (size_t i = 0; i < used.size(); ++i) {
            REQUIRE((column[i] == kScratchWord) == !used[i]);
          }
        }
      });
    }
  }
}

TEST_CASE("GenerateRays: the same bits with all lanes and with one, on all targets with FMA") {
  const FilterTables filter = MakeFilterTables({});
  for (const Camera& camera : Cameras()) {
    CheckSameBits([&](Width width) {
      Generated g(MakeCameraView(camera, kWidth, kHeight), filter, 1000, 0, width);
      std::vector<uint32_t> words;
      for (const uint32_t* column : g.rays.Words())
        words.insert(words.end(), column, column + 1000);
      return words;
    });
  }
}

TEST_CASE("GenerateRays: rays through the lens meet in the plane in focus") {
  FilterTables centre = MakeFilterTables({});
  for (auto* quantiles : {&centre.quantiles_x, &centre.quantiles_y}) {
    std::fill(quantiles->begin(), quantiles->end(), 0.0f);
  }
  Camera lens = Cameras()[2];
  lens.camera_to_world = Camera().camera_to_world;
  const CameraView view = MakeCameraView(lens, kWidth, kHeight);
  const double scale = std::tan(lens.fov_degrees / 2 * std::numbers::pi / 180);
  double spread = 0;
  for (uint32_t x : {0u, 320u, 639u}) {
    const double sx = (2 * (x + 0.5) / kWidth - 1) * kWidth / kHeight * scale;
    const double sy = (1 - 2 * 100.5 / kHeight) * scale;
    for (uint32_t sample = 0; sample < 64; ++sample) {
      Table<RayFields> rays(1);
      Table<PathFields> paths(1);
      std::vector<uint32_t> pixel(2 * kRowPadding, x | 100u << 16), slot(2 * kRowPadding, 0);
      GenerateRays(Width::kWide, {view, centre.view(), kSeed, sample, pixel.data(), slot.data(), 1},
                   rays.Columns(), paths.Columns());
      const RaysIn r = rays.ReadColumns();
      CHECK(r.org.z[0] == 0.0f);
      CHECK(std::hypot(r.org.x[0], r.org.y[0]) <= 0.25 * (1 + 1e-6));
      spread = std::max(spread, double(std::hypot(r.org.x[0], r.org.y[0])));
      const double t = 7.5 / r.dir.z[0];
      CHECK(r.org.x[0] + t * r.dir.x[0] == doctest::Approx(7.5 * sx).epsilon(2e-6));
      CHECK(r.org.y[0] + t * r.dir.y[0] == doctest::Approx(7.5 * sy).epsilon(2e-6));
    }
  }
  CHECK(spread > 0.2);
}

}  // namespace
}  // namespace swell::test
