// Crop windows and sample counts in, units of work out.
#include "src/wave/units.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

#include "kernels/columns.h"

namespace swell::test {
namespace {

// How often each sample of each pixel of the crop was handed out, or a failed check.
std::vector<int> Visits(const PixelBounds& crop, uint32_t spp, const std::vector<Unit>& units) {
  std::vector<int> visits(size_t{crop.width()} * crop.height() * spp, 0);
  for (const Unit& unit : units) {
    REQUIRE(unit.pixel_count > 0);
    REQUIRE(unit.sample_count > 0);
    REQUIRE(unit.first_sample + unit.sample_count <= spp);
    for (uint32_t p = 0; p < unit.pixel_count; ++p) {
      const uint32_t x = unit.pixels[p] & 0xFFFFu, y = unit.pixels[p] >> 16;
      REQUIRE((x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1));
      for (uint32_t s = 0; s < unit.sample_count; ++s) {
        ++visits[(size_t{y - crop.y0} * crop.width() + x - crop.x0) * spp + unit.first_sample + s];
      }
    }
  }
  return visits;
}

std::vector<Unit> TakeAll(Units& units) {
  std::vector<Unit> all;
  for (Unit unit; units.Next(unit);) all.push_back(unit);
  return all;
}

const PixelBounds kCrops[] = {
    {0, 0, 1, 1},   {0, 0, 64, 48},   {0, 0, 33, 17},
    {5, 3, 61, 40}, {15, 15, 17, 17}, {65521, 65530, 65536, 65536},
};

TEST_CASE("Units: every sample of every pixel of the crop exactly once") {
  for (const PixelBounds& crop : kCrops) {
    for (uint32_t spp : {1u, 7u, 16u, 17u, 64u}) {
      CAPTURE(crop.x0);
      CAPTURE(spp);
      Units units(crop, spp);
      const std::vector<Unit> all = TakeAll(units);
      CHECK(all.size() == units.count());
      const std::vector<int> visits = Visits(crop, spp, all);
      CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
      Unit unit;
      CHECK_FALSE(units.Next(unit));
    }
  }
}

TEST_CASE("Units: a whole vector can be read from every pixel of every unit") {
  for (const PixelBounds& crop : kCrops) {
    Units units(crop, 1);
    const std::vector<Unit> all = TakeAll(units);
    const Unit& last = *std::max_element(
        all.begin(), all.end(), [](const Unit& a, const Unit& b) { return a.pixels < b.pixels; });
    // The address sanitizer says so where the list ends too soon.
    const uint32_t* end = last.pixels + last.pixel_count;
    CHECK(std::all_of(end, end + kRowPadding, [](uint32_t pixel) { return pixel == 0; }));
  }
}

TEST_CASE("Units: many threads share them out without loss or repetition") {
  const PixelBounds crop{3, 5, 150, 130};
  for (int trial = 0; trial < 20; ++trial) {
    Units units(crop, 33);
    std::vector<std::vector<Unit>> taken(8);
    std::vector<std::thread> threads;
    for (auto& list : taken) threads.emplace_back([&] { list = TakeAll(units); });
    for (std::thread& thread : threads) thread.join();
    std::vector<Unit> all;
    for (const auto& list : taken) all.insert(all.end(), list.begin(), list.end());
    const std::vector<int> visits = Visits(crop, 33, all);
    CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
  }
}

TEST_CASE("Units: tiles lie on the frame's grid whatever the crop, and are local") {
  Units units({5, 3, 61, 40}, 4);
  for (const Unit& unit : TakeAll(units)) {
    for (uint32_t p = 1; p < unit.pixel_count; ++p) {
      CHECK((unit.pixels[p] & 0xFFFFu) / 16 == (unit.pixels[0] & 0xFFFFu) / 16);
      CHECK((unit.pixels[p] >> 16) / 16 == (unit.pixels[0] >> 16) / 16);
    }
  }
}

TEST_CASE("Units: after Cancel there is no more work, for good") {
  Units units({0, 0, 64, 64}, 64);
  Unit unit;
  REQUIRE(units.Next(unit));
  units.Cancel();
  for (int i = 0; i < 100; ++i) CHECK_FALSE(units.Next(unit));
}

}  // namespace
}  // namespace swell::test
