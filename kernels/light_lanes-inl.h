// Lights as lanes: the words of their records, and what drawing one gives.
#if defined(SWELL_KERNELS_LIGHT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LIGHT_LANES_INL_H_
#undef SWELL_KERNELS_LIGHT_LANES_INL_H_
#else
#define SWELL_KERNELS_LIGHT_LANES_INL_H_
#endif

#include <cstddef>

#include "kernels/lanes-inl.h"
#include "kernels/scene_view.h"
#include "kernels/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Words of rows of records, gathered.
template <class Record> class RecordLanes {
 public:
  RecordLanes(const Record* records, U32 row)
      : floats_(reinterpret_cast<const float*>(records)),
        words_(reinterpret_cast<const uint32_t*>(records)),
        at_(hn::Mul(row, SetU(sizeof(Record) / 4))) {}

  HWY_INLINE U32 Word(size_t offset) const { return Gather(words_ + offset / 4, at_); }
  HWY_INLINE F32 Float(size_t offset) const { return Gather(floats_ + offset / 4, at_); }
  HWY_INLINE Vec3 Vector(size_t offset) const {
    return {Float(offset), Float(offset + 4), Float(offset + 8)};
  }

 private:
  const float* floats_;
  const uint32_t* words_;
  U32 at_;
};

struct LightLanes : RecordLanes<LightRecord> {
  LightLanes(const LightsView& lights, U32 light) : RecordLanes(lights.records, light) {}

  HWY_INLINE U32 type() const { return Word(offsetof(LightRecord, type)); }
  HWY_INLINE Mask two_sided() const { return Flag(kLightTwoSided); }
  HWY_INLINE Mask inward() const { return Flag(kLightInward); }
  HWY_INLINE Mask pictured() const { return Flag(kLightPictured); }
  HWY_INLINE Mask unseen() const { return Flag(kLightUnseen); }
  HWY_INLINE Rgb radiance() const {
    const Vec3 v = Vector(offsetof(LightRecord, radiance));
    return {v.x, v.y, v.z};
  }

 private:
  HWY_INLINE Mask Flag(uint32_t flag) const {
    return ToFloatMask(hn::TestBit(Word(offsetof(LightRecord, flags)), SetU(flag)));
  }
};

HWY_INLINE Mask IsType(U32 type, LightType which) { return ToFloatMask(hn::Eq(type, SetU(which))); }

inline constexpr float kInvTwoPi = 0.159154943f;
inline constexpr float kInvFourPi = 0.0795774715f;

// Densities beyond this are those of points seen edge-on or touching the light: void.
inline constexpr float kLargestPdf = 1e30f;

// A drawn light: the shadow ray from `origin` ends at org + t_max * dir.
struct LightSample {
  Vec3 wi;   // unit, towards the light
  Vec3 end;  // the point on the light, moved off its surface; not for directions
  Mask at_infinity;
  Rgb radiance;   // arriving along wi; 0 if the light does not shine here
  F32 pdf;        // solid angle, times the probability of the light; 0 if void
  Mask is_delta;  // BSDF sampling cannot find it: a point, a direction, an unseen surface
};

// Where a shadow ray from `from` ends before a light's point p. The light must not block its own
// light: the test may see its surface at a distance that is off by 18 roundings of the largest
// coordinate of anything seen from the ray's origin (see triangle-inl.h), `extent` beyond p, and
// the ray's direction is rounded too; 32 let the bounds of a bundle, which are wider, see that the
// rays end before the light (see cross_bundle-inl.h). `error` is that of p itself, which is nothing
// along an axis in which p's coordinates are 0.
HWY_INLINE Vec3 ShadowRayEnd(const Vec3& p, const Vec3& error, const Vec3& n, const Vec3& from,
                             F32 extent) {
  const Vec3 to_from = Sub(from, p);
  const F32 seen = hn::Mul(Set(Gamma(32)), hn::Add(MaxComponent(Abs(to_from)), extent));
  return OffsetOrigin(p, Add(error, {seen, seen, seen}), n, to_from);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LIGHT_LANES_INL_H_
