// Rays in columns in, one ray at a time out, ready for traversal.
#if defined(SWELL_KERNELS_SINGLE_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SINGLE_RAY_INL_H_
#undef SWELL_KERNELS_SINGLE_RAY_INL_H_
#else
#define SWELL_KERNELS_SINGLE_RAY_INL_H_
#endif

#include "kernels/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Lanes over children and triangles, in both widths: one row at a time is what one_lane means.
using DB = hn::CappedTag<float, kBvhWidth>;
using FB = hn::Vec<DB>;
using MaskB = hn::Mask<DB>;
static_assert(kBvhWidth == kBlockWidth, "one tag serves both");

struct SingleHit {
  float t;  // as PacketRays::t
  uint32_t prim;
  float u, v;
  uint32_t instance;
};

struct alignas(64) SingleRay {
  float inv[3], near_bias[3], far_bias[3];
  uint32_t near_column[3];  // rows of BvhNode::bounds
  float shear_org[3], shear[3];
  uint32_t z_axis;
  uint32_t inside;  // as PacketRays::inside
  float enter;      // as PacketRays::enter
  uint32_t bottom;  // stack entries of the world while inside of an instance; else 0
  SingleHit best;
  uint32_t current;     // child reference to visit next
  uint32_t stack_size;  // entries that wait
  size_t row;
};

// The set-up of one vector of rays, to be picked up one by one.
struct RayBatch {
  static constexpr size_t kRows = hn::MaxLanes(D());
  alignas(64) float inv[3][kRows], near_bias[3][kRows], far_bias[3][kRows];
  alignas(64) float shear_org[3][kRows], shear[3][kRows], t[kRows];
  alignas(64) uint32_t z_axis[kRows];

  HWY_INLINE void Fill(const PacketRays& rays) {
    Put(rays.slabs.inv, inv);
    Put(rays.slabs.near_bias, near_bias);
    Put(rays.slabs.far_bias, far_bias);
    Put({rays.shear.org_x, rays.shear.org_y, rays.shear.org_z}, shear_org);
    Put({rays.shear.shear_x, rays.shear.shear_y, rays.shear.inv_z}, shear);
    hn::Store(rays.t, D(), t);
    const U32 axis =
        Permute(DominantAxis<MaskU>{ToUintMask(rays.axis.is_x), ToUintMask(rays.axis.is_y)},
                SetU(0), SetU(1), SetU(2));
    hn::Store(axis, DU(), z_axis);
  }

  HWY_INLINE void Take(size_t i, size_t row, SingleRay& ray) const {
    for (uint32_t k = 0; k < 3; ++k) {
      ray.inv[k] = inv[k][i];
      ray.near_bias[k] = near_bias[k][i];
      ray.far_bias[k] = far_bias[k][i];
      ray.near_column[k] = inv[k][i] < 0.0f ? k + 3 : k;
      ray.shear_org[k] = shear_org[k][i];
      ray.shear[k] = shear[k][i];
    }
    ray.z_axis = z_axis[i];
    ray.inside = kNone;
    ray.enter = 0.0f;
    ray.bottom = 0;
    ray.best = {t[i], kNoPrim, 0.0f, 0.0f, kNone};
    ray.current = 0;
    ray.stack_size = 0;
    ray.row = row;
  }

 private:
  static HWY_INLINE void Put(const Vec3& v, float (&columns)[3][kRows]) {
    hn::Store(v.x, D(), columns[0]);
    hn::Store(v.y, D(), columns[1]);
    hn::Store(v.z, D(), columns[2]);
  }
};

template <class DT, class V = hn::Vec<DT>> HWY_INLINE Vec3T<V> Spread(DT dt, const float (&v)[3]) {
  return {hn::Set(dt, v[0]), hn::Set(dt, v[1]), hn::Set(dt, v[2])};
}

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Slabs<V> SlabsOf(DT dt, const SingleRay& ray) {
  return {Spread(dt, ray.inv), Spread(dt, ray.near_bias), Spread(dt, ray.far_bias)};
}

HWY_INLINE uint32_t MaskBits(MaskB mask) {
  uint8_t bits[8] = {0};
  hn::StoreMaskBits(DB(), mask, bits);
  return bits[0];
}

// Hands out the rows of a call one by one, set up by vectors.
class RaySource {
 public:
  RaySource(const BvhView& bvh, const RayColumns& in) : bvh_(bvh), in_(in) {}

  // False if there is none left.
  HWY_INLINE bool Take(SingleRay& ray) {
    if (row_ == in_.count) return false;
    const size_t i = row_ % RayBatch::kRows;
    if (i == 0) batch_.Fill(SetUpRays(bvh_, in_, row_));
    batch_.Take(i, row_++, ray);
    return true;
  }

 private:
  const BvhView& bvh_;
  const RayColumns& in_;
  size_t row_ = 0;
  RayBatch batch_;
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SINGLE_RAY_INL_H_
