// Hits on random materials in, groups of row ids out: against std::stable_sort.
#include "kernels/sort_hits.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr uint32_t kMaxDepth = 5;

struct SortCase {
  std::vector<uint32_t> prim_shape;
  std::vector<ShapeRecord> shapes;
  std::vector<uint32_t> prims, states;
  std::vector<float> dir[3], org[3], distances;
  std::vector<MixRecord> mixes;
  uint32_t materials;
  SceneView scene{};

  SortCase(size_t count, uint32_t material_count) : materials(material_count) {
    for (uint32_t s = 0; s < 2 * materials + 1; ++s) {
      ShapeRecord shape{};
      shape.material = s * 7 % materials;
      shapes.push_back(shape);
    }
    for (uint32_t p = 0; p < 97; ++p) prim_shape.push_back(p * 31 % uint32_t(shapes.size()));
    // Rows of the padding would crash a kernel that follows them.
    prims.assign(RoundUpToPadding(count) + kRowPadding, 0xF0000000u);
    states.assign(prims.size(), 0);
    for (std::vector<float>& column : dir) column.assign(prims.size(), 0.5f);
    for (std::vector<float>& column : org) column.assign(prims.size(), 2.0f);
    distances.assign(prims.size(), 1.0f);
  }
  uint32_t Key(size_t i) const {
    if (prims[i] == kNoPrim) return kMissRun;
    if ((states[i] & kBounceMask) >= kMaxDepth) return kEndRun;
    return shapes[prim_shape[prims[i]]].material;
  }
};

struct Sorted {
  std::vector<uint32_t> rows;
  std::vector<Run> runs;
  std::vector<uint32_t> histogram;
};

Sorted Sort(SortCase& c, size_t count, Width width) {
  c.scene.prim_shape = c.prim_shape.data();
  c.scene.shapes = c.shapes.data();
  c.scene.materials.count = c.materials;
  c.scene.materials.mixes = c.mixes.data();
  std::vector<uint32_t> keys(RoundUpToPadding(count) + kRowPadding);
  Sorted sorted;
  sorted.rows.resize(RoundUpToPadding(count) + kRowPadding);
  sorted.runs.resize(c.materials + 2);
  sorted.histogram.assign(c.materials + 2, 0);
  const Vec3Fields<In> dirs{c.dir[0].data(), c.dir[1].data(), c.dir[2].data()};
  const SortHitsArgs args{&c.scene,
                          kMaxDepth,
                          c.prims.data(),
                          c.states.data(),
                          count,
                          keys.data(),
                          sorted.histogram.data(),
                          dirs,
                          c.distances.data(),
                          {c.org[0].data(), c.org[1].data(), c.org[2].data()}};
  sorted.runs.resize(SortHits(width, args, sorted.rows.data(), sorted.runs.data()));
  sorted.rows.resize(count);
  return sorted;
}

void CheckSorted(SortCase& c, size_t count) {
  std::vector<uint32_t> expected(count);
  std::iota(expected.begin(), expected.end(), 0u);
  std::stable_sort(expected.begin(), expected.end(),
                   [&](uint32_t a, uint32_t b) { return c.Key(a) < c.Key(b); });
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
    const Sorted sorted = Sort(c, count, width);
    CHECK((sorted.rows == expected));
    uint32_t first = 0;
    for (const Run& run : sorted.runs) {
      CHECK(run.first == first);
      REQUIRE(run.count > 0);
      for (uint32_t i = 0; i < run.count; ++i)
        REQUIRE(c.Key(sorted.rows[first + i]) == run.material);
      first += run.count;
    }
    CHECK(first == count);
    for (size_t r = 1; r < sorted.runs.size(); ++r) {
      CHECK(sorted.runs[r - 1].material < sorted.runs[r].material);
    }
    CHECK((sorted.histogram == std::vector<uint32_t>(c.materials + 2, 0)));
  });
}

TEST_CASE("SortHits: groups rows by material, stable, misses and last bounces at the end") {
  std::mt19937 random(1);
  for (uint32_t materials : {1u, 2u, 13u, 200u}) {
    for (size_t count : kRowCounts) {
      SortCase c(count, materials);
      for (size_t i = 0; i < count; ++i) {
        c.prims[i] = random() % 5 == 0 ? kNoPrim : uint32_t(random() % c.prim_shape.size());
        c.states[i] = uint32_t(random() % (kMaxDepth + 2)) | (random() % 2 != 0 ? kSpecularRay : 0);
      }
      CheckSorted(c, count);
    }
  }
}

TEST_CASE("SortHits: a queue of one kind is one run, whichever kind it is") {
  for (size_t count : kRowCounts) {
    for (const auto& [prim, state] : {std::pair{3u, 0u},
                                      {3u, kMaxDepth},
                                      {kNoPrim, 0u},
                                      {kNoPrim, kMaxDepth},
                                      {96u, kSpecularRay | 4u}}) {
      SortCase c(count, 5);
      std::fill_n(c.prims.begin(), count, prim);
      std::fill_n(c.states.begin(), count, state);
      CheckSorted(c, count);
      CHECK(Sort(c, count, Width::kWide).runs.size() == (count == 0 ? 0 : 1));
    }
  }
}

TEST_CASE("SortHits: one row that differs, at any place, makes a second run") {
  for (size_t odd = 0; odd < 40; ++odd) {
    SortCase c(40, 5);
    std::fill_n(c.prims.begin(), 40, 3u);
    c.prims[odd] = kNoPrim;
    CheckSorted(c, 40);
  }
}

// Mixes 0: a quarter of material 1, the rest 0; 1: mix 0 and material 2 by halves; 2 and 3: all
// of 0, all of 1. The prims are of one of them.
SortCase MixedCase(size_t count, uint32_t mix) {
  SortCase c(count, 3);
  c.mixes = {
      {{0, 1}, 0.25f, 0}, {{kMixedMaterial, 2}, 0.5f, 0}, {{0, 1}, 0.0f, 0}, {{0, 1}, 1.0f, 0}};
  for (ShapeRecord& shape : c.shapes) shape.material = kMixedMaterial | mix;
  std::mt19937 random(2);
  for (size_t i = 0; i < count; ++i) {
    c.prims[i] = uint32_t(random() % c.prim_shape.size());
    for (std::vector<float>& column : c.dir) column[i] = float(random()) * 0x1p-32f;
    c.distances[i] = float(random()) * 0x1p-30f;
  }
  return c;
}

TEST_CASE("SortHits: a hit of a mix is of one of its materials, as often as the mix says") {
  constexpr size_t kCount = 20000;
  const double shares[4][3] = {{0.75, 0.25, 0}, {0.375, 0.125, 0.5}, {1, 0, 0}, {0, 1, 0}};
  for (uint32_t mix = 0; mix < 4; ++mix) {
    SortCase c = MixedCase(kCount, mix);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", mix ", mix);
      double found[3] = {};
      for (const Run& run : Sort(c, kCount, width).runs) {
        REQUIRE(run.material < 3);
        found[run.material] = double(run.count) / kCount;
      }
      for (int m = 0; m < 3; ++m) CHECK(found[m] == doctest::Approx(shares[mix][m]).epsilon(0.02));
    });
  }
}

TEST_CASE(
    "SortHits: parallel rays to equal distances choose among a mix's materials by themselves") {
  constexpr size_t kCount = 20000;
  SortCase c = MixedCase(kCount, 0);
  for (size_t i = 0; i < kCount; ++i) {
    std::swap(c.org[0][i], c.dir[0][i]);
    std::swap(c.org[1][i], c.dir[1][i]);
    c.dir[2][i] = c.distances[i] = 1.0f;
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    double second = 0;
    for (const Run& run : Sort(c, kCount, width).runs) {
      if (run.material == 1) second += double(run.count) / kCount;
    }
    CHECK(second == doctest::Approx(0.25).epsilon(0.02));
  });
}

TEST_CASE("SortHits: what a mix's hit is depends on nothing but the hit") {
  for (size_t count : kRowCounts) {
    SortCase c = MixedCase(count, 1);
    std::vector<uint32_t> expected(count);
    const auto materials = [&](const Sorted& sorted, size_t rows, bool reversed) {
      std::vector<uint32_t> of_row(rows);
      for (const Run& run : sorted.runs) {
        for (uint32_t i = 0; i < run.count; ++i) {
          const uint32_t row = sorted.rows[run.first + i];
          of_row[reversed ? rows - 1 - row : row] = run.material;
        }
      }
      return of_row;
    };
    expected = materials(Sort(c, count, Width::kOneLane), count, false);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      CHECK((materials(Sort(c, count, width), count, false) == expected));
      SortCase back = c;
      std::reverse(back.prims.begin(), back.prims.begin() + ptrdiff_t(count));
      std::reverse(back.distances.begin(), back.distances.begin() + ptrdiff_t(count));
      for (std::vector<float>& column : back.dir) {
        std::reverse(column.begin(), column.begin() + ptrdiff_t(count));
      }
      CHECK((materials(Sort(back, count, width), count, true) == expected));
    });
  }
}

}  // namespace
}  // namespace swell::test
