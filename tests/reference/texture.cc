// One node after the other, by recursion.
#include "tests/reference/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/noise_table.h"

namespace swell::reference {
namespace {

constexpr double kPi = std::numbers::pi;

double Gradient(int hash, double x, double y, double z) {
  // The twelve edges of a cube, four of them twice (pbrt-v4 takes others twice than Perlin).
  static constexpr int kEdges[16][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                        {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                        {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1},
                                        {1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};
  const int* e = kEdges[hash & 15];
  return e[0] * x + e[1] * y + e[2] * z;
}

struct Place {
  double s, t;
};

std::array<double, 3> ToTexture(const TextureStep& step, const std::array<double, 3>& p) {
  std::array<double, 3> q{};
  for (int r = 0; r < 3; ++r) {
    const float* m = step.texture_from_world + 4 * r;
    q[r] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
  }
  return q;
}

Place MapPoint(const TextureStep& step, const TexturedPoint& at) {
  const auto q = ToTexture(step, at.p);
  const float* m = step.map;
  const double flat = std::hypot(q[0], q[1]);
  const auto turns = [](double y, double x) {
    const double angle = std::atan2(y, x) / (2 * kPi);
    return angle < 0 ? angle + 1 : angle;
  };
  switch (step.mapping) {
    case TextureMapping::kUv:
      return {m[0] * at.u + m[2], m[1] * at.v + m[3]};
    case TextureMapping::kSpherical:
      return {std::atan2(flat, q[2]) / kPi, turns(q[1], q[0])};
    case TextureMapping::kCylindrical:
      return {(kPi + std::atan2(q[1], q[0])) / (2 * kPi), q[2]};
    case TextureMapping::kUvAffine:
      return {m[0] * at.u + m[1] * at.v + m[2], m[3] * at.u + m[4] * at.v + m[5]};
    case TextureMapping::kPlanar:
      break;
  }
  return {m[0] * q[0] + m[1] * q[1] + m[2] * q[2] + m[6],
          m[3] * q[0] + m[4] * q[1] + m[5] * q[2] + m[7]};
}

// Where texel `v` of `size` along one axis is; -1: nowhere.
int WrapAlong(TextureWrap wrap, int v, int size) {
  const int twice = (v % (2 * size) + 2 * size) % (2 * size);
  switch (wrap) {
    case TextureWrap::kRepeat:
      return twice % size;
    case TextureWrap::kMirror:
      return std::min(twice, 2 * size - 1 - twice);
    case TextureWrap::kBlack:
      return v < 0 || v >= size ? -1 : v;
    default:
      return std::clamp(v, 0, size - 1);
  }
}

Color Texel(const TexelImage& image, const TextureStep& step, int x, int y) {
  const int w = int(image.levels[0].width), h = int(image.levels[0].height);
  if (step.wrap == TextureWrap::kOctahedral) {
    if (x < 0 || x >= w) {
      x = x < 0 ? -1 - x : 2 * w - 1 - x;
      y = h - 1 - y;
    }
    if (y < 0 || y >= h) {
      y = y < 0 ? -1 - y : 2 * h - 1 - y;
      x = w - 1 - x;
    }
  } else {
    x = WrapAlong(step.wrap, x, w);
    y = WrapAlong(step.wrap_t == TextureWrap::kAsOther ? step.wrap : step.wrap_t, y, h);
    if (x < 0 || y < 0) return {0, 0, 0};
  }
  const auto texel =
      TexelAt(image, 0, uint32_t(std::clamp(x, 0, w - 1)), uint32_t(std::clamp(y, 0, h - 1)));
  return {texel[0], texel[1], texel[2]};
}

Color ImageColor(const TextureStep& step, const TexelImage& image, Place place) {
  const double x = place.s * image.levels[0].width, y = (1 - place.t) * image.levels[0].height;
  Color sum{};
  if (step.filter == TextureFilter::kPoint) {
    sum = Texel(image, step, int(std::floor(x)), int(std::floor(y)));
  } else {
    const int x0 = int(std::floor(x - 0.5)), y0 = int(std::floor(y - 0.5));
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const double weight = (1 - std::abs(x - 0.5 - x0 - i)) * (1 - std::abs(y - 0.5 - y0 - j));
        const Color texel = Texel(image, step, x0 + i, y0 + j);
        for (int c = 0; c < 3; ++c) sum[c] += weight * texel[c];
      }
    }
  }
  for (double& channel : sum) {
    channel *= step.value[0];
    if (step.invert != 0) channel = std::max(0.0, 1 - channel);
  }
  return sum;
}

double Octaves(std::array<double, 3> p, double roughness, uint32_t octaves, bool turbulence) {
  double sum = 0, weight = 1;
  for (uint32_t i = 0; i < octaves; ++i) {
    const double noise = PerlinNoise(p[0], p[1], p[2]);
    sum += weight * (turbulence ? std::abs(noise) : noise);
    for (double& x : p) x *= 1.99f;
    weight *= roughness;
  }
  return turbulence ? sum + weight * 0.2 : sum;
}

Color Grey(double v) { return {v, v, v}; }
Color Blend(double t, const Color& a, const Color& b) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Color Marble(const TextureStep& step, std::array<double, 3> p) {
  static constexpr double kStone[9][3] = {{.58, .58, .6}, {.58, .58, .6}, {.58, .58, .6},
                                          {.5, .5, .5},   {.6, .59, .58}, {.58, .58, .6},
                                          {.58, .58, .6}, {.2, .2, .33},  {.58, .58, .6}};
  for (double& x : p) x *= step.value[1];
  const double wave = p[1] + step.value[2] * Octaves(p, step.value[0], step.octaves, false);
  const double t = (0.5 + 0.5 * std::sin(wave)) * 6;
  const int first = std::min(int(t), 5);
  const double x = t - first, y = 1 - x;
  Color color{};
  for (int c = 0; c < 3; ++c) {
    color[c] = 1.5 * (y * y * y * kStone[first][c] + 3 * x * y * y * kStone[first + 1][c] +
                      3 * x * x * y * kStone[first + 2][c] + x * x * x * kStone[first + 3][c]);
  }
  return color;
}

bool InDot(Place place) {
  const double s = std::floor(place.s + 0.5), t = std::floor(place.t + 0.5);
  if (PerlinNoise(s + 0.5, t + 0.5, 0.5) <= 0) return false;
  const double x = s + 0.15 * PerlinNoise(s + 1.5, t + 2.8, 0.5);
  const double y = t + 0.15 * PerlinNoise(s + 4.5, t + 9.8, 0.5);
  return std::hypot(place.s - x, place.t - y) < 0.35;
}

}  // namespace

double PerlinNoise(double x, double y, double z) {
  const double cell[3] = {std::floor(x), std::floor(y), std::floor(z)};
  const double at[3] = {x - cell[0], y - cell[1], z - cell[2]};
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto wrapped = [&](int axis, int step) { return (int(cell[axis]) + step) & 255; };
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const uint8_t* p = kNoisePermutation;
    const int hash = p[(p[(p[wrapped(0, i)] + wrapped(1, j)) & 255] + wrapped(2, k)) & 255];
    const double weight = (i ? fade(at[0]) : 1 - fade(at[0])) *
                          (j ? fade(at[1]) : 1 - fade(at[1])) * (k ? fade(at[2]) : 1 - fade(at[2]));
    sum += weight * Gradient(hash, at[0] - i, at[1] - j, at[2] - k);
  }
  return sum;
}

Color EvaluateTexture(const Scene& scene, uint32_t node, const TexturedPoint& at) {
  const TextureStep& step = scene.texture_nodes[node];
  const auto input = [&](int i) { return EvaluateTexture(scene, step.input[i], at); };
  const auto value = [&](int i) {
    return Color{step.value[3 * i], step.value[3 * i + 1], step.value[3 * i + 2]};
  };
  const Place place = MapPoint(step, at);
  const auto q = ToTexture(step, at.p);
  switch (step.op) {
    case TextureOp::kConstant:
      return value(0);
    case TextureOp::kImage:
      return ImageColor(step, scene.images[step.image], place);
    case TextureOp::kScale: {
      const Color a = input(0), b = input(1);
      return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
    }
    case TextureOp::kMix:
      return Blend(input(2)[0], input(0), input(1));
    case TextureOp::kDirectionMix: {
      const double cosine =
          at.n[0] * step.value[0] + at.n[1] * step.value[1] + at.n[2] * step.value[2];
      return Blend(std::abs(cosine), input(1), input(0));
    }
    case TextureOp::kBilerp:
      return Blend(place.s, Blend(place.t, value(0), value(1)), Blend(place.t, value(2), value(3)));
    case TextureOp::kCheckerboard2:
      return (int(std::floor(place.s)) + int(std::floor(place.t))) % 2 == 0 ? input(0) : input(1);
    case TextureOp::kCheckerboard3:
      return (int(std::floor(q[0])) + int(std::floor(q[1])) + int(std::floor(q[2]))) % 2 == 0
                 ? input(0)
                 : input(1);
    case TextureOp::kDots:
      return InDot(place) ? input(0) : input(1);
    case TextureOp::kFbm:
      return Grey(Octaves(q, step.value[0], step.octaves, false));
    case TextureOp::kWrinkled:
      return Grey(Octaves(q, step.value[0], step.octaves, true));
    case TextureOp::kWindy:
      return Grey(std::abs(Octaves({0.1 * q[0], 0.1 * q[1], 0.1 * q[2]}, 0.5, 3, false)) *
                  Octaves(q, 0.5, 6, false));
    case TextureOp::kStep:
      return Grey(input(0)[0] >= step.value[0] ? 1 : 0);
    case TextureOp::kVertexColor:
      return step.value[0] == 0 ? Color{at.color[0], at.color[1], at.color[2]} : Grey(at.color[3]);
    case TextureOp::kMarble:
      break;
  }
  return Marble(step, q);
}

}  // namespace swell::reference
