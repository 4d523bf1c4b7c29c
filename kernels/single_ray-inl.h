// A vector of rays that are set up in, one of them out, ready for traversal.
#if defined(SWELL_KERNELS_SINGLE_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SINGLE_RAY_INL_H_
#undef SWELL_KERNELS_SINGLE_RAY_INL_H_
#else
#define SWELL_KERNELS_SINGLE_RAY_INL_H_
#endif

#include <array>

#include "kernels/visit_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Lanes over children and triangles, in both widths: one row at a time is what one_lane means.
using DB = hn::CappedTag<float, kBvhWidth>;
using FB = hn::Vec<DB>;
using MaskB = hn::Mask<DB>;
static_assert(kBvhWidth == kBlockWidth, "one tag serves both");

// Where a ray of an octant finds the planes it meets first and last: floats from the beginning of
// columns such as BvhNode::bounds.
struct RayPlanes {
  uint8_t near[3], far[3];
  uint8_t octant;  // as BvhNode::order
  uint8_t unused;
};

inline constexpr std::array<RayPlanes, 8> kRayPlanes = [] {
  std::array<RayPlanes, 8> planes{};
  for (uint32_t octant = 0; octant < 8; ++octant) {
    planes[octant].octant = static_cast<uint8_t>(octant);
    for (uint32_t k = 0; k < 3; ++k) {
      const bool negative = ((octant >> k) & 1) != 0;
      planes[octant].near[k] = static_cast<uint8_t>(kBvhWidth * (negative ? k + 3 : k));
      planes[octant].far[k] = static_cast<uint8_t>(kBvhWidth * (negative ? k : k + 3));
    }
  }
  return planes;
}();

// Where a ray whose dominant axis is z_axis finds its x, y and z: floats from the beginning of a
// TriangleBlock's vertex.
struct VertexColumns {
  uint8_t x, y, z, unused;
};

inline constexpr VertexColumns kVertexColumns[3] = {
    {kBlockWidth, 2 * kBlockWidth, 0, 0},
    {2 * kBlockWidth, 0, kBlockWidth, 0},
    {0, kBlockWidth, 2 * kBlockWidth, 0},
};

struct alignas(64) SingleRay {
  float inv[3], near_bias[3], far_bias[3];
  RayPlanes planes;
  VertexColumns columns;
  uint32_t current;     // child reference to visit next
  uint32_t stack_size;  // entries that wait
  uint32_t bottom;      // stack entries of the world while inside of an instance; else 0
  SingleHit best;
  float shear_org[3], shear[3];
  uint32_t inside;  // as PacketRays::inside
  float enter;      // as PacketRays::enter
  size_t row;
};
static_assert(sizeof(SingleRay) == 128, "two cache lines");

// The set-up of one vector of rays, to be picked up one by one.
struct RayBatch {
  alignas(64) float inv[3][kPacketRows], near_bias[3][kPacketRows], far_bias[3][kPacketRows];
  alignas(64) float shear_org[3][kPacketRows], shear[3][kPacketRows];
  alignas(64) uint32_t z_axis[kPacketRows], octant[kPacketRows];

  HWY_INLINE void Fill(const PacketRays& rays) {
    Put(rays.slabs.inv, inv);
    Put(rays.slabs.near_bias, near_bias);
    Put(rays.slabs.far_bias, far_bias);
    Put({rays.shear.org_x, rays.shear.org_y, rays.shear.org_z}, shear_org);
    Put({rays.shear.shear_x, rays.shear.shear_y, rays.shear.inv_z}, shear);
    const DominantAxis<MaskU> dominant = {ToUintMask(rays.axis.is_x), ToUintMask(rays.axis.is_y)};
    const U32 axis = Permute(dominant, SetU(0), SetU(1), SetU(2));
    hn::Store(axis, DU(), z_axis);
    hn::Store(OctantOf(rays.slabs.inv), DU(), octant);
  }

  HWY_INLINE ShearRay<FB> ShearOf(size_t i) const {
    const auto value = [i](const float(&of)[kPacketRows]) { return hn::Set(DB(), of[i]); };
    return {value(shear_org[0]), value(shear_org[1]), value(shear_org[2]),
            value(shear[0]),     value(shear[1]),     value(shear[2])};
  }

  HWY_INLINE void Take(size_t i, SingleRay& ray) const {
    for (uint32_t k = 0; k < 3; ++k) {
      ray.inv[k] = inv[k][i];
      ray.near_bias[k] = near_bias[k][i];
      ray.far_bias[k] = far_bias[k][i];
      ray.shear_org[k] = shear_org[k][i];
      ray.shear[k] = shear[k][i];
    }
    ray.columns = kVertexColumns[z_axis[i]];
    ray.planes = kRayPlanes[octant[i]];
  }

 private:
  static HWY_INLINE void Put(const Vec3& v, float (&columns)[3][kPacketRows]) {
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

HWY_INLINE ShearRay<FB> ShearOf(const SingleRay& ray) {
  const Vec3T<FB> org = Spread(DB(), ray.shear_org), slope = Spread(DB(), ray.shear);
  return {org.x, org.y, org.z, slope.x, slope.y, slope.z};
}

// Columns of boxes, those of the planes that are asked for.
HWY_INLINE Vec3T<FB> PlanesAt(const float* bounds, const uint8_t (&planes)[3]) {
  const DB db;
  return {hn::Load(db, bounds + planes[0]), hn::Load(db, bounds + planes[1]),
          hn::Load(db, bounds + planes[2])};
}

// A choice that never becomes a branch.
template <class T> HWY_INLINE T Chosen(bool chosen, T yes, T no) {
  const uint32_t mask = uint32_t{0} - static_cast<uint32_t>(chosen);
  uint32_t y, n;
  static_assert(sizeof(T) == sizeof(y));
  hwy::CopyBytes<4>(&yes, &y);
  hwy::CopyBytes<4>(&no, &n);
  n ^= (y ^ n) & mask;
  hwy::CopyBytes<4>(&n, &no);
  return no;
}

// The tests of one ray against a leaf.
HWY_INLINE void CountLeaf(uint32_t child, LaneUse& use) {
  use.active += (child & kSphereLeafBit) != 0 ? 1 : LeafCount(child);
  use.issued += kBlockWidth;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SINGLE_RAY_INL_H_
