// Lights that are images, by lanes: radiance of a direction, directions drawn by brightness, and
// their density.
#if defined(SWELL_KERNELS_ENVIRONMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_ENVIRONMENT_INL_H_
#undef SWELL_KERNELS_ENVIRONMENT_INL_H_
#else
#define SWELL_KERNELS_ENVIRONMENT_INL_H_
#endif

#include "kernels/image-inl.h"
#include "kernels/sphere_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE Vec3 MapDirection(const float* m, const Vec3& w) {
  return {hn::MulAdd(Set(m[0]), w.x, hn::MulAdd(Set(m[1]), w.y, hn::Mul(Set(m[2]), w.z))),
          hn::MulAdd(Set(m[3]), w.x, hn::MulAdd(Set(m[4]), w.y, hn::Mul(Set(m[5]), w.z))),
          hn::MulAdd(Set(m[6]), w.x, hn::MulAdd(Set(m[7]), w.y, hn::Mul(Set(m[8]), w.z)))};
}

// A direction in the light's space, and what solid angles there are worth in the world.
struct LightDirection {
  Vec3 w;       // unit
  F32 density;  // of the world per density of the light's space
};
HWY_INLINE LightDirection ToLight(const ImageLightView& light, const Vec3& world) {
  const Vec3 w = MapDirection(light.light_from_world, world);
  const F32 length = hn::Sqrt(Dot(w, w));
  const F32 inverse = hn::Div(Set(1.0f), length);
  const F32 cube = hn::Mul(inverse, hn::Mul(inverse, inverse));
  return {Scale(inverse, w), hn::Mul(Set(light.jacobian), cube)};
}

HWY_INLINE Vec2 DirectionToImage(const ImageLightView& light, const Vec3& w) {
  return light.mapping == ImageMapping::kLatLong ? SphereToLatLong(w) : SphereToEqualArea(w);
}

// What an infinite light sends from `world`, without its LightRecord's factor.
struct SkyLanes {
  Rgb radiance;
  F32 pdf;  // solid angle; 0 where the light is never drawn
};
HWY_INLINE SkyLanes EvaluateSky(const ImageLightView& light, const Vec3& world) {
  const LightDirection to = ToLight(light, world);
  const Vec2 uv = DirectionToImage(light, to.w);
  const U32 row = CellOf(uv.y, light.rows), column = CellOf(uv.x, light.columns);
  const U32 cell = hn::Add(hn::Mul(row, SetU(light.columns + 1)), column);
  const F32 row_share = hn::Sub(Gather(light.row_cdf + 1, row), Gather(light.row_cdf, row));
  const F32 share = hn::Sub(Gather(light.column_cdf + 1, cell), Gather(light.column_cdf, cell));
  const F32 angle = Gather(light.inverse_angle, row);
  const F32 pdf = hn::Mul(hn::Mul(row_share, share), hn::Mul(angle, to.density));
  return {NearestTexel(light.image, uv.x, uv.y), pdf};
}

// The cell of cdf[first .. first + count] that holds u, and where in it u lies.
struct DrawnCell {
  U32 index;
  F32 within;  // [0, 1]
  F32 share;   // the cell's probability
};
HWY_INLINE DrawnCell DrawCell(const float* cdf, U32 first, uint32_t count, F32 u) {
  U32 at = hn::Zero(DU());
  uint32_t step = 1;
  while (step < count) step *= 2;
  for (step /= 2; step != 0; step /= 2) {
    const U32 next = hn::Min(hn::Add(at, SetU(step)), SetU(count - 1));
    const Mask below = hn::Le(Gather(cdf, hn::Add(first, next)), u);
    at = hn::IfThenElse(ToUintMask(below), next, at);
  }
  const U32 cell = hn::Add(first, at);
  const F32 low = Gather(cdf, cell);
  const F32 share = hn::Sub(Gather(cdf + 1, cell), low);
  const F32 within = hn::Div(hn::Sub(u, low), hn::Max(share, Set(0x1p-40f)));
  return {at, hn::Min(hn::Max(within, hn::Zero(D())), Set(1.0f)), share};
}

struct SkySample {
  Vec3 wi;  // world space, unit
  Rgb radiance;
  F32 pdf;
};
HWY_INLINE SkySample SampleSky(const ImageLightView& light, F32 u0, F32 u1) {
  const DrawnCell row = DrawCell(light.row_cdf, hn::Zero(DU()), light.rows, u1);
  const U32 first = hn::Mul(row.index, SetU(light.columns + 1));
  const DrawnCell column = DrawCell(light.column_cdf, first, light.columns, u0);
  const auto place = [](const DrawnCell& cell, uint32_t count) HWY_ATTR {
    const F32 index = hn::ConvertTo(D(), hn::BitCast(DI(), cell.index));
    return hn::Mul(hn::Add(index, cell.within), Set(1.0f / static_cast<float>(count)));
  };
  const F32 u = place(column, light.columns);
  F32 v = place(row, light.rows);
  Vec3 w;
  if (light.mapping == ImageMapping::kLatLong) {
    // Uniform in solid angle within the cell: in the cosine, not in the angle.
    const F32 top = Gather(light.row_cosine, row.index);
    const F32 bottom = Gather(light.row_cosine + 1, row.index);
    w = LatLongToSphere(u, hn::MulAdd(row.within, hn::Sub(bottom, top), top));
    v = PolarInHalfTurns(w);
  } else {
    w = EqualAreaToSphere(u, v);
  }
  const Vec3 world = MapDirection(light.world_from_light, w);
  const F32 length = hn::Sqrt(Dot(world, world));
  const F32 cube = hn::Mul(length, hn::Mul(length, length));
  const F32 angle = Gather(light.inverse_angle, row.index);
  const F32 pdf =
      hn::Mul(hn::Mul(row.share, column.share), hn::Mul(angle, hn::Mul(cube, Set(light.jacobian))));
  return {Scale(hn::Div(Set(1.0f), length), world), NearestTexel(light.image, u, v), pdf};
}

// The factor of the intensity in which a goniometric or projection light shines along `world`.
HWY_INLINE Rgb EvaluateBeam(const ImageLightView& light, const Vec3& world) {
  const Vec3 w = ToLight(light, world).w;
  if (light.mapping != ImageMapping::kProjection) {
    const Vec2 uv = DirectionToImage(light, w);
    return NearestTexel(light.image, uv.x, uv.y);
  }
  const F32 zero = hn::Zero(D()), half = Set(0.5f), one = Set(1.0f);
  const Mask ahead = hn::Gt(w.z, Set(1e-3f));
  const F32 scale = hn::Div(half, hn::IfThenElse(ahead, w.z, one));
  const F32 u = hn::MulAdd(hn::Mul(w.x, scale), Set(1.0f / light.half_width[0]), half);
  const F32 v = hn::MulAdd(hn::Mul(w.y, scale), Set(1.0f / light.half_width[1]), half);
  const Mask inside =
      hn::And(hn::And(hn::Ge(u, zero), hn::Le(u, one)), hn::And(hn::Ge(v, zero), hn::Le(v, one)));
  return IfThenElseZero(hn::And(ahead, inside), NearestTexel(light.image, u, v));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_ENVIRONMENT_INL_H_
