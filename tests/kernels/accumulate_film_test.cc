// Paths of all magnitudes in, claims about the film's integer sums out.
#include "kernels/accumulate_film.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/path_columns.h"

namespace swell::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

__int128 Sum(const FilmPixel& pixel, int channel) {
  return static_cast<__int128>(static_cast<unsigned __int128>(pixel.high[channel]) << 64 |
                               pixel.low[channel]);
}

// Units of the quantum in one value: scaling a float by 2^64 and rounding halves away from zero are
// exact in long double.
__int128 Units(float value) {
  return static_cast<__int128>(std::round(std::ldexp(static_cast<long double>(value), 64)));
}

// Finite, of every magnitude that the film takes, both signs.
float AnySample(std::mt19937& random) {
  for (;;) {
    const float value = std::bit_cast<float>(static_cast<uint32_t>(random()));
    if (std::abs(value) < kFilmLargestSample) return value;
  }
}

struct OnePixel {
  FilmPixel pixel = {};
  uint64_t dropped = 0;

  explicit OnePixel(const PathColumns& paths, float max_component = kInfinity)
      : OnePixel(paths, paths.AllRows(), max_component) {}
  OnePixel(const PathColumns& paths, const std::vector<uint32_t>& rows, float max_component) {
    const FilmView film = {&pixel, 0, 0, 1, max_component};
    dropped = AccumulateFilm(paths.In(), rows.data(), rows.size(), film);
  }
};

TEST_CASE("AccumulateFilm: sums equal the oracle's integers for values of every magnitude") {
  std::mt19937 random(1);
  for (size_t count : {0, 1, 7, 16, 17, 1000, 100000}) {
    CAPTURE(count);
    PathColumns paths;
    __int128 expected[3] = {};
    for (size_t i = 0; i < count; ++i) {
      const float rgb[3] = {AnySample(random), AnySample(random), AnySample(random)};
      paths.Append(0, 0, rgb[0], rgb[1], rgb[2]);
      for (int c = 0; c < 3; ++c) expected[c] += Units(rgb[c]);
    }
    const OnePixel film(paths);
    CHECK(film.dropped == 0);
    for (int c = 0; c < 3; ++c) CHECK((Sum(film.pixel, c) == expected[c]));
  }
}

TEST_CASE("AccumulateFilm: a value is exact from 2^-41 on and rounded to the quantum below") {
  const struct {
    float value;
    __int128 units;
  } cases[] = {
      {1.0f, __int128{1} << 64},
      {-1.0f, -(__int128{1} << 64)},
      {std::nextafter(kFilmLargestSample, 0.0f), ((__int128{1} << 24) - 1) << 80},
      {std::ldexp(16777215.0f, -64), 16777215},  // the finest float that is a multiple
      {std::ldexp(1.0f, -64), 1},
      {std::ldexp(1.0f, -65), 1},  // halves go away from zero
      {std::ldexp(-1.0f, -65), -1},
      {std::ldexp(3.0f, -65), 2},
      {std::nextafter(std::ldexp(1.0f, -65), 0.0f), 0},
      {std::ldexp(1.0f, -100), 0},
      {std::numeric_limits<float>::denorm_min(), 0},
      {0.0f, 0},
      {-0.0f, 0},
  };
  for (const auto& c : cases) {
    const float value = c.value;
    const __int128 units = c.units;
    CAPTURE(value);
    PathColumns paths;
    paths.Append(0, 0, value, -value, 0.0f);
    const OnePixel film(paths);
    CHECK((Sum(film.pixel, 0) == units));
    CHECK((Sum(film.pixel, 1) == -units));
    CHECK((Sum(film.pixel, 2) == 0));
  }
}

TEST_CASE("AccumulateFilm: any order of adding gives the same bits") {
  std::mt19937 random(2);
  PathColumns paths;
  for (int i = 0; i < 20000; ++i) {
    paths.Append(random() % 5, random() % 3, AnySample(random), AnySample(random), 0.1f);
  }
  std::vector<uint32_t> rows = paths.AllRows();
  const auto accumulate = [&] {
    std::vector<FilmPixel> pixels(15, FilmPixel{});
    AccumulateFilm(paths.In(), rows.data(), rows.size(), {pixels.data(), 0, 0, 5, kInfinity});
    return pixels;
  };
  const std::vector<FilmPixel> expected = accumulate();
  for (int trial = 0; trial < 5; ++trial) {
    std::shuffle(rows.begin(), rows.end(), random);
    const std::vector<FilmPixel> pixels = accumulate();
    CHECK(std::memcmp(pixels.data(), expected.data(), sizeof(FilmPixel) * pixels.size()) == 0);
  }
}

TEST_CASE("AccumulateFilm: a value and its negative cancel whatever is between them") {
  std::mt19937 random(3);
  PathColumns paths;
  for (int i = 0; i < 1000; ++i) {
    const float value = AnySample(random);
    paths.Append(0, 0, value, value, 1e12f);
    paths.Append(0, 0, -value, -value, -1e12f);
  }
  std::vector<uint32_t> rows = paths.AllRows();
  std::shuffle(rows.begin(), rows.end(), random);
  const OnePixel film(paths, rows, kInfinity);
  for (int c = 0; c < 3; ++c) CHECK((Sum(film.pixel, c) == 0));
}

TEST_CASE("AccumulateFilm: a bad value in any channel drops the whole sample and counts it") {
  for (float bad : {std::nanf(""), -std::nanf(""), kInfinity, -kInfinity, kFilmLargestSample,
                    -kFilmLargestSample, std::numeric_limits<float>::max()}) {
    for (int channel = 0; channel < 3; ++channel) {
      CAPTURE(bad);
      CAPTURE(channel);
      float rgb[3] = {1, 2, 3};
      rgb[channel] = bad;
      PathColumns paths;
      paths.Append(0, 0, 4, 5, 6);
      paths.Append(0, 0, rgb[0], rgb[1], rgb[2]);
      const OnePixel film(paths, /*max_component=*/10.0f);
      CHECK(film.dropped == 1);
      for (int c = 0; c < 3; ++c) CHECK((Sum(film.pixel, c) == Units(4.0f + float(c))));
    }
  }
}

TEST_CASE("AccumulateFilm: max_component scales a sample so that its largest channel is that") {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (int i = 0; i < 1000; ++i) {
    const float limit = 10 * uniform(random);
    const float largest = limit * (1 + uniform(random)) + 1e-3f;
    const float small = largest * uniform(random);
    const float negative = -3 * largest;
    PathColumns paths;
    paths.Append(0, 0, small, largest, negative);
    const OnePixel film(paths, limit);
    CHECK((Sum(film.pixel, 1) == Units(limit)));
    const double scale = double{limit} / largest;
    const double unit = std::ldexp(1.0, -64);
    CHECK(double(Sum(film.pixel, 0)) * unit == doctest::Approx(small * scale).epsilon(1e-7));
    CHECK(double(Sum(film.pixel, 2)) * unit == doctest::Approx(negative * scale).epsilon(1e-7));
  }
}

TEST_CASE("AccumulateFilm: samples up to max_component are added unchanged") {
  PathColumns paths;
  paths.Append(0, 0, 0.1f, -7.0f, 5.0f);
  const OnePixel film(paths, 5.0f);
  CHECK((Sum(film.pixel, 0) == Units(0.1f)));
  CHECK((Sum(film.pixel, 1) == Units(-7.0f)));
  CHECK((Sum(film.pixel, 2) == Units(5.0f)));
}

TEST_CASE("AccumulateFilm: selected rows land on their pixel of the crop window, others nowhere") {
  PathColumns paths;
  for (uint32_t y = 7; y < 9; ++y) {
    for (uint32_t x = 65533; x < 65536; ++x) paths.Append(x, y, float(x), float(y), 1.0f);
  }
  std::vector<FilmPixel> pixels(6, FilmPixel{});
  const uint32_t rows[] = {5, 0, 1, 5};
  CHECK(AccumulateFilm(paths.In(), rows, 4, {pixels.data(), 65533, 7, 3, kInfinity}) == 0);
  const int visits[6] = {1, 1, 0, 0, 0, 2};
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    CHECK((Sum(pixels[i], 0) == visits[i] * Units(float(65533 + i % 3))));
    CHECK((Sum(pixels[i], 1) == visits[i] * Units(float(7 + i / 3))));
    CHECK((Sum(pixels[i], 2) == visits[i] * Units(1.0f)));
  }
}

}  // namespace
}  // namespace swell::test
