// Measures how fast points get a light each, of a thousand.
#include "kernels/choose_lights.h"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/cases.h"
#include "bench/scenes.h"

namespace swell::bench {
namespace {

constexpr size_t kPoints = 4096;

// Points on the floor of the hall and in its air, in no order.
struct Points {
  Points() : cells(8, std::vector<float>(kPoints + kRowPadding)), light(kPoints + kRowPadding) {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) {
      return low + (high - low) * (static_cast<float>(random() >> 8) * 0x1p-24f);
    };
    for (size_t i = 0; i < kPoints; ++i) {
      cells[0][i] = uniform(-9, 9);
      cells[1][i] = i % 2 == 0 ? 0.0f : uniform(0, 5);
      cells[2][i] = uniform(-9, 9);
      cells[4][i] = 1;
      cells[6][i] = uniform(0, 1);
    }
  }
  std::vector<std::vector<float>> cells;
  std::vector<uint32_t> light;
};

void Choose(benchmark::State& state, LightSampler sampler, Width width, bool pdf_only) {
  const Scene scene = ManyLightsScene();
  const SceneTables tables = FinishScene(scene, sampler);
  Points points;
  std::vector<std::vector<float>>& c = points.cells;
  const ChooseLightsArgs args{&tables.view.lights,
                              kPoints,
                              {c[0].data(), c[1].data(), c[2].data()},
                              {c[3].data(), c[4].data(), c[5].data()},
                              c[6].data(),
                              points.light.data(),
                              c[7].data()};
  ChooseLights(width, args);
  for (auto _ : state) {
    if (pdf_only) {
      ChoicePdfs(width, args);
    } else {
      ChooseLights(width, args);
    }
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, kPoints);
}

bool AddAll() {
  for (LightSampler sampler : {LightSampler::kPower, LightSampler::kBvh}) {
    for (Width width : kWidths) {
      for (bool pdf_only : {false, true}) {
        const std::string name = std::string(pdf_only ? "ChoicePdfs/" : "ChooseLights/") +
                                 kLightSamplerNames[static_cast<size_t>(sampler)] +
                                 "/lights-1000/" + NameOf(width);
        benchmark::RegisterBenchmark(name.c_str(), Choose, sampler, width, pdf_only);
      }
    }
  }
  return true;
}
[[maybe_unused]] const bool kAdded = AddAll();

}  // namespace
}  // namespace swell::bench
