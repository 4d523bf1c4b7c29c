// A single ray that has come to an instance in, the same ray in the space of the instance's object
// out; and back.
#if defined(SWELL_KERNELS_ENTER_INSTANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_ENTER_INSTANCE_INL_H_
#undef SWELL_KERNELS_ENTER_INSTANCE_INL_H_
#else
#define SWELL_KERNELS_ENTER_INSTANCE_INL_H_
#endif

#include "kernels/single_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Children that wait and where the ray enters them, the next one last.
struct SingleStack {
  uint32_t child[kMaxBvhStack + kBvhWidth];  // whole vectors are pushed
  float enter[kMaxBvhStack + kBvhWidth];
  SingleRay world;  // the ray as it was when it entered an instance
};

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Vec3T<V> RowOf(DT dt, const Vec3Fields<In>& c, size_t row) {
  return {hn::Set(dt, c.x[row]), hn::Set(dt, c.y[row]), hn::Set(dt, c.z[row])};
}

// box: lower x, y, z, upper x, y, z.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Interval<V> CrossOneBox(DT dt, const SingleRay& ray, const float* box) {
  const auto plane = [&](uint32_t k, bool far) {
    return hn::Set(dt, box[(far ? ray.planes.far[k] : ray.planes.near[k]) / kBvhWidth]);
  };
  const Vec3T<V> near = {plane(0, false), plane(1, false), plane(2, false)};
  const Vec3T<V> far = {plane(0, true), plane(1, true), plane(2, true)};
  return CrossBox(SlabsOf(dt, ray), near, far, hn::Zero(dt), InfinityOf(dt));
}

template <class V> HWY_INLINE void PutLanes(const Vec3T<V>& v, float (&to)[3]) {
  to[0] = hn::GetLane(v.x);
  to[1] = hn::GetLane(v.y);
  to[2] = hn::GetLane(v.z);
}

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE void SetUpSpace(DT dt, const BvhView& bvh, const Vec3T<V>& org, const Vec3T<V>& dir,
                           SingleRay& ray) {
  const Vec3T<V> inv = Inverse(dt, dir);
  const Slabs<V> slabs = MakeSlabs(dt, bvh, org, inv);
  const auto axis = DominantAxisOf(dir);
  const ShearRay<V> shear = MakeShear(axis, org, dir, inv);
  PutLanes(slabs.inv, ray.inv);
  PutLanes(slabs.near_bias, ray.near_bias);
  PutLanes(slabs.far_bias, ray.far_bias);
  PutLanes(Vec3T<V>{shear.org_x, shear.org_y, shear.org_z}, ray.shear_org);
  PutLanes(Vec3T<V>{shear.shear_x, shear.shear_y, shear.inv_z}, ray.shear);
  ray.columns = kVertexColumns[hn::AllTrue(dt, axis.is_x) ? 0 : hn::AllTrue(dt, axis.is_y) ? 1 : 2];
  uint32_t octant = 0;
  for (uint32_t k = 0; k < 3; ++k) octant |= (ray.inv[k] < 0.0f ? 1u : 0u) << k;
  ray.planes = kRayPlanes[octant];
}

// Moves the ray to the space of the instance that it has come to, and makes its object's root the
// child that waits next. If it misses the instance's box, nothing.
HWY_NOINLINE inline void EnterInstance(const BvhView& bvh, const RayColumns& in, SingleRay& ray,
                                       SingleStack& stack) {
  const hn::CappedTag<float, 1> d1;
  using V = hn::Vec<decltype(d1)>;
  const uint32_t index = ray.current & kSphereIndexMask;
  float bounds[6];
  BoxOfInstance(bvh, index, bounds);
  const Interval<V> box = CrossOneBox(d1, ray, bounds);
  const float enter = hn::GetLane(box.enter);
  if (!(enter <= hn::GetLane(box.leave)) || enter > ray.best.t) return;
  const InstanceRecord& instance = bvh.instances[index];
  Vec3T<V> org = RowOf(d1, in.org, ray.row), dir = RowOf(d1, in.dir, ray.row);
  MoveToObject(d1, instance, org, dir);
  if (hn::AllFalse(d1, IsFinite(d1, org, dir))) return;

  stack.world = ray;
  SetUpSpace(d1, bvh, org, dir, ray);
  ray.inside = index;
  ray.enter = enter;
  ray.bottom = ray.stack_size;
  stack.child[ray.stack_size] = bvh.objects[instance.object].root;
  stack.enter[ray.stack_size] = enter;
  ++ray.stack_size;
}

HWY_INLINE void LeaveInstance(SingleRay& ray, const SingleStack& stack) {
  const SingleHit best = ray.best;
  ray = stack.world;
  ray.best = best;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_ENTER_INSTANCE_INL_H_
