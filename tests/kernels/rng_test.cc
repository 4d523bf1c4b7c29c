// Pixels, samples, pairs and seeds in, claims about the sampler's points out.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernels/dimensions.h"
#include "tests/reference/sampler.h"
#include "tests/support/sample_points.h"

namespace swell::test {
namespace {

WordColumns RunPairs(Width width, const WordColumns& in, uint32_t seed) {
  return RunProbe(ProbeSamplerPair, width, in, 2, nullptr, seed);
}

// Samples [first, first + count) of one pair.
WordColumns PairOfPixel(uint32_t pixel, uint32_t pair, uint32_t first, uint32_t count,
                        uint32_t seed) {
  WordColumns in(3, count);
  for (uint32_t i = 0; i < count; ++i) {
    in.Word(0, i) = pixel;
    in.Word(1, i) = first + i;
    in.Word(2, i) = pair;
  }
  return RunPairs(Width::kWide, in, seed);
}

TEST_CASE("Sobol lanes: equal the bit-by-bit reference on every target") {
  std::mt19937 random(1);
  for (size_t count : kRowCounts) {
    WordColumns in(2, count);
    for (size_t i = 0; i < count; ++i) {
      in.Word(0, i) = i < 4 ? uint32_t(i) - 2 : uint32_t(random());
      in.Word(1, i) = uint32_t(random());
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", rows: ", count);
      const WordColumns out = RunProbe(ProbeSobol, width, in, 3);
      for (size_t i = 0; i < count; ++i) {
        const uint32_t word = in.Word(0, i);
        CHECK(out.Word(0, i) == reference::ReverseBits(word));
        CHECK(out.Word(1, i) == reference::ScrambleReversed(word, in.Word(1, i)));
        // Bit j of the index is bit 31 - j of the point; the kernel keeps points reversed.
        CHECK(out.Word(2, i) == reference::ReverseBits(reference::SobolSecond(word)));
      }
    });
  }
}

TEST_CASE("ScrambleReversed: a bit depends on the bits below it alone, and always on itself") {
  std::mt19937 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const uint32_t word = uint32_t(random()), seed = uint32_t(random());
    const uint32_t scrambled = reference::ScrambleReversed(word, seed);
    for (int bit = 0; bit < 32; ++bit) {
      const uint32_t changed = scrambled ^ reference::ScrambleReversed(word ^ 1u << bit, seed);
      REQUIRE((changed & ((1u << bit) - 1)) == 0);
      REQUIRE((changed >> bit & 1u) == 1);
    }
  }
}

TEST_CASE("Sampler: pairs equal the scalar reference to the bit on every target") {
  std::mt19937 random(3);
  for (uint32_t seed : {0u, 1u, 0xFFFFFFFFu}) {
    for (size_t count : kRowCounts) {
      WordColumns in(3, count);
      for (size_t i = 0; i < count; ++i) {
        in.Word(0, i) = uint32_t(random());
        in.Word(1, i) = i % 2 != 0 ? uint32_t(random()) : uint32_t(i);
        in.Word(2, i) = uint32_t(random() % 100);
      }
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", rows: ", count);
        const WordColumns out = RunPairs(width, in, seed);
        for (size_t i = 0; i < count; ++i) {
          const reference::Pair pair =
              reference::SamplePair(in.Word(0, i), in.Word(1, i), seed, in.Word(2, i));
          CHECK(out.Float(0, i) == pair.x);
          CHECK(out.Float(1, i) == pair.y);
        }
      });
    }
  }
}

TEST_CASE("Sampler: every elementary interval holds exactly one of each block of 2^k points") {
  for (uint32_t pixel : {0u, 1u, 37u | 99u << 16, 65535u | 65535u << 16}) {
    for (uint32_t pair : {kPairFilm, kPairLens, kPairFirstBounce + kPairLightPoint, 41u}) {
      for (uint32_t k = 0; k <= 10; ++k) {
        for (uint32_t block : {0u, 1u, 5u}) {
          const uint32_t count = 1u << k;
          const WordColumns points = PairOfPixel(pixel, pair, block * count, count, 7);
          for (uint32_t a = 0; a <= k; ++a) {
            const uint32_t columns = 1u << a, rows = 1u << (k - a);
            std::vector<int> hits(count, 0);
            for (uint32_t i = 0; i < count; ++i) {
              ++hits[uint32_t(points.Float(0, i) * float(columns)) * rows +
                     uint32_t(points.Float(1, i) * float(rows))];
            }
            REQUIRE((hits == std::vector<int>(count, 1)));
          }
        }
      }
    }
  }
}

TEST_CASE("Sampler: one sample over all pixels is uniform, and neighbours are independent") {
  constexpr uint32_t kSide = 256;
  for (uint32_t sample : {0u, 1u, 64u}) {
    WordColumns in(3, kSide * kSide);
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      in.Word(0, i) = i % kSide | i / kSide << 16;
      in.Word(1, i) = sample;
      in.Word(2, i) = kPairFilm;
    }
    const WordColumns out = RunPairs(Width::kWide, in, 0);
    std::vector<double> x, y, right_x, below_x, other_seed;
    const WordColumns reseeded = RunPairs(Width::kWide, in, 1);
    for (uint32_t i = 0; i + kSide < kSide * kSide; ++i) {
      x.push_back(out.Float(0, i));
      y.push_back(out.Float(1, i));
      right_x.push_back(out.Float(0, i + 1));
      below_x.push_back(out.Float(0, i + kSide));
      other_seed.push_back(reseeded.Float(0, i));
    }
    for (const std::vector<double>* other : {&y, &right_x, &below_x, &other_seed}) {
      CHECK(std::abs(Correlation(x, *other)) < 4 / std::sqrt(double(x.size())));
      CHECK(std::abs(ChiSquareExcess(x, *other, 32)) < 4);
    }
  }
}

TEST_CASE("Sampler: pairs of a pixel, and pixels and seeds of a pair, are independent") {
  constexpr uint32_t kCount = 4096;
  const auto column = [](const WordColumns& points, size_t c) {
    std::vector<double> values;
    for (size_t i = 0; i < points.count(); ++i) values.push_back(points.Float(c, i));
    return values;
  };
  const WordColumns base = PairOfPixel(5, 2, 0, kCount, 0);
  const WordColumns others[] = {
      PairOfPixel(5, 3, 0, kCount, 0), PairOfPixel(5, 6, 0, kCount, 0),
      PairOfPixel(6, 2, 0, kCount, 0), PairOfPixel(5 | 1 << 16, 2, 0, kCount, 0),
      PairOfPixel(5, 2, 0, kCount, 1), PairOfPixel(5, 2, 0, kCount, 0x80000000u),
  };
  for (const WordColumns& other : others) {
    for (size_t a : {0, 1}) {
      for (size_t b : {0, 1}) {
        const std::vector<double> x = column(base, a), y = column(other, b);
        CHECK(std::abs(Correlation(x, y)) < 4 / std::sqrt(double(kCount)));
        // Halves only: finer cells see the strata, which points of one sequence fill in turn.
        CHECK(std::abs(ChiSquareExcess(x, y, 2)) < 4);
      }
    }
  }
}

}  // namespace
}  // namespace swell::test
