// Paths from one and from many threads in, claims about sums, means and refusals out.
#include "src/film/film.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "src/base/available_memory.h"
#include "tests/support/natural.h"
#include "tests/support/path_columns.h"

namespace swell::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Whether `result` is a nearest float to magnitude * scale / (count * 2^64), and the even one of
// two. Midpoints between floats are doubles, and all sides are compared as whole numbers.
bool IsCorrectlyRounded(unsigned __int128 magnitude, uint64_t count, float scale, float result) {
  constexpr int kOffset = 300;  // makes every exponent below positive
  const auto with_exponent = [](Natural value, double factor, int shift) {
    int exponent;
    const double fraction = std::frexp(factor, &exponent);
    value.Multiply(static_cast<uint64_t>(std::ldexp(fraction, 53)));
    value.ShiftLeft(static_cast<unsigned>(exponent - 53 + shift));
    return value;
  };
  const Natural exact = with_exponent(Natural(magnitude), scale, kOffset);
  const auto order = [&](double bound) {  // of bound against the exact mean
    Natural product(count);
    return with_exponent(product, bound, kOffset + kFilmFractionBits).Compare(exact);
  };
  const bool even = (std::bit_cast<uint32_t>(result) & 1) == 0;
  const double above = std::isinf(std::nextafter(result, kInfinity))
                           ? std::ldexp(2.0 - std::ldexp(1.0, -24), 127)
                           : (double{result} + double{std::nextafter(result, kInfinity)}) / 2;
  const int at_above = order(above);
  if (at_above < 0 || (at_above == 0 && !even)) return false;
  if (result == 0) return true;
  const double below = (double{result} + double{std::nextafter(result, 0.0f)}) / 2;
  const int at_below = order(below);
  return at_below < 0 || (at_below == 0 && even);
}

TEST_CASE("ResolveSum: the mean is the correctly rounded one, for all magnitudes") {
  std::mt19937_64 random(1);
  const float scales[] = {1.0f,     0.01f,  100.0f,
                          1.0f / 3, 1e-30f, 1e-12f,
                          3e25f,    1e-38f, std::numeric_limits<float>::denorm_min()};
  for (int i = 0; i < 200000; ++i) {
    unsigned __int128 magnitude = static_cast<unsigned __int128>(random()) << 64 | random();
    magnitude >>= 1 + random() % 127;
    uint64_t count = random() >> (random() % 64);
    if (count == 0) count = 1;
    const float scale = scales[random() % std::size(scales)];
    const auto sum = static_cast<__int128>(magnitude);
    const float result = ResolveSum(sum, count, scale);
    if (std::isinf(result)) continue;  // beyond the floats; the next case
    const bool correct = IsCorrectlyRounded(magnitude, count, scale, result);
    if (!correct) {
      CAPTURE(double(sum));
      CAPTURE(count);
      CAPTURE(scale);
      CAPTURE(result);
      REQUIRE(correct);
    }
    REQUIRE(std::bit_cast<uint32_t>(ResolveSum(-sum, count, scale)) ==
            (sum == 0 ? 0 : std::bit_cast<uint32_t>(result) ^ 0x80000000u));
  }
}

TEST_CASE("ResolveSum: ties go to even, and one unit beside a tie does not") {
  const __int128 one = __int128{1} << 64;
  const __int128 half_ulp = __int128{1} << 40;  // of 1.0f
  CHECK(ResolveSum(one + half_ulp, 1, 1.0f) == 1.0f);
  CHECK(ResolveSum(one + half_ulp + 1, 1, 1.0f) == std::nextafter(1.0f, 2.0f));
  CHECK(ResolveSum(one + 3 * half_ulp, 1, 1.0f) == 1.0f + std::ldexp(2.0f, -23));
  CHECK(ResolveSum(one + 3 * half_ulp - 1, 1, 1.0f) == std::nextafter(1.0f, 2.0f));
  // The same tie through a division and through a scale.
  CHECK(ResolveSum(3 * (one + half_ulp), 3, 1.0f) == 1.0f);
  CHECK(ResolveSum(3 * (one + half_ulp) + 1, 3, 1.0f) == std::nextafter(1.0f, 2.0f));
  CHECK(ResolveSum((one + half_ulp) / 2, 1, 2.0f) == 1.0f);
  // Subnormal results have fewer bits.
  const float least = std::numeric_limits<float>::denorm_min();
  CHECK(ResolveSum(one, 2, least) == 0.0f);
  CHECK(ResolveSum(one + 1, 2, least) == least);
  CHECK(ResolveSum(3 * one, 2, least) == 2 * least);
  CHECK(ResolveSum(1, std::numeric_limits<uint64_t>::max(), least) == 0.0f);
}

TEST_CASE("ResolveSum: sums a hair beside a tie are rounded to their side of it") {
  std::mt19937_64 random(3);
  const auto odd = [&](int bits) {  // of exactly that many bits
    return (random() >> (64 - bits)) | uint64_t{1} << (bits - 1) | 1;
  };
  for (int i = 0; i < 20000; ++i) {
    // 25 bits, the last one set, lie in the middle between two floats.
    const uint64_t tie = odd(25), count = odd(63);
    const __int128 at_tie = static_cast<__int128>(tie) * count << (random() % 39);
    for (const __int128 sum : {at_tie - 1, at_tie, at_tie + 1}) {
      REQUIRE(IsCorrectlyRounded(sum, count, 1.0f, ResolveSum(sum, count, 1.0f)));
    }
    // The same through a scale: the products nearest to a tie, 149 bits long.
    const uint64_t factor = odd(24);
    const auto scale = static_cast<float>(factor);
    unsigned __int128 sum = 0, remainder = 0;  // of tie * 2^124 / factor
    for (int bit = 148; bit >= 0; --bit) {
      remainder = remainder << 1 | (bit >= 124 ? tie >> (bit - 124) & 1 : 0);
      sum = sum << 1 | (remainder >= factor ? 1 : 0);
      if (remainder >= factor) remainder -= factor;
    }
    for (const unsigned __int128 near : {sum, sum + 1}) {
      REQUIRE(IsCorrectlyRounded(near, 1, scale, ResolveSum(near, 1, scale)));
    }
  }
}

TEST_CASE("ResolveSum: a single sample comes back to the bit") {
  std::mt19937 random(2);
  for (int i = 0; i < 10000; ++i) {
    const float value = std::ldexp(float(random() >> 8) - 8388608.0f, int(random() % 80) - 63);
    if (std::abs(value) >= kFilmLargestSample) continue;
    const auto sum = static_cast<__int128>(std::ldexp(static_cast<long double>(value), 64));
    REQUIRE(ResolveSum(sum, 1, 1.0f) == value);
  }
}

TEST_CASE("ResolveSum: beyond the largest float is infinity, zero stays zero") {
  CHECK(ResolveSum(__int128{1} << 120, 1, 1e38f) == kInfinity);
  CHECK(ResolveSum(-(__int128{1} << 120), 1, 1e38f) == -kInfinity);
  CHECK(ResolveSum(0, 5, 1.0f) == 0.0f);
  CHECK(ResolveSum(__int128{1} << 64, 5, 0.0f) == 0.0f);
}

PathColumns RandomPaths(const PixelBounds& crop, size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.5f, 2.0f);
  PathColumns paths;
  for (size_t i = 0; i < count; ++i) {
    paths.Append(crop.x0 + random() % crop.width(), crop.y0 + random() % crop.height(),
                 normal(random), normal(random), i % 1000 == 0 ? kInfinity : normal(random));
  }
  return paths;
}

bool SameSums(const Film& a, const Film& b) {
  return a.bytes() == b.bytes() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.bytes()) == 0;
}

TEST_CASE("Film: many threads that add to the same bands give the bits of one thread") {
  // Five bands, so that every thread meets the others in each.
  const PixelBounds crop = {100, 200, 107, 270};
  constexpr size_t kThreads = 8, kPathsEach = 40000, kWave = 1000;
  const PathColumns paths = RandomPaths(crop, kThreads * kPathsEach, 1);
  std::vector<uint32_t> rows = paths.AllRows();
  Result<Film> expected = Film::Make(400, 300, crop, 4.0f);
  REQUIRE(expected);
  const uint64_t expected_dropped = expected->Add(paths.In(), rows.data(), rows.size());
  CHECK(expected_dropped == kThreads * kPathsEach / 1000);

  for (uint32_t trial = 0; trial < 3; ++trial) {
    std::mt19937 random(trial);
    std::shuffle(rows.begin(), rows.end(), random);
    Result<Film> film = Film::Make(400, 300, crop, 4.0f);
    REQUIRE(film);
    std::atomic<uint64_t> dropped{0};
    std::vector<std::thread> threads;
    for (size_t t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        for (size_t first = 0; first < kPathsEach; first += kWave) {
          dropped += film->Add(paths.In(), rows.data() + t * kPathsEach + first, kWave);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(dropped == expected_dropped);
    CHECK(SameSums(*film, *expected));
  }
}

TEST_CASE("Film: nothing to add changes nothing") {
  Result<Film> film = Film::Make(3, 2, {0, 0, 3, 2}, kInfinity);
  REQUIRE(film);
  CHECK(film->Add(PathsIn{}, nullptr, 0) == 0);
  CHECK(film->Resolve(1, 1.0f).rgb == std::vector<float>(18, 0.0f));
}

TEST_CASE("Film: a crop window holds the pixels of the full frame") {
  const PixelBounds frame = {0, 0, 50, 40}, crop = {13, 16, 31, 33};
  const PathColumns paths = RandomPaths(frame, 20000, 3);
  const std::vector<uint32_t> rows = paths.AllRows();
  std::vector<uint32_t> inside;
  for (uint32_t row : rows) {
    const uint32_t x = paths.pixel[row] & 0xFFFF, y = paths.pixel[row] >> 16;
    if (x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1) inside.push_back(row);
  }
  Result<Film> full = Film::Make(50, 40, frame, kInfinity);
  Result<Film> part = Film::Make(50, 40, crop, kInfinity);
  REQUIRE(full);
  REQUIRE(part);
  full->Add(paths.In(), rows.data(), rows.size());
  part->Add(paths.In(), inside.data(), inside.size());

  const Image full_image = full->Resolve(10, 2.0f), part_image = part->Resolve(10, 2.0f);
  CHECK(part_image.width == 18);
  CHECK(part_image.height == 17);
  for (uint32_t y = 0; y < crop.height(); ++y) {
    const float* expected = &full_image.rgb[3 * (50 * (crop.y0 + y) + crop.x0)];
    REQUIRE(std::memcmp(&part_image.rgb[3 * 18 * y], expected, 18 * 3 * sizeof(float)) == 0);
  }
}

TEST_CASE("Film: Resolve is the sum over samples times the scale") {
  Result<Film> film = Film::Make(2, 1, {0, 0, 2, 1}, kInfinity);
  REQUIRE(film);
  PathColumns paths;
  paths.Append(0, 0, 1.0f, -2.0f, 0.25f);
  paths.Append(0, 0, 2.0f, 1.0f, 0.0f);
  paths.Append(1, 0, 1.0f, 0.0f, 8.0f);
  paths.Append(1, 0, 1.0f, 0.0f, 0.0f);
  const std::vector<uint32_t> rows = paths.AllRows();
  film->Add(paths.In(), rows.data(), rows.size());
  const Image image = film->Resolve(2, 4.0f);
  CHECK(image.rgb == std::vector<float>{6.0f, -2.0f, 0.5f, 4.0f, 0.0f, 16.0f});
}

TEST_CASE("Film: frames and crop windows without meaning are refused in one line") {
  const struct {
    uint32_t width, height;
    PixelBounds crop;
  } cases[] = {
      {0, 10, {0, 0, 0, 10}},     {10, 0, {0, 0, 10, 0}},   {65537, 1, {0, 0, 1, 1}},
      {1, 65537, {0, 0, 1, 1}},   {10, 10, {3, 0, 3, 10}},  {10, 10, {0, 7, 10, 7}},
      {10, 10, {5, 0, 4, 10}},    {10, 10, {0, 0, 11, 10}}, {10, 10, {0, 0, 10, 11}},
      {10, 10, {10, 10, 20, 20}},
  };
  for (const auto& c : cases) {
    CAPTURE(c.width);
    CAPTURE(c.crop.x1);
    const Result<Film> film = Film::Make(c.width, c.height, c.crop, kInfinity);
    REQUIRE_FALSE(film);
    CHECK(film.error().message.find('\n') == std::string::npos);
    CHECK(film.error().message.find(';') != std::string::npos);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("Film: what memory cannot hold is refused with its size and a remedy") {
  // The address space is limited as well, so that machines of any size refuse; the smaller film
  // passes the look at free memory where 1.5 GiB are free, and then the allocation fails.
  rlimit before;
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  rlimit limit = before;
  limit.rlim_cur = rlim_t{1} << 30;
  REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
  const Result<Film> huge = Film::Make(65536, 65536, {0, 0, 65536, 65536}, kInfinity);
  const Result<Film> large = Film::Make(5000, 5000, {0, 0, 5000, 5000}, kInfinity);
  REQUIRE(setrlimit(RLIMIT_AS, &before) == 0);

  REQUIRE_FALSE(huge);
  CHECK(huge.error().message.find("65536x65536 pixels needs 240.0 GiB") != std::string::npos);
  CHECK(huge.error().message.find("--cropwindow") != std::string::npos);
  REQUIRE_FALSE(large);
  CHECK(large.error().message.find("5000x5000 pixels needs 1.4 GiB") != std::string::npos);
  CHECK(large.error().message.find("--resolution") != std::string::npos);
}
#endif

}  // namespace
}  // namespace swell::test
