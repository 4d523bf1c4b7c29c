// Filtered lookups of images with smaller levels: wrapped, at a point, bilinear or trilinear.
#if defined(SWELL_KERNELS_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_FILTER_INL_H_
#undef SWELL_KERNELS_FILTER_INL_H_
#else
#define SWELL_KERNELS_FILTER_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "kernels/image-inl.h"
#include "kernels/texture_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE F32 ToFloat(U32 v) { return hn::ConvertTo(D(), hn::BitCast(DI(), v)); }

// How an image goes on along its two axes.
struct ImageWrap {
  TextureWrap s, t;

  HWY_INLINE ImageWrap(TextureWrap both) : s(both), t(both) {}  // NOLINT: a wrap is for both
  HWY_INLINE ImageWrap(TextureWrap along_s, TextureWrap along_t)
      : s(along_s), t(along_t == TextureWrap::kAsOther ? along_s : along_t) {}
};

// Coordinates that wrapping by texel can bring into the image.
HWY_INLINE F32 WrapCoordinate(TextureWrap wrap, F32 s) {
  if (wrap == TextureWrap::kRepeat) return hn::Sub(s, hn::Floor(s));
  if (wrap == TextureWrap::kMirror) {  // beyond its edges the texels there go on, as for kClamp
    const F32 half = Set(0.5f), two = Set(2.0f);
    const F32 turns = hn::Mul(half, s);
    return hn::Abs(hn::Mul(two, hn::Sub(turns, hn::Floor(hn::Add(turns, half)))));
  }
  return hn::Min(hn::Max(s, Set(-1.0f)), Set(2.0f));
}

// The texel at (x, y), at most one image away.
HWY_INLINE Rgb WrappedTexel(const ImageView& image, ImageWrap wrap, const LevelLanes& level, I32 x,
                            I32 y) {
  const I32 zero = hn::Zero(DI()), one = hn::Set(DI(), 1);
  const I32 width = hn::BitCast(DI(), level.width), height = hn::BitCast(DI(), level.height);
  const I32 right = hn::Sub(width, one), bottom = hn::Sub(height, one);
  auto inside = hn::Eq(zero, zero);
  const auto along = [&](TextureWrap how, I32& v, I32 size) HWY_ATTR {
    if (how == TextureWrap::kRepeat) {
      const I32 raised = hn::IfThenElse(hn::Lt(v, zero), hn::Add(v, size), v);
      v = hn::IfThenElse(hn::Lt(raised, size), raised, hn::Sub(raised, size));
    } else if (how == TextureWrap::kBlack) {
      inside = hn::And(inside, hn::And(hn::Not(hn::Lt(v, zero)), hn::Lt(v, size)));
    }
  };
  along(wrap.s, x, width);
  along(wrap.t, y, height);
  if (wrap.s == TextureWrap::kOctahedral) {
    // Beyond an edge the square goes on at the same edge, mirrored about its middle.
    const auto mirror = [&](I32& v, I32 size, I32& other, I32 other_last) HWY_ATTR {
      const auto below = hn::Lt(v, zero), above = hn::Not(hn::Lt(v, size));
      const I32 up = hn::Sub(hn::Neg(v), one);
      const I32 down = hn::Sub(hn::Sub(hn::Add(size, size), one), v);
      v = hn::IfThenElse(below, up, hn::IfThenElse(above, down, v));
      other = hn::IfThenElse(hn::Or(below, above), hn::Sub(other_last, other), other);
    };
    mirror(x, width, y, bottom);
    mirror(y, height, x, right);
  }
  const U32 in_x = hn::BitCast(DU(), hn::Min(hn::Max(x, zero), right));
  const U32 in_y = hn::BitCast(DU(), hn::Min(hn::Max(y, zero), bottom));
  return IfThenElseZero(hn::RebindMask(D(), inside), FetchTexel(image, level, in_x, in_y));
}

HWY_INLINE Rgb BilinearTexel(const ImageView& image, ImageWrap wrap, const LevelLanes& level, F32 s,
                             F32 t) {
  const F32 half = Set(0.5f), one = Set(1.0f);
  const F32 x = hn::MulSub(s, ToFloat(level.width), half);
  const F32 y = hn::MulSub(t, ToFloat(level.height), half);
  const F32 dx = hn::Sub(x, hn::Floor(x)), dy = hn::Sub(y, hn::Floor(y));
  const I32 x0 = FloorToInt(x), y0 = FloorToInt(y), next = hn::Set(DI(), 1);
  const I32 x1 = hn::Add(x0, next), y1 = hn::Add(y0, next);
  const F32 ex = hn::Sub(one, dx), ey = hn::Sub(one, dy);
  const Rgb top = Add(Scale(ex, WrappedTexel(image, wrap, level, x0, y0)),
                      Scale(dx, WrappedTexel(image, wrap, level, x1, y0)));
  const Rgb bottom = Add(Scale(ex, WrappedTexel(image, wrap, level, x0, y1)),
                         Scale(dx, WrappedTexel(image, wrap, level, x1, y1)));
  return Add(Scale(ey, top), Scale(dy, bottom));
}

// The image of a surface that emits, at its texture coordinates.
HWY_INLINE Rgb SurfaceTexel(const ImageLightView& light, F32 u, F32 v) {
  const ImageWrap wrap(light.lookup.wrap, light.lookup.wrap_t);
  const LevelLanes level = SetLevel(light.image.levels[0]);
  const F32 s = WrapCoordinate(wrap.s, u), t = WrapCoordinate(wrap.t, hn::Sub(Set(1.0f), v));
  if (light.lookup.filter == TextureFilter::kPoint) {
    return WrappedTexel(light.image, wrap, level, FloorToInt(hn::Mul(s, ToFloat(level.width))),
                        FloorToInt(hn::Mul(t, ToFloat(level.height))));
  }
  return BilinearTexel(light.image, wrap, level, s, t);
}

// The image at (s, t), t from the top, as wide as `width` of its side.
HWY_INLINE Rgb FilterImage(const ImageView& image, ImageWrap wrap, TextureFilter filter, F32 s,
                           F32 t, F32 width) {
  const uint32_t last = image.level_count - 1;
  const uint32_t side = HWY_MAX(image.levels[0].width, image.levels[0].height);
  const F32 texels = hn::Mul(width, Set(static_cast<float>(side)));
  const F32 level =
      hn::Min(hn::Log2(D(), hn::Max(texels, Set(1.0f))), Set(static_cast<float>(last)));
  const U32 whole = hn::BitCast(DU(), hn::ConvertTo(DI(), level));
  const F32 u = WrapCoordinate(wrap.s, s), v = WrapCoordinate(wrap.t, t);
  const LevelLanes at = GatherLevel(image, whole);
  if (filter == TextureFilter::kPoint) {
    return WrappedTexel(image, wrap, at, FloorToInt(hn::Mul(u, ToFloat(at.width))),
                        FloorToInt(hn::Mul(v, ToFloat(at.height))));
  }
  const Rgb sharp = BilinearTexel(image, wrap, at, u, v);
  if (filter == TextureFilter::kBilinear) return sharp;
  const F32 part = hn::Sub(level, hn::Floor(level));
  if (hn::AllTrue(D(), hn::Eq(part, hn::Zero(D())))) return sharp;
  const U32 next = hn::Min(hn::Add(whole, SetU(1)), SetU(last));
  const Rgb blurred = BilinearTexel(image, wrap, GatherLevel(image, next), u, v);
  return Add(Scale(hn::Sub(Set(1.0f), part), sharp), Scale(part, blurred));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_FILTER_INL_H_
