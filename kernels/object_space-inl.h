// A ray and an instance in, the ray in the space of the instance's object out. Its direction is not
// normalised, so that t means the same in both spaces.
//
// Why every traversal finds the same hit: as in triangle-inl.h, with the instance's own box as one
// more box above its primitives. A hit is no nearer than the computed entry into that box, which
// all boxes above it contain exactly; a ray that misses the box has no hit in the instance.
//
// The ray's own rounding here is not covered by any box: with r = 2^-24, the point is off by at
// most 4 r |to_object| |org - centre|, the direction by 3 r |to_object| |dir|. So a mesh is
// watertight within an instance, since all its triangles see one ray, but not between two
// instances.
#if defined(SWELL_KERNELS_OBJECT_SPACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_OBJECT_SPACE_INL_H_
#undef SWELL_KERNELS_OBJECT_SPACE_INL_H_
#else
#define SWELL_KERNELS_OBJECT_SPACE_INL_H_
#endif

#include "kernels/instance_box.h"
#include "kernels/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE void MoveToObject(DT dt, const InstanceRecord& instance, Vec3T<V>& org, Vec3T<V>& dir) {
  const float* m = instance.to_object;
  const float* c = instance.centre;
  const Rows<V> rows = {{hn::Set(dt, m[0]), hn::Set(dt, m[1]), hn::Set(dt, m[2])},
                        {hn::Set(dt, m[3]), hn::Set(dt, m[4]), hn::Set(dt, m[5])},
                        {hn::Set(dt, m[6]), hn::Set(dt, m[7]), hn::Set(dt, m[8])}};
  const Vec3T<V> from = Sub(org, {hn::Set(dt, c[0]), hn::Set(dt, c[1]), hn::Set(dt, c[2])});
  org = {Dot(rows.x, from), Dot(rows.y, from), Dot(rows.z, from)};
  dir = {Dot(rows.x, dir), Dot(rows.y, dir), Dot(rows.z, dir)};
}

// The box of an instance in the world: lower x, y, z, upper x, y, z.
HWY_INLINE void BoxOfInstance(const BvhView& bvh, uint32_t index, float (&bounds)[6]) {
  const InstanceRecord& instance = bvh.instances[index];
  InstanceBox(instance, bvh.objects[instance.object], bounds);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_OBJECT_SPACE_INL_H_
