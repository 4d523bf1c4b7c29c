// Rays and a tree in, the least hit or any hit of every ray out: what the two kernels of traversal
// share. A ray's set-up, and many rays against one node (packet); one ray against all children of
// a node is in visit_single-inl.h.
#if defined(SWELL_KERNELS_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRAVERSE_INL_H_
#undef SWELL_KERNELS_TRAVERSE_INL_H_
#else
#define SWELL_KERNELS_TRAVERSE_INL_H_
#endif

#include "kernels/triangle-inl.h"

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
  Mask z_is_x, z_is_y;                      // the dominant axis; neither: z
  F32 t;     // no hit beyond this counts (closest: at this counts); below zero: the ray has ended
  U32 prim;  // of the best hit
  F32 u, v, weights;  // the weights of its 2nd and 3rd vertex, and of all three
};

// The largest 1 / |dir| that cannot overflow a slab's distance.
HWY_INLINE F32 InverseLimit(F32 reach) {
  return hn::Div(Set(0x1p125f), hn::Max(reach, Set(0x1p29f)));
}

HWY_INLINE F32 LimitedInverse(F32 dir, F32 limit) {
  return hn::CopySign(hn::Min(hn::Abs(hn::Div(Set(1.0f), dir)), limit), dir);
}

HWY_INLINE F32 Permute(const PacketRays& rays, F32 if_x, F32 if_y, F32 if_z) {
  return hn::IfThenElse(rays.z_is_x, if_x, hn::IfThenElse(rays.z_is_y, if_y, if_z));
}

HWY_INLINE void SetUpSlabs(const BvhView& bvh, PacketRays& rays) {
  const Vec3 abs_org = Abs(rays.org);
  const F32 farthest = hn::Max(abs_org.x, hn::Max(abs_org.y, abs_org.z));
  const F32 limit = InverseLimit(hn::Add(farthest, Set(bvh.max_abs_coord)));
  const Vec3 inv = {LimitedInverse(rays.dir.x, limit), LimitedInverse(rays.dir.y, limit),
                    LimitedInverse(rays.dir.z, limit)};
  const Vec3 bias = Neg(Mul(rays.org, inv));
  const Vec3 margin = Scale(hn::Mul(farthest, Set(kBoxMargin)), Abs(inv));
  rays.slabs = {inv, Sub(bias, margin), Add(bias, margin)};
  rays.negative_x = hn::Lt(inv.x, hn::Zero(D()));
  rays.negative_y = hn::Lt(inv.y, hn::Zero(D()));
  rays.negative_z = hn::Lt(inv.z, hn::Zero(D()));
}

HWY_INLINE void SetUpShear(PacketRays& rays) {
  const Vec3 dir = Abs(rays.dir);
  rays.z_is_x = hn::And(hn::Ge(dir.x, dir.y), hn::Ge(dir.x, dir.z));
  rays.z_is_y = AndNot(rays.z_is_x, hn::Ge(dir.y, dir.z));
  const F32 dir_z = Permute(rays, rays.dir.x, rays.dir.y, rays.dir.z);
  rays.shear = {Permute(rays, rays.org.y, rays.org.z, rays.org.x),
                Permute(rays, rays.org.z, rays.org.x, rays.org.y),
                Permute(rays, rays.org.x, rays.org.y, rays.org.z),
                hn::Div(Permute(rays, rays.dir.y, rays.dir.z, rays.dir.x), dir_z),
                hn::Div(Permute(rays, rays.dir.z, rays.dir.x, rays.dir.y), dir_z),
                hn::Div(Set(1.0f), dir_z)};
}

// Rows [row, row + Lanes). Rows beyond the count and rays that are not finite have ended.
HWY_INLINE PacketRays SetUpRays(const BvhView& bvh, const RayColumns& in, size_t row) {
  PacketRays rays;
  rays.org = Load(in.org, row);
  rays.dir = Load(in.dir, row);
  SetUpSlabs(bvh, rays);
  SetUpShear(rays);

  const F32 most = Set(0x1.fffffep127f);
  const Vec3 org = Abs(rays.org), dir = Abs(rays.dir);
  const Mask finite = hn::And(
      hn::And(hn::And(hn::Le(org.x, most), hn::Le(org.y, most)),
              hn::And(hn::Le(org.z, most), hn::Le(dir.x, most))),
      hn::And(hn::And(hn::Le(dir.y, most), hn::Le(dir.z, most)), FirstLanes(in.count - row)));
  // A hit at infinity is none: the closest hit starts just below it.
  const F32 t = in.t_max == nullptr ? most : Load(in.t_max, row);
  rays.t = hn::IfThenElse(hn::And(finite, hn::Ge(t, hn::Zero(D()))), t, Set(-1.0f));
  rays.prim = SetU(kNoPrim);
  rays.u = hn::Zero(D());
  rays.v = hn::Zero(D());
  rays.weights = Set(1.0f);
  return rays;
}

// ---------------------------------------------------------------- packet
HWY_INLINE uint64_t CountLanes(Mask mask) { return hn::CountTrue(D(), mask); }

// Which hits count: for any hit those before t, for the closest those that are less in (t, prim).
template <bool kAny> HWY_INLINE Mask Accepts(const PacketRays& rays, F32 t, U32 prim) {
  const Mask ahead = hn::Gt(t, hn::Zero(D()));
  if (kAny) return hn::And(ahead, hn::Lt(t, rays.t));
  const Mask tie = hn::And(hn::Eq(t, rays.t), ToFloatMask(hn::Lt(prim, rays.prim)));
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
}

template <class DT> HWY_INLINE hn::Vec<DT> InfinityOf(DT dt) {
  return hn::BitCast(dt, hn::Set(hn::RebindToUnsigned<DT>(), 0x7F800000u));
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
  return ShearVertex(rays.shear, Permute(rays, y, z, x), Permute(rays, z, x, y),
                     Permute(rays, x, y, z));
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
    Mask hit = Inside(D(), EdgeFunctions(a, b, c));
    if (hn::AllFalse(D(), hit)) continue;

    const Edges<F32> edges = ExactEdges(D(), a, b, c);
    hit = hn::And(hit, Inside(D(), edges));
    const F32 on_plane = TriangleDistance(rays.shear, edges, a.z, b.z, c.z);
    hit = hn::And(hit, hn::And(hn::Gt(on_plane, hn::Zero(D())), hn::Le(on_plane, rays.t)));
    if (hn::AllFalse(D(), hit)) continue;

    if (!have_bounds) BlockBoxes(block, bounds);
    have_bounds = true;
    const F32 t =
        ClampToBox(CrossBoxOf(rays, &bounds[0][i], kBlockWidth, InfinityOf(D())), on_plane, hit);
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
  const F32 t = ClampToBox(box, on_surface, hit);
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

template <bool kAny>
HWY_INLINE void TracePacket(const BvhView& bvh, PacketRays& rays, LaneUse& use) {
  const size_t lanes = hn::Lanes(D());
  PacketStack stack;
  stack.Push(0, hn::Zero(D()));
  while (stack.size > 0) {
    --stack.size;
    const uint32_t child = stack.child[stack.size];
    const Mask active = hn::Le(hn::Load(D(), stack.enter[stack.size]), rays.t);
    if (hn::AllFalse(D(), active)) continue;
    uint32_t tests = 1;
    if ((child & kLeafBit) == 0) {
      tests = bvh.nodes[child].child_count;
      PushChildren(rays, bvh.nodes[child], stack);
    } else if ((child & kSphereLeafBit) != 0) {
      HitSphere<kAny>(rays, bvh, child & kSphereIndexMask);
    } else {
      tests = LeafCount(child);
      HitBlock<kAny>(rays, bvh.blocks[LeafBlock(child)], tests);
    }
    use.active += tests * CountLanes(active);
    use.issued += tests * lanes;
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRAVERSE_INL_H_
