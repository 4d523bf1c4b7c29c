// A ray and a child of the tree in: a block, a sphere or a node against one ray, all triangles or
// children at once. Out come the ray's best hit and the children that wait.
#if defined(SWELL_KERNELS_VISIT_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_VISIT_SINGLE_INL_H_
#undef SWELL_KERNELS_VISIT_SINGLE_INL_H_
#else
#define SWELL_KERNELS_VISIT_SINGLE_INL_H_
#endif

#include <hwy/cache_control.h>

#include <cmath>

#include "kernels/enter_instance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// No branch depends on whether the hit is nearer. True if the ray has ended: any hit was asked for
// and found.
template <bool kAny>
HWY_INLINE bool Offer(SingleRay& ray, float t, uint32_t prim, float u, float v) {
  SingleHit& best = ray.best;
  if (kAny) {
    const bool ended = t < best.t;
    best.prim = Chosen(ended, prim, best.prim);
    return ended;
  }
  const uint32_t first = uint32_t{ray.inside < best.instance} |
                         (uint32_t{ray.inside == best.instance} & uint32_t{prim < best.prim});
  const bool less = (uint32_t{t < best.t} | (uint32_t{t == best.t} & first)) != 0;
  best = {Chosen(less, t, best.t), Chosen(less, prim, best.prim), Chosen(less, u, best.u),
          Chosen(less, v, best.v), Chosen(less, ray.inside, best.instance)};
  return false;
}

// The first of `hits`, triangles of a block, or one beyond all.
HWY_INLINE size_t FirstOf(uint32_t hits) {
  return hwy::Num0BitsBelowLS1Bit_Nonzero32(hits | (1u << kBlockWidth));
}

// Moves distances to the boxes of lanes [first, first + Lanes) of a block; see ClampToBox.
HWY_INLINE FB ClampToBlock(const SingleRay& ray, const TriangleBlock& block, size_t first, FB t,
                           MaskB& hit) {
  const DB db;
  Vec3T<FB> vertex[3];
  for (size_t k = 0; k < 3; ++k) {
    vertex[k] = {hn::Load(db, block.vertex[k][0] + first), hn::Load(db, block.vertex[k][1] + first),
                 hn::Load(db, block.vertex[k][2] + first)};
  }
  const Box<FB> box = TriangleBox(db, vertex[0], vertex[1], vertex[2]);
  // Through memory, so that no branch depends on the ray's octant.
  alignas(64) float bounds[6 * kBvhWidth];
  const FB columns[6] = {box.lower.x, box.lower.y, box.lower.z,
                         box.upper.x, box.upper.y, box.upper.z};
  for (size_t k = 0; k < 6; ++k) hn::Store(columns[k], db, bounds + k * kBvhWidth);
  const Vec3T<FB> near = PlanesAt(bounds, ray.planes.near), far = PlanesAt(bounds, ray.planes.far);
  return ClampToBox(CrossBox(SlabsOf(db, ray), near, far, hn::Zero(db), InfinityOf(db)), t, hit);
}

// Lanes [first, first + Lanes) of a block, seen from the ray.
HWY_INLINE void ShearTriangles(const ShearRay<FB>& shear, const VertexColumns& columns,
                               const TriangleBlock& block, size_t first, Vec3T<FB> (&vertex)[3]) {
  const DB db;
  for (size_t k = 0; k < 3; ++k) {
    const float* of_vertex = block.vertex[k][0] + first;
    vertex[k] =
        ShearVertex(shear, hn::Load(db, of_vertex + columns.x), hn::Load(db, of_vertex + columns.y),
                    hn::Load(db, of_vertex + columns.z));
  }
}

// Bit i: the ray may hit triangle i; kLine: its line may, which costs less. No branch depends on
// it.
template <bool kLine>
HWY_INLINE uint32_t CrossTriangles(const ShearRay<FB>& shear, const VertexColumns& columns,
                                   const TriangleBlock& block) {
  const DB db;
  uint32_t crossed = 0;
  for (size_t first = 0; first < kBlockWidth; first += hn::Lanes(db)) {
    Vec3T<FB> vertex[3];
    ShearTriangles(shear, columns, block, first, vertex);
    const MaskB may = kLine ? Inside(db, EdgeFunctions(vertex[0], vertex[1], vertex[2]))
                            : MayHit(db, shear, vertex[0], vertex[1], vertex[2]);
    crossed |= MaskBits(db, may) << first;
  }
  return crossed;
}
HWY_INLINE uint32_t CrossTriangles(const SingleRay& ray, const TriangleBlock& block) {
  return CrossTriangles<false>(ShearOf(ray), ray.columns, block);
}

// The triangles of lanes [first, first + Lanes) of a block that are among `crossed`. True if the
// ray has ended.
template <bool kAny>
HWY_INLINE bool HitTriangles(SingleRay& ray, const TriangleBlock& block, size_t first,
                             uint32_t crossed) {
  const DB db;
  const ShearRay<FB> shear = ShearOf(ray);
  Vec3T<FB> vertex[3];
  ShearTriangles(shear, ray.columns, block, first, vertex);
  const Edges<FB> edges = ExactEdges(db, vertex[0], vertex[1], vertex[2]);
  MaskB hit =
      hn::And(Inside(db, edges), Inside(db, EdgeFunctions(vertex[0], vertex[1], vertex[2])));
  const FB inv_det = hn::Div(hn::Set(db, 1.0f), edges.det);
  const FB on_plane =
      TriangleDistance(shear, edges, inv_det, vertex[0].z, vertex[1].z, vertex[2].z);
  hit = hn::And(hit,
                hn::And(hn::Gt(on_plane, hn::Zero(db)), hn::Le(on_plane, hn::Set(db, ray.best.t))));
  FB t = on_plane;
  if (!hn::AllFalse(db, hn::AndNot(IsPlain(db, edges.det, shear.inv_z), hit))) {
    t = ClampToBlock(ray, block, first, on_plane, hit);
  }
  t = hn::Max(t, hn::Set(db, ray.enter));
  if (kAny) {
    hit = hn::And(hit, hn::Lt(t, hn::Set(db, ray.best.t)));
    const uint32_t hits = MaskBits(db, hit) & (crossed >> first);
    const size_t i = first + FirstOf(hits) % kBlockWidth;
    ray.best.prim = Chosen(hits != 0, block.prim[i], ray.best.prim);
    return hits != 0;
  }
  alignas(64) float at[kBlockWidth + 1], u[kBlockWidth + 1], v[kBlockWidth + 1];  // last: no hit
  at[kBlockWidth] = HUGE_VALF;
  u[kBlockWidth] = v[kBlockWidth] = 0.0f;
  hn::Store(t, db, at);
  hn::Store(hn::Mul(edges.b, inv_det), db, u);
  hn::Store(hn::Mul(edges.c, inv_det), db, v);
  // Nearly always there is one or none, so no branch depends on that.
  uint32_t hits = MaskBits(db, hit) & (crossed >> first);
  do {
    const size_t i = FirstOf(hits);
    Offer<false>(ray, at[i], block.prim[(first + i) % kBlockWidth], u[i], v[i]);
    hits &= hits - 1;
  } while (hits != 0);
  return false;
}

// The triangles of a block that are among `crossed`. True if the ray has ended.
template <bool kAny>
HWY_INLINE bool HitBlock(SingleRay& ray, const TriangleBlock& block, uint32_t crossed) {
  constexpr uint32_t kOfPart = (1u << hn::MaxLanes(DB())) - 1;
  for (size_t first = 0; first < kBlockWidth; first += hn::Lanes(DB())) {
    if (((crossed >> first) & kOfPart) == 0) continue;
    if (HitTriangles<kAny>(ray, block, first, crossed)) return true;
  }
  return false;
}

// True if the ray has ended.
template <bool kAny>
HWY_INLINE bool HitSphere(SingleRay& ray, const BvhView& bvh, const RayColumns& in,
                          uint32_t sphere) {
  const hn::CappedTag<float, 1> d1;
  using V = hn::Vec<decltype(d1)>;
  Vec3T<V> org = RowOf(d1, in.org, ray.row), dir = RowOf(d1, in.dir, ray.row);
  if (ray.inside != kNone) MoveToObject(d1, bvh.instances[ray.inside], org, dir);
  const V on_surface = SphereDistance(d1, bvh.spheres[sphere], org, dir);
  auto hit = hn::Gt(on_surface, hn::Zero(d1));
  const Interval<V> box = CrossOneBox(d1, ray, bvh.sphere_boxes + 6 * sphere);
  const V t = hn::Max(ClampToBox(box, on_surface, hit), hn::Set(d1, ray.enter));
  if (hn::AllFalse(d1, hit)) return false;
  return Offer<kAny>(ray, hn::GetLane(t), bvh.triangle_count + sphere, 0.0f, 0.0f);
}

using DBU = hn::RebindToUnsigned<DB>;
using UB = hn::Vec<DBU>;

// Where the ray enters children [first, first + Lanes) of a node, and which it does enter.
HWY_INLINE FB CrossChildren(const SingleRay& ray, const BvhNode& node, size_t first, MaskB& hit) {
  const DB db;
  const float* bounds = node.bounds[0] + first;
  const Vec3T<FB> near = PlanesAt(bounds, ray.planes.near), far = PlanesAt(bounds, ray.planes.far);
  const Interval<FB> box =
      CrossBox(SlabsOf(db, ray), near, far, hn::Zero(db), hn::Set(db, ray.best.t));
  hit = hn::Le(box.enter, box.leave);
  return box.enter;
}

#if HWY_MAX_BYTES >= 32
// Pushes the children that `cross` says are entered, the nearest last: all in the node's order for
// the octant, then those that are entered close ranks. For any hit the order does not matter.
// Returns how many. How many there are cannot be predicted, so there is no branch. to_slot is null
// where the children's slots are not asked for.
template <bool kAny, class Cross>
HWY_INLINE uint32_t PushCrossed(const Cross& cross, const BvhNode& node, uint32_t octant,
                                uint32_t* to_child, float* to_enter, uint32_t* to_slot) {
  const DB db;
  const DBU du;
  MaskB hit;
  FB enter = cross(0, hit);
  UB child = hn::Load(du, node.child);
  if (!kAny) {
    const UB shift = hn::Mul(hn::Iota(du, 0), hn::Set(du, kOrderBits));
    const UB order =
        hn::And(hn::Shr(hn::Set(du, node.order[octant]), shift), hn::Set(du, kBvhWidth - 1));
    const auto slots = hn::IndicesFromVec(du, order);
    // Negative: not entered. Integers, because lanes of integers are permuted on every target.
    const FB entered = hn::IfThenElse(hit, enter, hn::Set(db, -1.0f));
    enter = hn::BitCast(db, hn::TableLookupLanes(hn::BitCast(du, entered), slots));
    child = hn::TableLookupLanes(child, slots);
    hit = hn::Ge(enter, hn::Zero(db));
    hn::StoreU(hn::Compress(enter, hit), db, to_enter);
    if (to_slot != nullptr) {
      hn::StoreU(hn::Compress(order, hn::RebindMask(du, hit)), du, to_slot);
    }
  }
  hn::StoreU(hn::Compress(child, hn::RebindMask(du, hit)), du, to_child);
  return static_cast<uint32_t>(hn::CountTrue(db, hit));
}
#else
template <bool kAny, class Cross>
HWY_INLINE uint32_t PushCrossed(const Cross& cross, const BvhNode& node, uint32_t octant,
                                uint32_t* to_child, float* to_enter, uint32_t* to_slot) {
  alignas(64) float enter[kBvhWidth];
  uint32_t hits = 0;
  for (size_t first = 0; first < kBvhWidth; first += hn::Lanes(DB())) {
    MaskB hit;
    hn::Store(cross(first, hit), DB(), enter + first);
    hits |= MaskBits(DB(), hit) << first;
  }
  uint32_t size = 0;
  for (uint32_t k = 0; k < kBvhWidth; ++k) {
    const uint32_t slot = (node.order[octant] >> (kOrderBits * k)) % kBvhWidth;
    to_child[size] = node.child[slot];
    to_enter[size] = enter[slot];
    if (to_slot != nullptr) to_slot[size] = slot;
    size += (hits >> slot) & 1;
  }
  return size;
}
#endif

// Pushes the children that the ray enters, the nearest last. Returns how many.
template <bool kAny>
HWY_INLINE uint32_t PushChildren(const SingleRay& ray, const BvhNode& node, SingleStack& stack) {
  const auto cross = [&](size_t first, MaskB& hit)
                         HWY_ATTR { return CrossChildren(ray, node, first, hit); };
  return PushCrossed<kAny>(cross, node, ray.planes.octant, stack.child + ray.stack_size,
                           stack.enter + ray.stack_size, nullptr);
}

// A node or a block, without a branch that depends on which, or most of a sphere or an instance.
HWY_INLINE void PrefetchChild(const BvhView& bvh, uint32_t child) {
  const uintptr_t node = reinterpret_cast<uintptr_t>(bvh.nodes) + child * sizeof(BvhNode);
  const uintptr_t block =
      reinterpret_cast<uintptr_t>(bvh.blocks) + LeafBlock(child) * sizeof(TriangleBlock);
  const uintptr_t is_leaf = uintptr_t{0} - (child >> 31);
  uintptr_t at = node ^ ((node ^ block) & is_leaf);
  if (child >= (kLeafBit | kSphereLeafBit)) {  // never, in most scenes
    const uint32_t row = child & kSphereIndexMask;
    at = (child & kInstanceLeafBit) == 0 ? reinterpret_cast<uintptr_t>(bvh.spheres + row)
                                         : reinterpret_cast<uintptr_t>(bvh.instances + row);
  }
  for (size_t line = 0; line < 5; ++line) {
    hwy::Prefetch(reinterpret_cast<const char*>(at + 64 * line));
  }
}

// Pushes those of `count` children that are entered before the ray's best hit, in their order;
// whole vectors are read. They may be of the stack itself from ray.stack_size on.
HWY_INLINE void PushNearer(SingleRay& ray, SingleStack& stack, const uint32_t* children,
                           const float* enters, uint32_t count) {
  const DB db;
  const DBU du;
  uint32_t i = 0;
  do {  // mostly once
    const FB enter = hn::LoadU(db, enters + i);
    const UB child = hn::LoadU(du, children + i);
    const MaskB nearer = hn::And(hn::Le(enter, hn::Set(db, ray.best.t)), hn::FirstN(db, count - i));
    hn::StoreU(hn::Compress(enter, nearer), db, stack.enter + ray.stack_size);
    hn::StoreU(hn::Compress(child, hn::RebindMask(du, nearer)), du, stack.child + ray.stack_size);
    ray.stack_size += static_cast<uint32_t>(hn::CountTrue(db, nearer));
    i += static_cast<uint32_t>(hn::Lanes(db));
  } while (i < count);
}

// Drops the children that wait and no longer matter, after a hit: those of the space the ray is in.
HWY_INLINE void DropFarther(SingleRay& ray, SingleStack& stack) {
  const uint32_t size = ray.stack_size;
  ray.stack_size = ray.bottom;
  PushNearer(ray, stack, stack.child + ray.bottom, stack.enter + ray.bottom, size - ray.bottom);
}

// A sphere or an instance. True if the ray has ended. `stack` may be null without instances.
template <bool kAny>
HWY_INLINE bool VisitOddLeaf(const BvhView& bvh, const RayColumns& in, SingleRay& ray,
                             SingleStack* stack) {
  if ((ray.current & kInstanceLeafBit) == 0) {
    return HitSphere<kAny>(ray, bvh, in, ray.current & kSphereIndexMask);
  }
  EnterInstance(bvh, in, ray, *stack);
  return false;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_VISIT_SINGLE_INL_H_
