// Rays and a tree in, the least hit or any hit of every ray out: what the two kernels of traversal
// share. Many rays against one node (packet); one ray against all children of a node is in
// visit_single-inl.h.
#if defined(SWELL_KERNELS_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRAVERSE_INL_H_
#undef SWELL_KERNELS_TRAVERSE_INL_H_
#else
#define SWELL_KERNELS_TRAVERSE_INL_H_
#endif

#include "kernels/instance_box.h"
#include "kernels/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The rows a call traces. t_max is null for closest hits.
struct RayColumns {
  Vec3Fields<In> org, dir;
  const float* t_max;
  size_t count;
};

// A vector of rays, ready for traversal.
struct PacketRays {
  Vec3 org, dir;
  Slabs<F32> slabs;
  ShearRay<F32> shear;
  Mask negative_x, negative_y, negative_z;  // signs of slabs.inv
  DominantAxis<Mask> axis;
  uint32_t inside;  // the instance in whose space the rays are; kNone: the world
  F32 enter;        // where they enter it: no hit in it is nearer; in the world 0
  F32 t;     // no hit beyond this counts (closest: at this counts); below zero: the ray has ended
  U32 prim;  // of the best hit
  F32 u, v, weights;  // the weights of its 2nd and 3rd vertex, and of all three
  U32 instance;       // of the best hit
};

HWY_INLINE void SetUpSpace(const BvhView& bvh, PacketRays& rays) {
  rays.slabs = MakeSlabs(D(), bvh, rays.org, rays.dir);
  rays.negative_x = hn::Lt(rays.slabs.inv.x, hn::Zero(D()));
  rays.negative_y = hn::Lt(rays.slabs.inv.y, hn::Zero(D()));
  rays.negative_z = hn::Lt(rays.slabs.inv.z, hn::Zero(D()));
  rays.axis = DominantAxisOf(rays.dir);
  rays.shear = MakeShear(D(), rays.axis, rays.org, rays.dir);
}

// Rows [row, row + Lanes). Rows beyond the count and rays that are not finite have ended.
HWY_INLINE PacketRays SetUpRays(const BvhView& bvh, const RayColumns& in, size_t row) {
  PacketRays rays;
  rays.org = Load(in.org, row);
  rays.dir = Load(in.dir, row);
  SetUpSpace(bvh, rays);
  rays.inside = kNone;
  rays.enter = hn::Zero(D());

  const Mask finite = hn::And(IsFinite(D(), rays.org, rays.dir), FirstLanes(in.count - row));
  // A hit at infinity is none: the closest hit starts just below it.
  const F32 t = in.t_max == nullptr ? Set(kMostFinite) : Load(in.t_max, row);
  rays.t = hn::IfThenElse(hn::And(finite, hn::Ge(t, hn::Zero(D()))), t, Set(-1.0f));
  rays.prim = SetU(kNoPrim);
  rays.u = hn::Zero(D());
  rays.v = hn::Zero(D());
  rays.weights = Set(1.0f);
  rays.instance = SetU(kNone);
  return rays;
}

// ---------------------------------------------------------------- packet
HWY_INLINE uint64_t CountLanes(Mask mask) { return hn::CountTrue(D(), mask); }

// Which hits count: for any hit those before t, for the closest those that are less in (t,
// instance, prim).
template <bool kAny> HWY_INLINE Mask Accepts(const PacketRays& rays, F32 t, U32 prim) {
  const Mask ahead = hn::Gt(t, hn::Zero(D()));
  if (kAny) return hn::And(ahead, hn::Lt(t, rays.t));
  const U32 inside = SetU(rays.inside);
  const MaskU less = hn::Or(hn::Lt(inside, rays.instance),
                            hn::And(hn::Eq(inside, rays.instance), hn::Lt(prim, rays.prim)));
  const Mask tie = hn::And(hn::Eq(t, rays.t), ToFloatMask(less));
  return hn::And(ahead, hn::Or(hn::Lt(t, rays.t), tie));
}

template <bool kAny>
HWY_INLINE void Accept(PacketRays& rays, Mask hit, F32 t, U32 prim, F32 u, F32 v, F32 weights) {
  if (kAny) {
    rays.t = hn::IfThenElse(hit, Set(-1.0f), rays.t);
    rays.prim = hn::IfThenElse(ToUintMask(hit), prim, rays.prim);
    return;
  }
  rays.t = hn::IfThenElse(hit, t, rays.t);
  rays.prim = hn::IfThenElse(ToUintMask(hit), prim, rays.prim);
  rays.u = hn::IfThenElse(hit, u, rays.u);
  rays.v = hn::IfThenElse(hit, v, rays.v);
  rays.weights = hn::IfThenElse(hit, weights, rays.weights);
  rays.instance = hn::IfThenElse(ToUintMask(hit), SetU(rays.inside), rays.instance);
}

// bounds: six columns lower x, y, z, upper x, y, z, `stride` floats apart.
HWY_INLINE Interval<F32> CrossBoxOf(const PacketRays& rays, const float* bounds, size_t stride,
                                    F32 last) {
  const Vec3 lower = {Set(bounds[0]), Set(bounds[stride]), Set(bounds[2 * stride])};
  const Vec3 upper = {Set(bounds[3 * stride]), Set(bounds[4 * stride]), Set(bounds[5 * stride])};
  const Vec3 near = {hn::IfThenElse(rays.negative_x, upper.x, lower.x),
                     hn::IfThenElse(rays.negative_y, upper.y, lower.y),
                     hn::IfThenElse(rays.negative_z, upper.z, lower.z)};
  const Vec3 far = {hn::IfThenElse(rays.negative_x, lower.x, upper.x),
                    hn::IfThenElse(rays.negative_y, lower.y, upper.y),
                    hn::IfThenElse(rays.negative_z, lower.z, upper.z)};
  return CrossBox(rays.slabs, near, far, hn::Zero(D()), last);
}

HWY_INLINE Vec3 PermutedVertex(const PacketRays& rays, const TriangleBlock& block, size_t vertex,
                               size_t i) {
  const F32 x = Set(block.vertex[vertex][0][i]);
  const F32 y = Set(block.vertex[vertex][1][i]);
  const F32 z = Set(block.vertex[vertex][2][i]);
  return ShearVertex(rays.shear, Permute(rays.axis, y, z, x), Permute(rays.axis, z, x, y),
                     Permute(rays.axis, x, y, z));
}

// The widened boxes of a block's triangles, columns as in BvhNode::bounds.
HWY_INLINE void BlockBoxes(const TriangleBlock& block, float (&bounds)[6][kBlockWidth]) {
  const hn::CappedTag<float, kBlockWidth> db;
  using V = hn::Vec<decltype(db)>;
  for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(db)) {
    Vec3T<V> vertex[3];
    for (size_t k = 0; k < 3; ++k) {
      vertex[k] = {hn::Load(db, block.vertex[k][0] + i), hn::Load(db, block.vertex[k][1] + i),
                   hn::Load(db, block.vertex[k][2] + i)};
    }
    const Box<V> box = TriangleBox(db, vertex[0], vertex[1], vertex[2]);
    hn::Store(box.lower.x, db, bounds[0] + i);
    hn::Store(box.lower.y, db, bounds[1] + i);
    hn::Store(box.lower.z, db, bounds[2] + i);
    hn::Store(box.upper.x, db, bounds[3] + i);
    hn::Store(box.upper.y, db, bounds[4] + i);
    hn::Store(box.upper.z, db, bounds[5] + i);
  }
}

template <bool kAny>
HWY_INLINE void HitBlock(PacketRays& rays, const TriangleBlock& block, uint32_t count) {
  alignas(64) float bounds[6][kBlockWidth];
  bool have_bounds = false;
  for (uint32_t i = 0; i < count; ++i) {
    const Vec3 a = PermutedVertex(rays, block, 0, i);
    const Vec3 b = PermutedVertex(rays, block, 1, i);
    const Vec3 c = PermutedVertex(rays, block, 2, i);
    const Edges<F32> edges = EdgeFunctions(a, b, c);
    Mask hit = Inside(D(), edges);
    if (hn::AllFalse(D(), hit)) continue;

    const F32 on_plane = TriangleDistance(rays.shear, edges, a.z, b.z, c.z);
    hit = hn::And(hit, hn::And(hn::Gt(on_plane, hn::Zero(D())), hn::Le(on_plane, rays.t)));
    if (hn::AllFalse(D(), hit)) continue;

    if (!have_bounds) BlockBoxes(block, bounds);
    have_bounds = true;
    const Interval<F32> box = CrossBoxOf(rays, &bounds[0][i], kBlockWidth, InfinityOf(D()));
    const F32 t = hn::Max(ClampToBox(box, on_plane, hit), rays.enter);
    const U32 prim = SetU(block.prim[i]);
    hit = hn::And(hit, Accepts<kAny>(rays, t, prim));
    Accept<kAny>(rays, hit, t, prim, edges.b, edges.c, edges.det);
  }
}

template <bool kAny>
HWY_INLINE void HitSphere(PacketRays& rays, const BvhView& bvh, uint32_t sphere) {
  const F32 on_surface = SphereDistance(D(), bvh.spheres[sphere], rays.org, rays.dir);
  Mask hit = hn::Gt(on_surface, hn::Zero(D()));
  const Interval<F32> box = CrossBoxOf(rays, bvh.sphere_boxes + 6 * sphere, 1, InfinityOf(D()));
  const F32 t = hn::Max(ClampToBox(box, on_surface, hit), rays.enter);
  const U32 prim = SetU(bvh.triangle_count + sphere);
  hit = hn::And(hit, Accepts<kAny>(rays, t, prim));
  Accept<kAny>(rays, hit, t, prim, hn::Zero(D()), hn::Zero(D()), Set(1.0f));
}

// Children and where each lane enters them; infinity for lanes that do not.
struct PacketStack {
  uint32_t child[kMaxBvhStack];
  alignas(64) float enter[kMaxBvhStack][hn::MaxLanes(D())];
  uint32_t size = 0;

  HWY_INLINE void Push(uint32_t ref, F32 at) {
    child[size] = ref;
    hn::Store(at, D(), enter[size]);
    ++size;
  }
};

// Pushes the children that a ray enters, nearest entry of the packet last.
HWY_INLINE void PushChildren(const PacketRays& rays, const BvhNode& node, PacketStack& stack) {
  alignas(64) float enter[kBvhWidth][hn::MaxLanes(D())];
  float nearest[kBvhWidth];
  uint32_t order[kBvhWidth];
  uint32_t count = 0;
  for (uint32_t i = 0; i < node.child_count; ++i) {
    const Interval<F32> box = CrossBoxOf(rays, &node.bounds[0][i], kBvhWidth, rays.t);
    const Mask hit = hn::Le(box.enter, box.leave);
    if (hn::AllFalse(D(), hit)) continue;
    const F32 at = hn::IfThenElse(hit, box.enter, InfinityOf(D()));
    hn::Store(at, D(), enter[i]);
    nearest[i] = hn::GetLane(hn::MinOfLanes(D(), at));
    uint32_t place = count++;
    for (; place > 0 && nearest[order[place - 1]] < nearest[i]; --place) {
      order[place] = order[place - 1];
    }
    order[place] = i;
  }
  for (uint32_t k = 0; k < count; ++k) {
    stack.Push(node.child[order[k]], hn::Load(D(), enter[order[k]]));
  }
}

// The rays in the space of an instance. Those that miss its box have ended there; returns the
// others.
HWY_INLINE Mask EnterInstance(const BvhView& bvh, uint32_t index, PacketRays& rays) {
  const InstanceRecord& instance = bvh.instances[index];
  float bounds[6];
  InstanceBox(instance, bvh.objects[instance.object], bounds);
  const Interval<F32> box = CrossBoxOf(rays, bounds, 1, InfinityOf(D()));
  MoveToObject(D(), instance, rays.org, rays.dir);
  SetUpSpace(bvh, rays);
  rays.inside = index;
  rays.enter = box.enter;
  const Mask enters = hn::And(hn::Le(box.enter, box.leave), IsFinite(D(), rays.org, rays.dir));
  rays.t = hn::IfThenElse(enters, rays.t, Set(-1.0f));
  return enters;
}

// Back to the world with the hits found inside.
HWY_INLINE void LeaveInstance(PacketRays& rays, const PacketRays& world, Mask entered) {
  PacketRays outside = world;
  outside.t = hn::IfThenElse(entered, rays.t, world.t);
  outside.prim = rays.prim;
  outside.u = rays.u;
  outside.v = rays.v;
  outside.weights = rays.weights;
  outside.instance = rays.instance;
  rays = outside;
}

template <bool kAny>
HWY_INLINE void TracePacket(const BvhView& bvh, PacketRays& rays, LaneUse& use) {
  const size_t lanes = hn::Lanes(D());
  PacketStack stack;
  stack.Push(0, hn::Zero(D()));
  PacketRays world = rays;
  Mask entered = FirstLanes(0);
  uint32_t bottom = 0;  // of the stack, for the space the rays are in
  while (true) {
    if (stack.size == bottom) {
      if (rays.inside == kNone) return;
      LeaveInstance(rays, world, entered);
      bottom = 0;
      continue;
    }
    --stack.size;
    const uint32_t child = stack.child[stack.size];
    const Mask active = hn::Le(hn::Load(D(), stack.enter[stack.size]), rays.t);
    if (hn::AllFalse(D(), active)) continue;
    uint32_t tests = 1;
    if ((child & kLeafBit) == 0) {
      tests = bvh.nodes[child].child_count;
      PushChildren(rays, bvh.nodes[child], stack);
    } else if ((child & kSphereLeafBit) == 0) {
      tests = LeafCount(child);
      HitBlock<kAny>(rays, bvh.blocks[LeafBlock(child)], tests);
    } else if ((child & kInstanceLeafBit) == 0) {
      HitSphere<kAny>(rays, bvh, child & kSphereIndexMask);
    } else {
      const uint32_t index = child & kSphereIndexMask;
      world = rays;
      entered = EnterInstance(bvh, index, rays);
      bottom = stack.size;
      stack.Push(bvh.objects[bvh.instances[index].object].root, rays.enter);
    }
    use.active += tests * CountLanes(active);
    use.issued += tests * lanes;
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRAVERSE_INL_H_
