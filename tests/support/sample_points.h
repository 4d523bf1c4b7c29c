// Points of a sampler by value, and statistics of columns of them.
#ifndef SWELL_TESTS_SUPPORT_SAMPLE_POINTS_H_
#define SWELL_TESTS_SUPPORT_SAMPLE_POINTS_H_

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/probe.h"

namespace swell::test {

inline constexpr SamplerKind kSamplerKinds[] = {SamplerKind::kSobol, SamplerKind::kZSobol,
                                                SamplerKind::kHalton, SamplerKind::kStratified,
                                                SamplerKind::kIndependent};
static_assert(std::size(kSamplerKinds) == std::size(kSamplers));

using Column = std::vector<double>;
struct Points {
  Column x, y;
};

// What pixel, sample and pair of row i are is for `row(i, &pixel, &sample, &pair)` to say.
template <class Row>
Points DrawPoints(SamplerView view, size_t count, uint32_t seed, const Row& row) {
  WordColumns in(3, count), out(2, count);
  for (size_t i = 0; i < count; ++i) row(i, &in.Word(0, i), &in.Word(1, i), &in.Word(2, i));
  const std::vector<uint32_t*> from = in.Pointers();
  const std::vector<uint32_t*> to = out.Pointers();
  ProbeSamplerPair(Width::kWide, ProbeArgs{from.data(), to.data(), count, nullptr, seed, view});
  Points points;
  for (size_t i = 0; i < count; ++i) {
    points.x.push_back(out.Float(0, i));
    points.y.push_back(out.Float(1, i));
  }
  return points;
}

// Samples [0, count) of a pair of one pixel.
inline Points PointsOfPixel(SamplerView view, uint32_t pixel, uint32_t pair, uint32_t count,
                            uint32_t seed = 0) {
  return DrawPoints(view, count, seed, [&](size_t i, uint32_t* p, uint32_t* s, uint32_t* d) {
    *p = pixel;
    *s = uint32_t(i);
    *d = pair;
  });
}

inline double Correlation(const Column& a, const Column& b) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < a.size(); ++i) ma += a[i], mb += b[i];
  ma /= double(a.size());
  mb /= double(b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

// Pearson's statistic of points in `bins` x `bins` cells of the square, in standard deviations
// above its mean.
inline double ChiSquareExcess(const Column& x, const Column& y, int bins) {
  std::vector<double> cells(size_t(bins) * bins, 0.0);
  for (size_t i = 0; i < x.size(); ++i) {
    ++cells[size_t(x[i] * bins) * bins + size_t(y[i] * bins)];
  }
  const double expected = double(x.size()) / double(cells.size());
  double statistic = 0;
  for (double cell : cells) statistic += (cell - expected) * (cell - expected) / expected;
  const double freedom = double(cells.size()) - 1;
  return (statistic - freedom) / std::sqrt(2 * freedom);
}

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_SAMPLE_POINTS_H_
