// Measures the four ways to draw a diffuse direction: the drawing alone, and the whole shading
// kernel with it. The rejected sphere is a loop that runs until the last lane is accepted.
#include <cstdint>
#include <string>
#include <vector>

#include "bench/cases.h"
#include "bench/shading.h"
#include "kernels/material.h"

namespace swell::bench {
namespace {

struct NamedSampling {
  const char* name;
  DiffuseSampling sampling;
};
constexpr NamedSampling kSamplings[] = {
    {"disk", DiffuseSampling::kDisk},
    {"normal_plus_sphere", DiffuseSampling::kNormalPlusSphere},
    {"normal_plus_rejected_sphere", DiffuseSampling::kNormalPlusRejectedSphere},
    {"normal_plus_gaussian", DiffuseSampling::kNormalPlusGaussian},
};

uint32_t DiffuseKind() {
  uint32_t kind = 0;
  while (std::string(kMaterialKinds[kind]->name) != "diffuse") ++kind;
  return kind;
}

// Directions and numbers of a wave of samples; xorshift, for any numbers will do.
class Directions {
 public:
  Directions() {
    uint32_t bits = 1;
    for (auto& column : uniform_) {
      for (float& u : column) {
        bits ^= bits << 13;
        bits ^= bits >> 17;
        bits ^= bits << 5;
        u = static_cast<float>(bits >> 8) * 0x1p-24f;
      }
    }
  }

  BsdfQuery Query(const float* params, DiffuseSampling sampling) {
    BsdfQuery query{};
    query.params = params;
    query.settings.diffuse_sampling = sampling;
    query.wo = {zero_.data(), zero_.data(), one_.data()};
    for (int i = 0; i < 3; ++i) query.u[i] = uniform_[i].data();
    query.count = kMostRows;
    query.sampled_wi = {out_[0].data(), out_[1].data(), out_[2].data()};
    query.value = {out_[3].data(), out_[4].data(), out_[5].data()};
    query.pdf = out_[6].data();
    return query;
  }

 private:
  using Column = std::vector<float>;
  Column zero_ = Column(kMostRows), one_ = Column(kMostRows, 1.0f);
  std::vector<Column> uniform_ = std::vector<Column>(3, Column(kMostRows));
  std::vector<Column> out_ = std::vector<Column>(7, Column(kMostRows));
};

void SampleDiffuse(benchmark::State& state, DiffuseSampling sampling, Width width) {
  Directions directions;
  const float params[kMaterialWords] = {0.5f, 0.5f, 0.5f};
  const BsdfQuery query = directions.Query(params, sampling);
  const MaterialInfo& diffuse = *kMaterialKinds[DiffuseKind()];
  for (auto _ : state) {
    diffuse.sample(width, query);
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, query.count);
}

void ShadeDiffuse(benchmark::State& state, DiffuseSampling sampling, Width width) {
  const RayWave& wave = RaysOf({"cornell_bounce1", "cornell", 1, ""});
  const SortedWave sorted = Sort(wave);
  PathSettings settings = SettingsOf(*wave.scene);
  settings.diffuse_sampling = sampling;
  Shaded shaded(wave.rows);
  const uint32_t kind = DiffuseKind();
  for (auto _ : state) {
    shaded.shadow_count = 0;
    for (const Run& run : sorted.runs) {
      if (KindOf(wave, run) == kind) ShadeRun(width, wave, sorted, run, settings, shaded);
    }
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, wave.rows);
}

[[maybe_unused]] const bool kAdded = [] {
  for (const NamedSampling& s : kSamplings) {
    for (Width width : kWidths) {
      const std::string end = std::string(s.name) + "/" + NameOf(width);
      benchmark::RegisterBenchmark(("SampleDiffuse/" + end).c_str(), SampleDiffuse, s.sampling,
                                   width);
      benchmark::RegisterBenchmark(("ShadeDiffuse/cornell_bounce1/" + end).c_str(), ShadeDiffuse,
                                   s.sampling, width);
    }
  }
  return true;
}();

}  // namespace
}  // namespace swell::bench
