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

// A single ray in flight. Lists hold pointers, so that all it has is at fixed distances.
struct Flight {
  SingleRay ray;
  SingleStack stack;
};

// Rays at nodes and rays at leaves take turns apart, so that no branch depends on which of the two
// a ray has come to.
template <bool kAny, class Finish> class Traverser {
 public:
  Traverser(const BvhView& bvh, const RayColumns& in, uint32_t few, const Finish& finish)
      : bvh_(bvh), in_(in), finish_(finish), source_(bvh, in, few, finish) {}

  HWY_INLINE LaneUse Run() {
    for (Flight& flight : flights_) {
      if (!source_.Take(flight.ray, flight.stack)) break;
      Advance(flight, counts_);
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
    uint32_t node = 0, leaf = 0, end = 0;  // rays on the lists
  };

  HWY_INLINE void VisitNodes() {
    const uint32_t count = counts_.node;
    Counts counts = {0, counts_.leaf, counts_.end};  // in registers, whatever is stored
    const BvhNode* nodes = bvh_.nodes;
    uint64_t children = 0;
    for (uint32_t k = 0; k < count; ++k) {
      Flight& flight = *at_node_[k];
      const BvhNode& node = nodes[flight.ray.current];
      children += ChildCount(node);
      flight.ray.stack_size += PushChildren<kAny>(flight.ray, node, flight.stack);
      Advance(flight, counts);
    }
    counts_ = counts;
    source_.use.active += children;
    source_.use.issued += uint64_t{count} * kBvhWidth;
  }

  // All triangles that may be hit first, then those that are, then all go on.
  HWY_INLINE void VisitLeaves() {
    const uint32_t count = counts_.leaf;
    uint32_t crossing = 0;
    for (uint32_t k = 0; k < count; ++k) {
      Flight& flight = *at_leaf_[k];
      SingleRay& ray = flight.ray;
      CountLeaf(ray.current, source_.use);
      if ((ray.current & kSphereLeafBit) != 0) {
        const float before = ray.best.t;
        const bool ended = VisitOddLeaf<kAny>(bvh_, in_, ray, &flight.stack);
        Settle(flight, ended, before != ray.best.t);
        continue;
      }
      crossed_[crossing] = CrossTriangles(ray, bvh_.blocks[LeafBlock(ray.current)]);
      crosses_[crossing] = &flight;
      crossing += crossed_[crossing] != 0 ? 1 : 0;
    }
    for (uint32_t k = 0; k < crossing; ++k) {
      Flight& flight = *crosses_[k];
      SingleRay& ray = flight.ray;
      const bool ended = HitBlock<kAny>(ray, bvh_.blocks[LeafBlock(ray.current)], crossed_[k]);
      Settle(flight, ended, true);
    }
    Counts counts = {counts_.node, 0, counts_.end};
    for (uint32_t k = 0; k < count; ++k) Advance(*at_leaf_[k], counts);
    counts_ = counts;
  }

  HWY_INLINE void Settle(Flight& flight, bool ended, bool nearer) {
    SingleRay& ray = flight.ray;
    if (kAny) {
      ray.stack_size = Chosen(ended, 0u, ray.stack_size);
      ray.bottom = Chosen(ended, 0u, ray.bottom);
      ray.inside = Chosen(ended, kNone, ray.inside);
    } else if (nearer) {
      DropFarther(ray, flight.stack);
    }
  }

  HWY_INLINE void ReplaceEnded() {
    const uint32_t count = counts_.end;
    counts_.end = 0;
    for (uint32_t k = 0; k < count; ++k) {
      Flight& flight = *at_end_[k];
      SingleRay& ray = flight.ray;
      if (ray.inside != kNone) {
        LeaveInstance(ray, flight.stack);
        if (!kAny) DropFarther(ray, flight.stack);
      } else {
        finish_(ray.row, ray.best);
        if (!source_.Take(ray, flight.stack)) continue;
      }
      Advance(flight, counts_);
    }
  }

  // Puts the ray where it goes next: no branch depends on where that is.
  HWY_INLINE void Advance(Flight& flight, Counts& counts) {
    SingleRay& ray = flight.ray;
    const uint32_t waits = ray.stack_size > ray.bottom ? 1 : 0;
    ray.stack_size -= waits;
    ray.current = flight.stack.child[ray.stack_size];
    PrefetchChild(bvh_, ray.current);
    const uint32_t is_leaf = ray.current >> 31;
    at_node_[counts.node] = &flight;
    at_leaf_[counts.leaf] = &flight;
    at_end_[counts.end] = &flight;
    counts.node += waits & (1 - is_leaf);
    counts.leaf += waits & is_leaf;
    counts.end += 1 - waits;
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const Finish& finish_;
  PacketSource<kAny, Finish> source_;
  Flight flights_[kMaxInFlight];
  // One more than can be used: rays are written to all lists and counted in one.
  Flight *at_node_[kMaxInFlight + 1], *at_leaf_[kMaxInFlight + 1], *at_end_[kMaxInFlight + 1];
  Counts counts_;
  Flight* crosses_[kMaxInFlight + 1];  // those whose leaf has triangles they may hit, and which
  uint32_t crossed_[kMaxInFlight + 1];
};

// Of a bundle. 16 and 32 were within 3 % on pillars and valley, 16 lost 9 % on the room's shadow
// rays, 8 up to a fifth (AVX-512). Packets of one lane are never worth it.
inline constexpr uint32_t kFewRays = hn::MaxLanes(D()) < 4 ? kBundleRays : 24;

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
