// A sample in, its median, quartiles and range out.
#ifndef SWELL_BENCH_SPREAD_H_
#define SWELL_BENCH_SPREAD_H_

#include <algorithm>
#include <cstddef>
#include <vector>

namespace swell::bench {

struct Spread {
  double least, lower, median, upper, most;
};

// Of at least one value.
inline Spread SpreadOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    const double position = fraction * static_cast<double>(values.size() - 1);
    const auto i = static_cast<size_t>(position);
    const double rest = position - static_cast<double>(i);
    return rest == 0.0 ? values[i] : values[i] + rest * (values[i + 1] - values[i]);
  };
  return {at(0.0), at(0.25), at(0.5), at(0.75), at(1.0)};
}

}  // namespace swell::bench

#endif  // SWELL_BENCH_SPREAD_H_
