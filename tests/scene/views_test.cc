// Filters and cameras of a scene file in, claims about their tables and matrices out.
#include "src/scene/views.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/reference/filter.h"

namespace swell::test {
namespace {

const Filter kFilters[] = {
    {FilterType::kBox, 0.5f, 2, 0, 0},
    {FilterType::kTriangle, 2, 1.25f, 0, 0},
    {FilterType::kGaussian, 1.5f, 2, 0.5f, 0},
    {FilterType::kGaussian, 4, 1, 1, 0},
    {FilterType::kMitchell, 2, 3, 1.0f / 3, 1.0f / 3},
    {FilterType::kSinc, 4, 3, 3, 0},
};

// Mean of weight * x^power over the table's distribution; of weight * [x < limit] for power < 0.
double TableMean(const std::vector<float>& q, const std::vector<float>& w, int power,
                 double limit) {
  double sum = 0;
  for (uint32_t i = 0; i < kFilterBins; ++i) {
    const double a = q[i], b = q[i + 1];
    double mean = 1;
    if (power == 1) mean = (a + b) / 2;
    if (power == 2) mean = (a * a + a * b + b * b) / 3;
    if (power < 0) mean = limit <= a ? 0 : limit >= b ? 1 : (limit - a) / (b - a);
    sum += w[i] * mean;
  }
  return sum / kFilterBins;
}

double ExactMean(const Filter& f, double r, int power, double limit) {
  constexpr int kSteps = 200000;
  double sum = 0, total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = r * (2 * (i + 0.5) / kSteps - 1);
    const double value = reference::FilterValue(f, r, x);
    total += value;
    sum += value * (power < 0 ? double(x < limit) : std::pow(x, power));
  }
  return sum / total;
}

TEST_CASE("MakeFilterTables: weighted samples have the filter's moments and distribution") {
  for (const Filter& filter : kFilters) {
    const FilterTables t = MakeFilterTables(filter);
    for (int axis = 0; axis < 2; ++axis) {
      CAPTURE(int(filter.type));
      CAPTURE(axis);
      const std::vector<float>& q = axis == 0 ? t.quantiles_x : t.quantiles_y;
      const std::vector<float>& w = axis == 0 ? t.weight_x : t.weight_y;
      const double r = axis == 0 ? filter.radius_x : filter.radius_y;
      REQUIRE(q.size() == kFilterBins + 1);
      REQUIRE(w.size() == kFilterBins);
      CHECK(q.front() == doctest::Approx(-r).epsilon(1e-7));
      CHECK(q.back() == doctest::Approx(r).epsilon(1e-7));
      for (uint32_t i = 0; i < kFilterBins; ++i) REQUIRE(q[i] <= q[i + 1]);
      CHECK(std::abs(TableMean(q, w, 0, 0) - 1) < 1e-6);
      CHECK(std::abs(TableMean(q, w, 1, 0)) < 1e-5 * r);
      // Two outermost bins of 1 / kFilterBins each, linear inside: they move by less than half.
      const double outer = 2.0 / kFilterBins * (q[1] - q[0]) * r;
      CHECK(std::abs(TableMean(q, w, 2, 0) - ExactMean(filter, r, 2, 0)) < outer + 1e-5 * r * r);
      for (double limit : {-0.9, -0.5, -0.1, 0.0, 0.3, 0.8}) {
        CHECK(std::abs(TableMean(q, w, -1, limit * r) - ExactMean(filter, r, -1, limit * r)) <
              1e-3);
      }
    }
  }
}

TEST_CASE("MakeFilterTables: the box is uniform, and filters without negative lobes weigh 1") {
  for (const Filter& filter : kFilters) {
    const FilterTables t = MakeFilterTables(filter);
    if (filter.type == FilterType::kBox) {
      for (uint32_t i = 0; i <= kFilterBins; ++i) {
        CHECK(std::abs(t.quantiles_x[i] - filter.radius_x * (2.0 * i / kFilterBins - 1)) < 1e-6);
      }
    }
    if (filter.type == FilterType::kMitchell || filter.type == FilterType::kSinc) continue;
    for (uint32_t i = 0; i < kFilterBins; ++i) {
      REQUIRE(t.weight_x[i] == doctest::Approx(1).epsilon(1e-6));
    }
  }
}

TEST_CASE("MakeFilterTables: weights of filters with negative lobes have one size and both signs") {
  for (const Filter& filter : kFilters) {
    if (filter.type != FilterType::kMitchell && filter.type != FilterType::kSinc) continue;
    const FilterTables t = MakeFilterTables(filter);
    uint32_t negative = 0, mixed = 0;
    const float size = t.weight_x[kFilterBins / 2];
    for (float weight : t.weight_x) {
      negative += weight < 0;
      mixed += std::abs(std::abs(weight) - size) > 1e-5f * size;
    }
    CHECK(negative > 10);
    CHECK(mixed <= 10);  // bins in which the filter changes its sign
    CHECK(size > 1);
  }
}

}  // namespace
}  // namespace swell::test
