// Rays and a tree in, hits out, by single rays: one after the other, or several in turn, so that
// the memory of one arrives while the others work.
#if defined(SWELL_KERNELS_TRAVERSE_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TRAVERSE_SINGLE_INL_H_
#undef SWELL_KERNELS_TRAVERSE_SINGLE_INL_H_
#else
#define SWELL_KERNELS_TRAVERSE_SINGLE_INL_H_
#endif

#include "kernels/visit_single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Calls finish(row, hit) for every row of `in`, in any order.
template <bool kAny, class Finish>
HWY_INLINE LaneUse TraceOneByOne(const BvhView& bvh, const RayColumns& in, const Finish& finish) {
  LaneUse use;
  RaySource source(bvh, in);
  SingleRay ray;
  SingleStack stack;
  while (source.Take(ray)) {
    do {
      bool descends = true;
      while (descends && (ray.current & kLeafBit) == 0) {
        descends = VisitNode(ray, bvh.nodes[ray.current], stack, use);
      }
      if (descends && VisitLeaf<kAny>(bvh, in, ray, stack, use)) break;
    } while (PopChild(ray, stack));
    finish(ray.row, ray.best);
  }
  return use;
}

// Rays in flight: 8 gave 0.93 times, 32 gave 1.02 times the rays a second (500k triangles,
// AVX-512).
inline constexpr uint32_t kMaxInFlight = 16;

// The same with kMaxInFlight rays in turn: while one works, the next node of the others comes from
// memory. Rays at nodes and rays at leaves take turns apart, so that no branch depends on which of
// the two a ray has come to.
template <bool kAny, class Finish> class InTurn {
 public:
  InTurn(const BvhView& bvh, const RayColumns& in, const Finish& finish)
      : bvh_(bvh), in_(in), finish_(finish), source_(bvh, in) {}

  HWY_INLINE LaneUse Run() {
    while (node_count_ < kMaxInFlight && source_.Take(rays_[node_count_])) {
      at_node_[node_count_] = node_count_;
      ++node_count_;
    }
    while (node_count_ + leaf_count_ > 0) {
      const uint32_t nodes = node_count_;
      node_count_ = 0;
      for (uint32_t k = 0; k < nodes; ++k) {
        const uint32_t slot = at_node_[k];
        const bool have_next =
            VisitNode(rays_[slot], bvh_.nodes[rays_[slot].current], stacks_[slot], use_);
        Next(slot, have_next, false);
      }
      const uint32_t leaves = leaf_count_;
      leaf_count_ = 0;
      for (uint32_t k = 0; k < leaves; ++k) {
        const uint32_t slot = at_leaf_[k];
        Next(slot, false, VisitLeaf<kAny>(bvh_, in_, rays_[slot], stacks_[slot], use_));
      }
    }
    return use_;
  }

 private:
  // Puts the slot where its ray, or the ray that follows it, goes next. `have_next`: the ray's
  // current child is that.
  HWY_INLINE void Next(uint32_t slot, bool have_next, bool ended) {
    SingleRay& ray = rays_[slot];
    if (!have_next && (ended || !PopChild(ray, stacks_[slot]))) {
      finish_(ray.row, ray.best);
      if (!source_.Take(ray)) return;
    }
    PrefetchChild(bvh_, ray.current);
    const uint32_t is_leaf = ray.current >> 31;
    at_node_[node_count_] = slot;
    at_leaf_[leaf_count_] = slot;
    node_count_ += 1 - is_leaf;
    leaf_count_ += is_leaf;
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const Finish& finish_;
  RaySource source_;
  LaneUse use_;
  SingleRay rays_[kMaxInFlight];
  SingleStack stacks_[kMaxInFlight];
  // One more than can be used: slots are written to both lists and counted in one.
  uint32_t at_node_[kMaxInFlight + 1], at_leaf_[kMaxInFlight + 1];
  uint32_t node_count_ = 0, leaf_count_ = 0;
};

// Trees beyond this many bytes are traced by several rays in turn; smaller ones lose by it (0.86
// times the rays a second with 8k triangles, whose nodes come from the cache).
inline constexpr size_t kInTurnBytes = size_t{1} << 20;

template <bool kAny, class Finish>
HWY_INLINE LaneUse TraceSingle(const BvhView& bvh, const RayColumns& in, const Finish& finish) {
  const size_t bytes = bvh.node_count * sizeof(BvhNode) + bvh.block_count * sizeof(TriangleBlock);
  if (bytes > kInTurnBytes) return InTurn<kAny, Finish>(bvh, in, finish).Run();
  return TraceOneByOne<kAny>(bvh, in, finish);
}

// Trees of at most this many nodes are traced by packets: with fewer choices, less is lost where
// the rays of a packet part. A packet of one lane is never worth it.
inline constexpr uint32_t kPacketNodes = 2;

HWY_INLINE bool ChoosePacket(const BvhView& bvh, Traversal traversal) {
  if (traversal != Traversal::kAuto) return traversal == Traversal::kPacket;
  return hn::MaxLanes(D()) > 1 && bvh.node_count <= kPacketNodes;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TRAVERSE_SINGLE_INL_H_
