// Samplers, pixels, samples and pairs in, claims about the points out.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "kernels/dimensions.h"
#include "kernels/samplers/tables.h"
#include "tests/support/sample_points.h"

namespace swell::test {
namespace {

// Pairs of a path of six bounces, the deepest that pbrt's default depth draws for.
constexpr uint32_t kPathPairs = kPairFirstBounce + 6 * kPairsPerBounce;

// How many points each of `columns` x `rows` cells holds.
std::vector<int> CellCounts(const Points& points, uint32_t columns, uint32_t rows) {
  std::vector<int> counts(size_t(columns) * rows, 0);
  for (size_t i = 0; i < points.x.size(); ++i) {
    ++counts[size_t(points.x[i] * columns) * rows + size_t(points.y[i] * rows)];
  }
  return counts;
}
bool AllOne(const std::vector<int>& counts) {
  return std::all_of(counts.begin(), counts.end(), [](int c) { return c == 1; });
}
bool IsNet(const Points& points, uint32_t log2_count) {
  for (uint32_t a = 0; a <= log2_count; ++a) {
    if (!AllOne(CellCounts(points, 1u << a, 1u << (log2_count - a)))) return false;
  }
  return true;
}

Points Append(Points a, const Points& b) {
  a.x.insert(a.x.end(), b.x.begin(), b.x.end());
  a.y.insert(a.y.end(), b.y.begin(), b.y.end());
  return a;
}

TEST_CASE("samplers: points have the same bits on every target and width, within [0, 1)") {
  std::mt19937 random(4);
  for (SamplerKind kind : kSamplerKinds) {
    for (uint32_t samples : {1u, 7u, 64u, 1u << 22}) {
      for (size_t count : kRowCounts) {
        WordColumns in(3, count);
        for (size_t i = 0; i < count; ++i) {
          in.Word(0, i) = uint32_t(random());
          in.Word(1, i) = uint32_t(random()) % samples;
          in.Word(2, i) = uint32_t(random()) % 150;
        }
        INFO(kSamplers[size_t(kind)].name, ", samples: ", samples, ", rows: ", count);
        CheckSameBits([&](Width width) {
          WordColumns copy = in, out(2, count);
          const std::vector<uint32_t*> from = copy.Pointers();
          const std::vector<uint32_t*> to = out.Pointers();
          ProbeSamplerPair(width, {from.data(), to.data(), count, nullptr, 9, {kind, samples}});
          for (size_t i = 0; i < count; ++i) {
            for (size_t c : {0, 1}) REQUIRE((out.Float(c, i) >= 0 && out.Float(c, i) < 1));
          }
          return out.Rows();
        });
      }
    }
  }
}

TEST_CASE("samplers: every pair of a path is uniform over the square") {
  std::mt19937 random(5);
  for (SamplerKind kind : kSamplerKinds) {
    for (uint32_t samples : {1u, 13u, 64u}) {
      for (uint32_t pair = 0; pair < kPathPairs; ++pair) {
        INFO(kSamplers[size_t(kind)].name, ", samples: ", samples, ", pair: ", pair);
        const Points points = DrawPoints({kind, samples}, 1 << 16, 3,
                                         [&](size_t, uint32_t* p, uint32_t* s, uint32_t* d) {
                                           *p = uint32_t(random()) & 0x07FF07FFu;
                                           *s = uint32_t(random()) % samples;
                                           *d = pair;
                                         });
        CHECK(ChiSquareExcess(points.x, points.y, 32) < 4.5);
      }
    }
  }
}

TEST_CASE("samplers: dimensions that a path uses together are independent") {
  constexpr size_t kRows = 1 << 14;
  constexpr uint32_t kSamples = 64;
  for (SamplerKind kind : kSamplerKinds) {
    std::vector<Column> columns;
    for (uint32_t pair = 0; pair < 14; ++pair) {
      std::mt19937 random(6);  // the same rows for each pair
      Points points = DrawPoints({kind, kSamples}, kRows, 0,
                                 [&](size_t, uint32_t* p, uint32_t* s, uint32_t* d) {
                                   *p = uint32_t(random()) & 0x00FF00FFu;
                                   *s = uint32_t(random()) % kSamples;
                                   *d = pair;
                                 });
      columns.push_back(std::move(points.x));
      columns.push_back(std::move(points.y));
    }
    for (size_t a = 0; a < columns.size(); ++a) {
      for (size_t b = a + 1; b < columns.size(); ++b) {
        INFO(kSamplers[size_t(kind)].name, ", dimensions: ", a, " ", b);
        CHECK(std::abs(Correlation(columns[a], columns[b])) < 4.5 / std::sqrt(double(kRows)));
        CHECK(ChiSquareExcess(columns[a], columns[b], 8) < 5);
      }
    }
  }
}

TEST_CASE("samplers: seeds, and pixels of all but zsobol, are independent") {
  constexpr uint32_t kSide = 128;
  for (SamplerKind kind : kSamplerKinds) {
    INFO(kSamplers[size_t(kind)].name);
    const auto picture = [&](uint32_t seed, uint32_t shift) {
      return DrawPoints({kind, 16}, kSide * kSide, seed,
                        [&](size_t i, uint32_t* p, uint32_t* s, uint32_t* d) {
                          *p = (uint32_t(i) % kSide + shift) | uint32_t(i) / kSide << 16;
                          *s = 5;
                          *d = kPairFilm;
                        });
    };
    const Points base = picture(0, 0);
    for (const Points& other : {picture(1, 0), picture(0x80000000u, 0), picture(0, 1)}) {
      if (kind == SamplerKind::kZSobol && &other.x != &base.x && other.x[0] == base.x[1]) {
        continue;  // neighbours of zsobol share out the strata
      }
      CHECK(std::abs(Correlation(base.x, other.x)) < 4.5 / kSide);
      CHECK(std::abs(Correlation(base.y, other.y)) < 4.5 / kSide);
      CHECK(ChiSquareExcess(base.x, other.x, 16) < 5);
    }
  }
}

TEST_CASE("zsobol: the samples of each pixel and of each block of 2^n x 2^n pixels are a net") {
  for (uint32_t log2_samples = 0; log2_samples <= 9; ++log2_samples) {
    const uint32_t samples = 1u << log2_samples;
    const SamplerView view{SamplerKind::kZSobol, samples};
    for (uint32_t pair : {kPairFilm, kPairFirstBounce, 41u}) {
      for (uint32_t side = 1, log2_count = log2_samples; log2_count <= 10;
           side *= 2, log2_count += 2) {
        INFO("samples: ", samples, ", pair: ", pair, ", side: ", side);
        const uint32_t corner_x = 40 * side, corner_y = 7 * side;
        Points points;
        for (uint32_t i = 0; i < side * side; ++i) {
          const uint32_t pixel = (corner_x + i % side) | (corner_y + i / side) << 16;
          points = Append(std::move(points), PointsOfPixel(view, pixel, pair, samples, 3));
        }
        REQUIRE(IsNet(points, log2_count));
      }
    }
  }
}

// Likewise, where points that lie on an edge may have been rounded to its other side: cells by
// rank, and each point within its cell but for rounding.
std::vector<int> RankedCellCounts(const Points& points, uint32_t columns, uint32_t rows) {
  constexpr double kRounding = 0x1p-22;
  const size_t count = points.x.size();
  const auto strata = [&](const Column& values, uint32_t size) {
    std::vector<size_t> order(count), stratum(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return values[a] < values[b]; });
    for (size_t rank = 0; rank < count; ++rank) {
      stratum[order[rank]] = rank / (count / size);
      const double low = double(stratum[order[rank]]) / size;
      REQUIRE(values[order[rank]] > low - kRounding);
      REQUIRE(values[order[rank]] < low + 1.0 / size + kRounding);
    }
    return stratum;
  };
  const std::vector<size_t> column = strata(points.x, columns), row = strata(points.y, rows);
  std::vector<int> counts(size_t(columns) * rows, 0);
  for (size_t i = 0; i < count; ++i) ++counts[column[i] * rows + row[i]];
  return counts;
}

TEST_CASE("halton: bases are the primes in turn") {
  CHECK(kPrimeTable.prime[0] == 2);
  CHECK(kPrimeTable.prime[1] == 3);
  CHECK(kPrimeTable.prime[25] == 101);
  CHECK(kPrimeTable.prime[255] == 1619);
}

TEST_CASE(
    "halton: b^m samples have one in each interval of b^-m, pairs in each box of both bases") {
  for (uint32_t pixel : {0u, 5u | 9u << 16}) {
    for (uint32_t pair : {0u, 1u, 2u, 5u, 12u}) {
      const uint32_t bx = kPrimeTable.prime[2 * pair], by = kPrimeTable.prime[2 * pair + 1];
      for (uint32_t columns = 1; columns <= 1024; columns *= bx) {
        for (uint32_t rows = 1; rows <= 1024 && columns * rows <= 4096; rows *= by) {
          const uint32_t count = columns * rows;
          INFO("pair: ", pair, ", columns: ", columns, ", rows: ", rows);
          const Points points = PointsOfPixel({SamplerKind::kHalton, count}, pixel, pair, count, 1);
          REQUIRE(AllOne(RankedCellCounts(points, columns, rows)));
          // The first of more samples are strata of their own as well.
          const Points more =
              PointsOfPixel({SamplerKind::kHalton, 4 * count + 1}, pixel, pair, count, 1);
          REQUIRE(AllOne(RankedCellCounts(more, columns, rows)));
        }
      }
    }
  }
}

TEST_CASE("stratified: no cell of the grid holds two samples, and none is empty if they fill it") {
  for (uint32_t count : {1u, 2u, 3u, 7u, 12u, 16u, 17u, 63u, 64u, 100u, 1000u, 4096u}) {
    const uint32_t columns = uint32_t(std::sqrt(double(count)));
    const uint32_t rows = (count + columns - 1) / columns;
    for (uint32_t pixel : {0u, 1u, 77u | 5u << 16}) {
      for (uint32_t pair : {0u, 3u, 40u}) {
        INFO("samples: ", count, ", pixel: ", pixel, ", pair: ", pair);
        const Points points =
            PointsOfPixel({SamplerKind::kStratified, count}, pixel, pair, count, 2);
        const std::vector<int> cells = CellCounts(points, columns, rows);
        REQUIRE(*std::max_element(cells.begin(), cells.end()) == 1);
      }
    }
  }
}

TEST_CASE("stratified: two samples of a pixel take any two cells equally likely") {
  for (uint32_t count : {2u, 3u, 4u, 7u, 9u, 16u}) {
    const uint32_t columns = uint32_t(std::sqrt(double(count)));
    const uint32_t rows = (count + columns - 1) / columns, cells = columns * rows;
    constexpr uint32_t kPixels = 1 << 15;
    std::vector<uint32_t> cell[2];
    for (uint32_t sample : {0u, count - 1}) {
      const Points points = DrawPoints({SamplerKind::kStratified, count}, kPixels, 0,
                                       [&](size_t i, uint32_t* p, uint32_t* s, uint32_t* d) {
                                         *p = uint32_t(i);
                                         *s = sample;
                                         *d = 2;
                                       });
      for (uint32_t i = 0; i < kPixels; ++i) {
        cell[sample != 0].push_back(uint32_t(points.x[i] * columns) * rows +
                                    uint32_t(points.y[i] * rows));
      }
    }
    std::vector<double> hits(size_t(cells) * cells, 0.0);
    for (uint32_t i = 0; i < kPixels; ++i) ++hits[cell[0][i] * cells + cell[1][i]];
    const double expected = double(kPixels) / (cells * (cells - 1));
    double statistic = 0;
    for (uint32_t a = 0; a < cells; ++a) {
      for (uint32_t b = 0; b < cells; ++b) {
        const double h = hits[a * cells + b];
        if (a == b) CHECK(h == 0);
        if (a != b) statistic += (h - expected) * (h - expected) / expected;
      }
    }
    const double freedom = std::max(1.0, double(cells) * (cells - 1) - 1);
    INFO("samples: ", count);
    CHECK((statistic - freedom) / std::sqrt(2 * freedom) < 4.5);
  }
}

// Root mean square of the errors of a pixel's estimate of the integral of exp(x) sin(pi y) over one
// pair or over several, multiplied, and their mean in standard errors.
struct Convergence {
  double rms, bias;
};
Convergence EstimateSmooth(SamplerKind kind, uint32_t samples, uint32_t first_pair, int pairs) {
  constexpr uint32_t kPixels = 512;
  const double factor = (std::exp(1.0) - 1) * 2 / 3.14159265358979;
  double square = 0, sum = 0;
  for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    std::vector<double> values(samples, 1.0);
    for (int pair = 0; pair < pairs; ++pair) {
      const Points points = PointsOfPixel({kind, samples}, pixel % 32 | pixel / 32 << 16,
                                          first_pair + uint32_t(pair), samples, 8);
      for (uint32_t i = 0; i < samples; ++i) {
        values[i] *= std::exp(points.x[i]) * std::sin(3.14159265358979 * points.y[i]);
      }
    }
    double mean = 0;
    for (double v : values) mean += v / samples;
    const double error = mean - std::pow(factor, pairs);
    square += error * error / kPixels;
    sum += error;
  }
  return {std::sqrt(square), sum / (std::sqrt(square) * std::sqrt(double(kPixels)))};
}

TEST_CASE("samplers: the error of a smooth integrand falls as each promises, without bias") {
  const struct {
    SamplerKind kind;
    double at_least, at_most;  // slope of log error over log samples
  } kSlopes[] = {{SamplerKind::kSobol, -1.7, -1.3},
                 {SamplerKind::kZSobol, -1.7, -1.3},
                 {SamplerKind::kHalton, -1.7, -1.0},
                 {SamplerKind::kStratified, -1.15, -0.85},
                 {SamplerKind::kIndependent, -0.55, -0.45}};
  for (const auto& row : kSlopes) {
    INFO(kSamplers[size_t(row.kind)].name);
    const Convergence few = EstimateSmooth(row.kind, 16, 0, 1);
    const Convergence many = EstimateSmooth(row.kind, 1024, 0, 1);
    const double slope = std::log(many.rms / few.rms) / std::log(1024.0 / 16);
    CHECK(slope > row.at_least);
    CHECK(slope < row.at_most);
    CHECK(std::abs(few.bias) < 4);
    if (row.kind != SamplerKind::kZSobol) CHECK(std::abs(many.bias) < 4);
  }
}

TEST_CASE("samplers: two pairs together are no worse than independent numbers, at any count") {
  for (uint32_t samples : {4u, 13u, 64u, 100u}) {
    const double independent = EstimateSmooth(SamplerKind::kIndependent, samples, 2, 2).rms;
    for (SamplerKind kind : kSamplerKinds) {
      INFO(kSamplers[size_t(kind)].name, ", samples: ", samples);
      const Convergence c = EstimateSmooth(kind, samples, 2, 2);
      CHECK(c.rms < 1.1 * independent);
      CHECK(std::abs(c.bias) < 4);
    }
  }
}

}  // namespace
}  // namespace swell::test
