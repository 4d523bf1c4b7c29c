// The steps of textures by lanes: where they look, and what they make of it. Meanings are
// pbrt-v4's.
#if defined(SWELL_KERNELS_TEXTURES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TEXTURES_INL_H_
#undef SWELL_KERNELS_TEXTURES_INL_H_
#else
#define SWELL_KERNELS_TEXTURES_INL_H_
#endif

#include "kernels/filter-inl.h"
#include "kernels/noise-inl.h"
#include "kernels/sphere_map-inl.h"
#include "kernels/texture_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A point of a surface that wants textures.
struct TexturePoint {
  Vec3 p, n;  // world space
  F32 u, v;
  F32 width;   // of the pixel's footprint, world space
  F32 du, dv;  // most that u and v change per length
  Rgb color;   // of the vertices; white where a mesh has none
  F32 opacity;
  F32 u2, v2, du2, dv2;  // as u to dv, of the mesh's second coordinates; else the same
};

struct TexturePlace {
  F32 s, t;
  F32 ds, dt;  // most that they change within the footprint
};

HWY_INLINE Vec3 ToTexture(const TextureStep& step, const Vec3& p) {
  const float* m = step.texture_from_world;
  const auto row = [&](size_t r) HWY_ATTR {
    return hn::MulAdd(
        Set(m[r]), p.x,
        hn::MulAdd(Set(m[r + 1]), p.y, hn::MulAdd(Set(m[r + 2]), p.z, Set(m[r + 3]))));
  };
  return {row(0), row(4), row(8)};
}
HWY_INLINE F32 TextureWidth(const TextureStep& step, const TexturePoint& at) {
  return hn::Mul(at.width, Set(step.scale_from_world));
}

HWY_INLINE TexturePlace MapPoint(const TextureStep& step, const TexturePoint& at) {
  const float* m = step.map;
  const bool second = step.second_uvs != 0;
  const F32 u = second ? at.u2 : at.u, v = second ? at.v2 : at.v;
  const F32 du = second ? at.du2 : at.du, dv = second ? at.dv2 : at.dv;
  if (step.mapping == TextureMapping::kUv) {
    const F32 su = Set(m[0]), sv = Set(m[1]);
    return {hn::MulAdd(su, u, Set(m[2])), hn::MulAdd(sv, v, Set(m[3])),
            hn::Mul(hn::Abs(su), hn::Mul(du, at.width)),
            hn::Mul(hn::Abs(sv), hn::Mul(dv, at.width))};
  }
  if (step.mapping == TextureMapping::kUvAffine) {
    const auto row = [&](size_t r) HWY_ATTR {
      return hn::MulAdd(Set(m[r]), u, hn::MulAdd(Set(m[r + 1]), v, Set(m[r + 2])));
    };
    const auto change = [&](size_t r) HWY_ATTR {
      const F32 by_u = hn::Mul(hn::Abs(Set(m[r])), du);
      return hn::Mul(at.width, hn::MulAdd(hn::Abs(Set(m[r + 1])), dv, by_u));
    };
    return {row(0), row(3), change(0), change(3)};
  }
  const Vec3 p = ToTexture(step, at.p);
  const F32 width = TextureWidth(step, at);
  if (step.mapping == TextureMapping::kPlanar) {
    const Vec3 a = BroadcastVec3(m), b = BroadcastVec3(m + 3);
    return {hn::Add(Set(m[6]), Dot(p, a)), hn::Add(Set(m[7]), Dot(p, b)),
            hn::Mul(width, hn::Sqrt(Dot(a, a))), hn::Mul(width, hn::Sqrt(Dot(b, b)))};
  }
  const F32 flat = hn::Sqrt(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)));
  const F32 around = hn::Div(hn::Mul(Set(0.5f * kInvPi), width), hn::Max(flat, Set(1e-12f)));
  if (step.mapping == TextureMapping::kCylindrical) {
    return {AngleInTurns(hn::Neg(p.y), hn::Neg(p.x)), p.z, around, width};
  }
  const F32 radius = hn::Max(hn::Sqrt(Dot(p, p)), Set(1e-12f));
  const F32 polar = hn::Mul(Set(2.0f), AngleInTurns(flat, p.z));
  return {polar, AngleInTurns(p.y, p.x), hn::Div(hn::Mul(Set(kInvPi), width), radius), around};
}

// Mean of a square wave of period 2, 1 from even to odd numbers and -1 from odd to even, under a
// triangle filter of half-width r.
HWY_INLINE F32 SquareWave(F32 x, F32 r) {
  const F32 one = Set(1.0f), two = Set(2.0f), half = Set(0.5f);
  const auto second_integral = [&](F32 v) HWY_ATTR {
    const F32 h = hn::Mul(half, v);
    const F32 y = hn::Sub(hn::Sub(h, hn::Floor(h)), half);
    return hn::MulAdd(y, hn::NegMulAdd(two, hn::Abs(y), one), h);
  };
  const F32 h = hn::Mul(half, hn::Floor(x));
  const F32 odd = hn::Sub(h, hn::Floor(h));  // 0 or 1/2
  const F32 sharp = hn::NegMulAdd(Set(4.0f), odd, one);
  const F32 low = hn::Sub(x, r), high = hn::Add(x, r);
  const Mask in_one = hn::Eq(hn::Floor(low), hn::Floor(high));
  const F32 sum = hn::Add(second_integral(high), second_integral(low));
  const F32 safe = hn::IfThenElse(in_one, one, r);
  const F32 soft = hn::Div(hn::NegMulAdd(two, second_integral(x), sum), hn::Mul(safe, safe));
  return hn::IfThenElse(in_one, sharp, soft);
}

// The weight of the second of two textures in a checkerboard.
HWY_INLINE F32 CheckerWeight(const TextureStep& step, const TexturePoint& at) {
  const F32 wide = Set(1.5f), half = Set(0.5f);
  F32 product;
  if (step.op == TextureOp::kCheckerboard2) {
    const TexturePlace place = MapPoint(step, at);
    product = hn::Mul(SquareWave(place.s, hn::Mul(wide, place.ds)),
                      SquareWave(place.t, hn::Mul(wide, place.dt)));
  } else {
    const Vec3 p = ToTexture(step, at.p);
    const F32 r = hn::Mul(wide, TextureWidth(step, at));
    product = hn::Mul(SquareWave(p.x, r), hn::Mul(SquareWave(p.y, r), SquareWave(p.z, r)));
  }
  return hn::NegMulAdd(half, product, half);
}

// Whether (s, t) lies in a dot: cells of side 1, of which noise chooses some and shifts their dots.
HWY_INLINE Mask InDot(F32 s, F32 t) {
  const F32 half = Set(0.5f), radius = Set(0.35f), shift = Set(0.15f);
  const F32 cell_s = hn::Floor(hn::Add(s, half)), cell_t = hn::Floor(hn::Add(t, half));
  const auto noise = [&](float ds, float dt) HWY_ATTR {
    return Noise({hn::Add(cell_s, Set(ds)), hn::Add(cell_t, Set(dt)), half});
  };
  const F32 x = hn::Sub(s, hn::MulAdd(shift, noise(1.5f, 2.8f), cell_s));
  const F32 y = hn::Sub(t, hn::MulAdd(shift, noise(4.5f, 9.8f), cell_t));
  const F32 distance2 = hn::MulAdd(x, x, hn::Mul(y, y));
  return hn::And(hn::Gt(noise(0.5f, 0.5f), hn::Zero(D())),
                 hn::Lt(distance2, hn::Mul(radius, radius)));
}

// A Bezier spline of six segments over nine greys and blues of stone.
HWY_INLINE Rgb MarbleColor(F32 t) {
  static constexpr float kStone[9][3] = {
      {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f},
      {0.5f, 0.5f, 0.5f},   {0.6f, 0.59f, 0.58f}, {0.58f, 0.58f, 0.6f},
      {0.58f, 0.58f, 0.6f}, {0.2f, 0.2f, 0.33f},  {0.58f, 0.58f, 0.6f}};
  const F32 along = hn::Mul(t, Set(6.0f));
  const F32 segment = hn::Min(hn::Max(hn::Floor(along), hn::Zero(D())), Set(5.0f));
  const F32 x = hn::Sub(along, segment);
  const U32 first = hn::Mul(hn::BitCast(DU(), hn::ConvertTo(DI(), segment)), SetU(3));
  const auto blend = [&](uint32_t c) HWY_ATTR {
    const auto control = [&](uint32_t i) HWY_ATTR { return Gather(&kStone[i][c], first); };
    const F32 a = Lerp(x, control(0), control(1)), b = Lerp(x, control(1), control(2));
    const F32 d = Lerp(x, control(2), control(3));
    return hn::Mul(Set(1.5f), Lerp(x, Lerp(x, a, b), Lerp(x, b, d)));
  };
  return {blend(0), blend(1), blend(2)};
}

HWY_INLINE Rgb Grey(F32 v) { return {v, v, v}; }
HWY_INLINE Rgb Blend(F32 t, const Rgb& a, const Rgb& b) {
  return {Lerp(t, a.r, b.r), Lerp(t, a.g, b.g), Lerp(t, a.b, b.b)};
}

HWY_INLINE Rgb ImageStep(const TextureStep& step, const ImageView& image, const TexturePoint& at) {
  const F32 one = Set(1.0f);
  const TexturePlace place = MapPoint(step, at);
  const F32 width = hn::Mul(Set(2.0f), hn::Max(place.ds, place.dt));
  const Rgb texel = FilterImage(image, ImageWrap(step.wrap, step.wrap_t), step.filter, place.s,
                                hn::Sub(one, place.t), width);
  const Rgb value = Scale(Set(step.value[0]), texel);
  if (step.invert == 0) return value;
  const F32 zero = hn::Zero(D());
  return {hn::Max(hn::Sub(one, value.r), zero), hn::Max(hn::Sub(one, value.g), zero),
          hn::Max(hn::Sub(one, value.b), zero)};
}

HWY_INLINE Rgb NoiseStep(const TextureStep& step, const TexturePoint& at) {
  const Vec3 p = ToTexture(step, at.p);
  const F32 width = TextureWidth(step, at), tenth = Set(0.1f);
  const float roughness = step.value[0];
  if (step.op == TextureOp::kFbm) {
    return Grey(SumOctaves<false>(p, width, roughness, step.octaves));
  }
  if (step.op == TextureOp::kWrinkled) {
    return Grey(SumOctaves<true>(p, width, roughness, step.octaves));
  }
  if (step.op == TextureOp::kWindy) {
    const F32 wind = SumOctaves<false>(Scale(tenth, p), hn::Mul(tenth, width), 0.5f, 3);
    return Grey(hn::Mul(hn::Abs(wind), SumOctaves<false>(p, width, 0.5f, 6)));
  }
  const F32 scale = Set(step.value[1]);
  const Vec3 q = Scale(scale, p);
  const F32 sum = SumOctaves<false>(q, hn::Mul(scale, width), roughness, step.octaves);
  const F32 marble = hn::MulAdd(Set(step.value[2]), sum, q.y);
  const F32 turns = hn::Mul(marble, Set(0.5f * kInvPi));
  F32 sin, cos;
  SinCosTurns(hn::Sub(turns, hn::Floor(turns)), &sin, &cos);
  return MarbleColor(hn::MulAdd(Set(0.5f), sin, Set(0.5f)));
}

// One step, from the values of the earlier ones.
HWY_INLINE Rgb EvaluateStep(const TextureStep& step, const Rgb* values, const ImageView* images,
                            const TexturePoint& at) {
  const float* value = step.value;
  switch (step.op) {
    case TextureOp::kConstant:
      return BroadcastRgb(value);
    case TextureOp::kImage:
      return ImageStep(step, images[step.image], at);
    case TextureOp::kScale:
      return Mul(values[step.input[0]], values[step.input[1]]);
    case TextureOp::kMix:
      return Blend(values[step.input[2]].r, values[step.input[0]], values[step.input[1]]);
    case TextureOp::kDirectionMix:
      return Blend(hn::Abs(Dot(at.n, BroadcastVec3(value))), values[step.input[1]],
                   values[step.input[0]]);
    case TextureOp::kBilerp: {
      const TexturePlace place = MapPoint(step, at);
      const Rgb left = Blend(place.t, BroadcastRgb(value), BroadcastRgb(value + 3));
      return Blend(place.s, left, Blend(place.t, BroadcastRgb(value + 6), BroadcastRgb(value + 9)));
    }
    case TextureOp::kCheckerboard2:
    case TextureOp::kCheckerboard3:
      return Blend(CheckerWeight(step, at), values[step.input[0]], values[step.input[1]]);
    case TextureOp::kDots: {
      const TexturePlace place = MapPoint(step, at);
      return IfThenElse(InDot(place.s, place.t), values[step.input[0]], values[step.input[1]]);
    }
    case TextureOp::kStep:
      return Grey(hn::IfThenElseZero(hn::Ge(values[step.input[0]].r, Set(value[0])), Set(1.0f)));
    case TextureOp::kVertexColor:
      return value[0] == 0.0f ? at.color : Grey(at.opacity);
    default:
      return NoiseStep(step, at);
  }
}

// All steps of a program, into `values`.
HWY_INLINE void EvaluateProgram(const TexturesView& textures, const TextureProgram& program,
                                const TexturePoint& at, Rgb* values) {
  for (uint32_t k = 0; k < program.step_count; ++k) {
    values[k] = EvaluateStep(textures.steps[program.first_step + k], values, textures.images, at);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TEXTURES_INL_H_
