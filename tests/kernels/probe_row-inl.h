// One vector of rows of a probe's columns, read and written by lanes.
#if defined(SWELL_TESTS_KERNELS_PROBE_ROW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TESTS_KERNELS_PROBE_ROW_INL_H_
#undef SWELL_TESTS_KERNELS_PROBE_ROW_INL_H_
#else
#define SWELL_TESTS_KERNELS_PROBE_ROW_INL_H_
#endif

#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct ProbeRow {
  const ProbeArgs& args;
  size_t i;

  HWY_INLINE U32 Word(size_t c) const { return Load(args.in[c], i); }
  HWY_INLINE F32 Float(size_t c) const { return FromBits(Word(c)); }
  HWY_INLINE Vec3 Vector(size_t c) const { return {Float(c), Float(c + 1), Float(c + 2)}; }
  HWY_INLINE void Put(size_t c, U32 v) const { Store(v, args.out[c], i); }
  HWY_INLINE void Put(size_t c, F32 v) const { Put(c, Bits(v)); }
  HWY_INLINE void Put(size_t c, const Vec3& v) const {
    Put(c, v.x);
    Put(c + 1, v.y);
    Put(c + 2, v.z);
  }
  HWY_INLINE void Put(size_t c, const Rgb& v) const { Put(c, Vec3{v.r, v.g, v.b}); }
  // Index columns beyond the count are scratch: they must not be followed.
  HWY_INLINE U32 Index(size_t c) const {
    return hn::IfThenElseZero(ToUintMask(FirstLanes(args.count - i)), Word(c));
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_TESTS_KERNELS_PROBE_ROW_INL_H_
