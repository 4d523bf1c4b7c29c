// Rays and a tree in, the least hit or any hit of every ray out: packets as long as they are full
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
      Enlist(slot);
    }
    while (node_count_ + leaf_count_ > 0) {
      const uint32_t nodes = node_count_;
      node_count_ = 0;
      for (uint32_t k = 0; k < nodes; ++k) {
        const uint32_t slot = at_node_[k];
        SingleRay& ray = rays_[slot];
        const BvhNode& node = bvh_.nodes[ray.current];
        Next(slot, VisitNode<kAny>(ray, node, stacks_[slot], source_.use), false);
      }
      const uint32_t leaves = leaf_count_;
      leaf_count_ = 0;
      for (uint32_t k = 0; k < leaves; ++k) {
        const uint32_t slot = at_leaf_[k];
        Next(slot, false, VisitLeaf<kAny>(bvh_, in_, rays_[slot], &stacks_[slot], source_.use));
      }
    }
    return source_.use;
  }

 private:
  // Puts the slot where its ray, or the ray that follows it, goes next. `have_next`: the ray's
  // current child is that.
  HWY_INLINE void Next(uint32_t slot, bool have_next, bool ended) {
    SingleRay& ray = rays_[slot];
    if (!have_next && (ended || !PopChild<kAny>(ray, stacks_[slot]))) {
      finish_(ray.row, ray.best);
      if (!source_.Take(ray, stacks_[slot])) return;
    }
    PrefetchChild(bvh_, ray.current);
    Enlist(slot);
  }

  HWY_INLINE void Enlist(uint32_t slot) {
    const uint32_t is_leaf = rays_[slot].current >> 31;
    at_node_[node_count_] = slot;
    at_leaf_[leaf_count_] = slot;
    node_count_ += 1 - is_leaf;
    leaf_count_ += is_leaf;
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const Finish& finish_;
  PacketSource<kAny, Finish> source_;
  SingleRay rays_[kMaxInFlight];
  SingleStack stacks_[kMaxInFlight];
  // One more than can be used: slots are written to both lists and counted in one.
  uint32_t at_node_[kMaxInFlight + 1], at_leaf_[kMaxInFlight + 1];
  uint32_t node_count_ = 0, leaf_count_ = 0;
};

// A packet of one lane is never worth it.
inline constexpr uint32_t kFewRays = hn::MaxLanes(D()) < 3 ? hn::MaxLanes(D()) : 3;

// Trees of at most this many nodes are traced by packets alone: with fewer choices, less is lost
// where the rays of a packet part.
inline constexpr uint32_t kPacketNodes = 2;

HWY_INLINE uint32_t FewRays(const BvhView& bvh, Traversal traversal) {
  if (traversal == Traversal::kPacket) return 0;
  if (traversal == Traversal::kSingle) return hn::MaxLanes(D());
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
