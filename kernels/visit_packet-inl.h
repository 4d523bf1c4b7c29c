// A packet of rays and a child of the tree in: all lanes against one block, sphere or node. Out
// come the lanes' best hits and the children that wait.
#if defined(SWELL_KERNELS_VISIT_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_VISIT_PACKET_INL_H_
#undef SWELL_KERNELS_VISIT_PACKET_INL_H_
#else
#define SWELL_KERNELS_VISIT_PACKET_INL_H_
#endif

#include "kernels/object_space-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// bounds: lower x, y, z, upper x, y, z.
HWY_INLINE Interval<F32> CrossBoxOf(const PacketRays& rays, const float* bounds, F32 last) {
  const Vec3 lower = {Set(bounds[0]), Set(bounds[1]), Set(bounds[2])};
  const Vec3 upper = {Set(bounds[3]), Set(bounds[4]), Set(bounds[5])};
  const Vec3 near = {hn::IfThenElse(rays.negative_x, upper.x, lower.x),
                     hn::IfThenElse(rays.negative_y, upper.y, lower.y),
                     hn::IfThenElse(rays.negative_z, upper.z, lower.z)};
  const Vec3 far = {hn::IfThenElse(rays.negative_x, lower.x, upper.x),
                    hn::IfThenElse(rays.negative_y, lower.y, upper.y),
                    hn::IfThenElse(rays.negative_z, lower.z, upper.z)};
  return CrossBox(rays.slabs, near, far, hn::Zero(D()), last);
}

// Box i of eight in columns, as BvhNode::bounds, for rays of one octant: all have the same near
// planes.
HWY_INLINE Interval<F32> CrossBoxOf(const PacketRays& rays, const float (&bounds)[6][kBvhWidth],
                                    size_t i, uint32_t octant, F32 last) {
  const uint32_t x = (octant & 1) != 0 ? 3 : 0, y = (octant & 2) != 0 ? 4 : 1;
  const uint32_t z = (octant & 4) != 0 ? 5 : 2;
  const Vec3 near = {Set(bounds[x][i]), Set(bounds[y][i]), Set(bounds[z][i])};
  const Vec3 far = {Set(bounds[3 - x][i]), Set(bounds[5 - y][i]), Set(bounds[7 - z][i])};
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

inline constexpr size_t kPacketRows = hn::MaxLanes(D());

struct SingleHit {
  float t;  // as PacketRays::t
  uint32_t prim;
  float u, v;  // weights of the 2nd and 3rd vertex
  uint32_t instance;
};

// The best hit of every lane, in memory: single rays work on lanes of a packet too.
struct LaneHits {
  alignas(64) float t[kPacketRows];  // as PacketRays::t
  alignas(64) uint32_t prim[kPacketRows];
  alignas(64) float u[kPacketRows], v[kPacketRows];  // weights of the 2nd and 3rd vertex
  alignas(64) uint32_t instance[kPacketRows];

  HWY_INLINE void Clear(F32 t_max) {
    hn::Store(t_max, D(), t);
    hn::Store(SetU(kNoPrim), DU(), prim);
    hn::Store(hn::Zero(D()), D(), u);
    hn::Store(hn::Zero(D()), D(), v);
    hn::Store(SetU(kNone), DU(), instance);
  }

  HWY_INLINE SingleHit Get(size_t i) const { return {t[i], prim[i], u[i], v[i], instance[i]}; }
  HWY_INLINE void Put(size_t i, float distance, const SingleHit& hit) {
    t[i] = distance;
    prim[i] = hit.prim;
    u[i] = hit.u;
    v[i] = hit.v;
    instance[i] = hit.instance;
  }
};

// Which hits count: for any hit those before t, for the closest those that are less in (t,
// instance, prim).
template <bool kAny>
HWY_INLINE Mask Accepts(const PacketRays& rays, const LaneHits& best, F32 t, U32 prim) {
  const Mask ahead = hn::Gt(t, hn::Zero(D()));
  const F32 best_t = hn::Load(D(), best.t);
  if (kAny) return hn::And(ahead, hn::Lt(t, best_t));
  const U32 inside = SetU(rays.inside), best_instance = hn::Load(DU(), best.instance);
  const MaskU first =
      hn::Or(hn::Lt(inside, best_instance),
             hn::And(hn::Eq(inside, best_instance), hn::Lt(prim, hn::Load(DU(), best.prim))));
  const Mask tie = hn::And(hn::Eq(t, best_t), ToFloatMask(first));
  return hn::And(ahead, hn::Or(hn::Lt(t, best_t), tie));
}

template <bool kAny>
HWY_INLINE void Accept(const PacketRays& rays, LaneHits& best, Mask hit, F32 t, U32 prim, F32 u,
                       F32 v) {
  const MaskU taken = ToUintMask(hit);
  hn::Store(hn::IfThenElse(taken, prim, hn::Load(DU(), best.prim)), DU(), best.prim);
  hn::Store(hn::IfThenElse(hit, kAny ? Set(-1.0f) : t, hn::Load(D(), best.t)), D(), best.t);
  if (kAny) return;
  hn::Store(hn::IfThenElse(hit, u, hn::Load(D(), best.u)), D(), best.u);
  hn::Store(hn::IfThenElse(hit, v, hn::Load(D(), best.v)), D(), best.v);
  hn::Store(hn::IfThenElse(taken, SetU(rays.inside), hn::Load(DU(), best.instance)), DU(),
            best.instance);
}

// The widened boxes of a block's triangles, once they are needed.
struct LazyBoxes {
  const TriangleBlock& block;
  bool are_there = false;
  alignas(64) float bounds[6][kBlockWidth];

  explicit HWY_INLINE LazyBoxes(const TriangleBlock& of) : block(of) {}
  HWY_INLINE const float (&Get())[6][kBlockWidth] {
    if (!are_there) BlockBoxes(block, bounds);
    are_there = true;
    return bounds;
  }
};

// Triangle i of a block, whose vertices as the rays see them are a, b and c. All lanes that are
// active are of the octant. False if nothing was hit.
template <bool kAny>
HWY_INLINE bool HitTriangle(const PacketRays& rays, const Vec3& a, const Vec3& b, const Vec3& c,
                            uint32_t i, uint32_t octant, LazyBoxes& boxes, LaneHits& best) {
  Mask hit = Inside(D(), EdgeFunctions(a, b, c));
  if (hn::AllFalse(D(), hit)) return false;

  const Edges<F32> edges = ExactEdges(D(), a, b, c);
  hit = hn::And(hit, Inside(D(), edges));
  const F32 inv_det = hn::Div(Set(1.0f), edges.det);
  const F32 on_plane = TriangleDistance(rays.shear, edges, inv_det, a.z, b.z, c.z);
  hit = hn::And(hit,
                hn::And(hn::Gt(on_plane, hn::Zero(D())), hn::Le(on_plane, hn::Load(D(), best.t))));
  if (hn::AllFalse(D(), hit)) return false;

  F32 t = on_plane;
  if (!hn::AllFalse(D(), hn::AndNot(IsPlain(D(), edges.det, rays.shear.inv_z), hit))) {
    const Interval<F32> box = CrossBoxOf(rays, boxes.Get(), i, octant, InfinityOf(D()));
    t = ClampToBox(box, on_plane, hit);
  }
  t = hn::Max(t, rays.enter);
  const U32 prim = SetU(boxes.block.prim[i]);
  hit = hn::And(hit, Accepts<kAny>(rays, best, t, prim));
  Accept<kAny>(rays, best, hit, t, prim, hn::Mul(edges.b, inv_det), hn::Mul(edges.c, inv_det));
  return true;
}

template <bool kAny>
HWY_INLINE void HitBlock(const PacketRays& rays, const TriangleBlock& block, uint32_t count,
                         uint32_t octant, LaneHits& best) {
  LazyBoxes boxes(block);
  for (uint32_t i = 0; i < count; ++i) {
    HitTriangle<kAny>(rays, PermutedVertex(rays, block, 0, i), PermutedVertex(rays, block, 1, i),
                      PermutedVertex(rays, block, 2, i), i, octant, boxes, best);
  }
}

template <bool kAny>
HWY_INLINE void HitSphere(const PacketRays& rays, const BvhView& bvh, uint32_t sphere,
                          LaneHits& best) {
  const F32 on_surface = SphereDistance(D(), bvh.spheres[sphere], rays.org, rays.dir);
  Mask hit = hn::Gt(on_surface, hn::Zero(D()));
  const Interval<F32> box = CrossBoxOf(rays, bvh.sphere_boxes + 6 * sphere, InfinityOf(D()));
  const F32 t = hn::Max(ClampToBox(box, on_surface, hit), rays.enter);
  const U32 prim = SetU(bvh.triangle_count + sphere);
  hit = hn::And(hit, Accepts<kAny>(rays, best, t, prim));
  Accept<kAny>(rays, best, hit, t, prim, hn::Zero(D()), hn::Zero(D()));
}

// The rays in the space of an instance, and which of them enter it.
HWY_INLINE Mask EnterInstance(const BvhView& bvh, uint32_t index, const PacketRays& world,
                              PacketRays& rays) {
  float bounds[6];
  BoxOfInstance(bvh, index, bounds);
  const Interval<F32> box = CrossBoxOf(world, bounds, InfinityOf(D()));
  rays.org = world.org;
  rays.dir = world.dir;
  MoveToObject(D(), bvh.instances[index], rays.org, rays.dir);
  SetUpSpace(bvh, rays);
  rays.inside = index;
  rays.enter = box.enter;
  rays.t = world.t;
  return hn::And(hn::Le(box.enter, box.leave), IsFinite(D(), rays.org, rays.dir));
}

// Children that wait and where each lane enters them; infinity for lanes that do not.
struct PacketStack {
  uint32_t child[kMaxBvhStack];
  alignas(64) float enter[kMaxBvhStack][kPacketRows];
  uint32_t size;

  // `root` is waiting for the lanes.
  HWY_INLINE void PushRoot(uint32_t root, Mask lanes) {
    child[size] = root;
    hn::Store(hn::IfThenElse(lanes, hn::Zero(D()), InfinityOf(D())), D(), enter[size]);
    ++size;
  }
};

// Pushes the children that an active lane enters, the nearest last. All lanes that are active are
// of the octant, so the near planes of a box are the same for all, and the order is the node's.
HWY_INLINE void PushChildren(const PacketRays& rays, Mask active, F32 t, uint32_t octant,
                             const BvhNode& node, PacketStack& stack) {
  const uint32_t order = node.order[octant];
  const uint32_t count = order >> kChildCountShift;
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t i = (order >> (kOrderBits * k)) % kBvhWidth;
    const Interval<F32> box = CrossBoxOf(rays, node.bounds, i, octant, t);
    const Mask hit = hn::And(active, hn::Le(box.enter, box.leave));
    // Without a branch: whether a child is entered cannot be predicted.
    stack.child[stack.size] = node.child[i];
    hn::Store(hn::IfThenElse(hit, box.enter, InfinityOf(D())), D(), stack.enter[stack.size]);
    stack.size += hn::AllFalse(D(), hit) ? 0 : 1;
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_VISIT_PACKET_INL_H_
