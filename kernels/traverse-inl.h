// Rays and a tree in, the least hit or any hit of every ray out: bundles as long as they are full
// enough, then single rays, several in turn, so that the memory of one arrives while the others
// work.
#if defined(SWELL_KERNELS_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRAVERSE_INL_H_
#undef SWELL_KERNELS_TRAVERSE_INL_H_
#else
#define SWELL_KERNELS_TRAVERSE_INL_H_
#endif

#include "kernels/packet_source-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Single rays in flight: 8 and 24 gave 0.99 to 1.01 times the rays a second (room, AVX-512).
inline constexpr uint32_t kMaxInFlight = 16;

// Rays at nodes and rays at leaves take turns apart, so that no branch depends on which of the two
// a ray has come to.
template <bool kAny, class Finish> class Traverser {
 public:
  Traverser(const BvhView& bvh, const RayColumns& in, uint32_t few, const Finish& finish)
      : bvh_(bvh), in_(in), finish_(finish), source_(bvh, in, few, finish) {}

  HWY_INLINE LaneUse Run() {
    for (uint32_t slot = 0; slot < kMaxInFlight; ++slot) {
      if (!source_.Take(rays_[slot], stacks_[slot])) break;
      Advance(slot, counts_);
    }
    while (counts_.node + counts_.leaf + counts_.end > 0) {
      VisitNodes();
      VisitLeaves();
      ReplaceEnded();
    }
    return source_.use;
  }

 private:
  struct Counts {
    uint32_t node = 0, leaf = 0, end = 0;  // slots on the lists
  };

  HWY_INLINE void VisitNodes() {
    const uint32_t count = counts_.node;
    Counts counts = {0, counts_.leaf, counts_.end};  // in registers, whatever is stored
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t slot = at_node_[k];
      SingleRay& ray = rays_[slot];
      VisitNode<kAny>(ray, bvh_.nodes[ray.current], stacks_[slot], source_.use);
      Advance(slot, counts);
    }
    counts_ = counts;
  }

  // All triangles that may be hit first, then those that are, then all go on.
  HWY_INLINE void VisitLeaves() {
    const uint32_t count = counts_.leaf;
    uint32_t crossing = 0;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t slot = at_leaf_[k];
      SingleRay& ray = rays_[slot];
      CountLeaf(ray.current, source_.use);
      if ((ray.current & kSphereLeafBit) != 0) {
        const float before = ray.best.t;
        const bool ended = VisitOddLeaf<kAny>(bvh_, in_, ray, &stacks_[slot]);
        Settle(slot, ended, before != ray.best.t);
        continue;
      }
      crossed_[crossing] = CrossTriangles(ray, bvh_.blocks[LeafBlock(ray.current)]);
      crosses_[crossing] = slot;
      crossing += crossed_[crossing] != 0 ? 1 : 0;
    }
    for (uint32_t k = 0; k < crossing; ++k) {
      const uint32_t slot = crosses_[k];
      SingleRay& ray = rays_[slot];
      const bool ended = HitBlock<kAny>(ray, bvh_.blocks[LeafBlock(ray.current)], crossed_[k]);
      Settle(slot, ended, true);
    }
    Counts counts = {counts_.node, 0, counts_.end};
    for (uint32_t k = 0; k < count; ++k) Advance(at_leaf_[k], counts);
    counts_ = counts;
  }

  HWY_INLINE void Settle(uint32_t slot, bool ended, bool nearer) {
    SingleRay& ray = rays_[slot];
    if (kAny) {
      if (!ended) return;
      ray.stack_size = ray.bottom = 0;
      ray.inside = kNone;
    } else if (nearer) {
      DropFarther(ray, stacks_[slot]);
    }
  }

  HWY_INLINE void ReplaceEnded() {
    const uint32_t count = counts_.end;
    counts_.end = 0;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t slot = at_end_[k];
      SingleRay& ray = rays_[slot];
      if (ray.inside != kNone) {
        LeaveInstance(ray, stacks_[slot]);
        if (!kAny) DropFarther(ray, stacks_[slot]);
      } else {
        finish_(ray.row, ray.best);
        if (!source_.Take(ray, stacks_[slot])) continue;
      }
      Advance(slot, counts_);
    }
  }

  // Puts the slot where its ray goes next: no branch depends on where that is.
  HWY_INLINE void Advance(uint32_t slot, Counts& counts) {
    SingleRay& ray = rays_[slot];
    const uint32_t waits = ray.stack_size > ray.bottom ? 1 : 0;
    ray.stack_size -= waits;
    ray.current = stacks_[slot].child[ray.stack_size];
    PrefetchChild(bvh_, ray.current);
    const uint32_t is_leaf = ray.current >> 31;
    at_node_[counts.node] = slot;
    at_leaf_[counts.leaf] = slot;
    at_end_[counts.end] = slot;
    counts.node += waits & (1 - is_leaf);
    counts.leaf += waits & is_leaf;
    counts.end += 1 - waits;
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const Finish& finish_;
  PacketSource<kAny, Finish> source_;
  SingleRay rays_[kMaxInFlight];
  SingleStack stacks_[kMaxInFlight];
  // One more than can be used: slots are written to all lists and counted in one.
  uint32_t at_node_[kMaxInFlight + 1], at_leaf_[kMaxInFlight + 1], at_end_[kMaxInFlight + 1];
  Counts counts_;
  uint32_t crosses_[kMaxInFlight + 1], crossed_[kMaxInFlight + 1];  // slots, their triangles
};

// Of a bundle. 8 lost up to a fifth, 24 were no better (pillars, valley; AVX-512). Packets of one
// lane are never worth it.
inline constexpr uint32_t kFewRays = hn::MaxLanes(D()) < 4 ? kBundleRays : 16;

// Trees of at most this many nodes are traced by bundles alone: with fewer choices, less is lost
// where the rays of a bundle part.
inline constexpr uint32_t kPacketNodes = 2;

HWY_INLINE uint32_t FewRays(const BvhView& bvh, Traversal traversal) {
  if (traversal == Traversal::kPacket) return 0;
  if (traversal == Traversal::kSingle) return kBundleRays;
  return hn::MaxLanes(D()) > 1 && bvh.node_count <= kPacketNodes ? 0 : kFewRays;
}

// Calls finish(row, hit) once for every row of `in`, in any order.
template <bool kAny, class Finish>
HWY_INLINE LaneUse Traverse(const BvhView& bvh, const RayColumns& in, Traversal traversal,
                            const Finish& finish) {
  return Traverser<kAny, Finish>(bvh, in, FewRays(bvh, traversal), finish).Run();
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRAVERSE_INL_H_
