// Light through media: what is left is exp(-absorption times distance), on every target.
#include "kernels/absorb_light.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kAbsorption[] = {0, 0, 0, 0.5f, 2.0f, 0.0f, 1e-3f, 40.0f, 7.0f};

struct Lights {
  explicit Lights(size_t count)
      : medium(count + kRowPadding),
        path(medium.size()),
        distance(medium.size()),
        nearest(medium.size()),
        x(medium.size()),
        y(medium.size()),
        z(medium.size()) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.01f, 3.0f);
    for (size_t i = 0; i < count; ++i) {
      medium[i] = static_cast<uint32_t>(random() % 3);
      path[i] = static_cast<uint32_t>((i * 7) % count);
      distance[i] = i % 11 == 0 ? kInfinity : uniform(random);
      nearest[i] = i % 5 == 0 ? kInfinity : uniform(random);
      x[i] = uniform(random);
      y[i] = -uniform(random);
      z[i] = uniform(random);
    }
    for (auto& channel : light) {
      channel.resize(medium.size());
      for (float& value : channel) value = uniform(random);
    }
  }
  RgbFields<Out> Out3() { return {light[0].data(), light[1].data(), light[2].data()}; }

  std::vector<uint32_t> medium, path;
  std::vector<float> distance, nearest, x, y, z;
  std::vector<float> light[3];
};

}  // namespace

TEST_CASE("AbsorbLight: Beer's law, by channel; infinite ways leave only what nothing absorbs") {
  for (const size_t count : kRowCounts) {
    ForEachTarget([&](const char* target, Width width) {
      CAPTURE(target);
      CAPTURE(count);
      const Lights before(count);
      Lights after(count);
      AbsorbLight(width, AbsorbLightArgs{kAbsorption,
                                         after.medium.data(),
                                         after.path.data(),
                                         after.distance.data(),
                                         after.nearest.data(),
                                         {after.x.data(), after.y.data(), after.z.data()},
                                         count,
                                         after.Out3()});
      double worst = 0.0;
      for (size_t i = 0; i < count; ++i) {
        const uint32_t medium = before.medium[before.path[i]];
        const double length =
            std::sqrt(double{before.x[i]} * before.x[i] + double{before.y[i]} * before.y[i] +
                      double{before.z[i]} * before.z[i]);
        const double way = std::min(before.distance[i], before.nearest[i]) * length;
        for (size_t c = 0; c < 3; ++c) {
          const double sigma = kAbsorption[3 * medium + c];
          const double left = sigma == 0.0 ? 1.0 : std::exp(-sigma * way);
          const double expected = before.light[c][i] * left;
          // exp of -80 is near the smallest float; what is less may be 0.
          worst =
              std::max(worst, std::abs(after.light[c][i] - expected) / std::max(expected, 1e-30));
        }
      }
      CHECK(worst < 2e-5);
    });
  }
}

TEST_CASE("AbsorbLight: media by row, unit directions, no bound; vacuum takes nothing") {
  Lights lights(20);
  const Lights before(20);
  for (uint32_t& medium : lights.medium) medium = kVacuum;
  lights.medium[3] = 1;
  AbsorbLight(Width::kWide, AbsorbLightArgs{kAbsorption,
                                            lights.medium.data(),
                                            nullptr,
                                            lights.distance.data(),
                                            nullptr,
                                            {},
                                            20,
                                            lights.Out3()});
  for (size_t i = 0; i < 20; ++i) {
    CAPTURE(i);
    const double left = i == 3 ? std::exp(-2.0 * before.distance[i]) : 1.0;
    CHECK(lights.light[1][i] == doctest::Approx(before.light[1][i] * left).epsilon(1e-6));
    CHECK(lights.light[2][i] == before.light[2][i]);
  }
}

}  // namespace swell::test
