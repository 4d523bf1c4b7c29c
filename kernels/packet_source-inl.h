// Rays and a tree in, rays that go on alone out: packets go down from the root as long as enough of
// their rays go together; what is left of each ray waits on its list, and comes out with it.
#if defined(SWELL_KERNELS_PACKET_SOURCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_PACKET_SOURCE_INL_H_
#undef SWELL_KERNELS_PACKET_SOURCE_INL_H_
#else
#define SWELL_KERNELS_PACKET_SOURCE_INL_H_
#endif

#include "kernels/sort_octants-inl.h"
#include "kernels/visit_single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A leaf that at most so many rays of a packet enter is tested ray by ray, all triangles at once,
// not triangle by triangle for all rays: 3 to 7 were alike (room, AVX-512).
inline constexpr uint32_t kFewAtLeaf = 4;

// finish(row, hit) is called once for every row of `in`, in any order; or finish(row, hits) for a
// whole vector of rows from `row` on.
template <bool kAny, class Finish> class PacketSource {
 public:
  // A child that at most `few` rays of a packet enter waits until they go on alone. 0: none does;
  // as many as there are lanes: all do, from the root.
  PacketSource(const BvhView& bvh, const RayColumns& in, uint32_t few, const Finish& finish)
      : bvh_(bvh), in_(in), few_(few), finish_(finish) {}

  // The next ray that has something left to visit, at its first child. False if there is none.
  HWY_INLINE bool Take(SingleRay& ray, SingleStack& stack) {
    for (;;) {
      for (; alone_ != 0; alone_ &= alone_ - 1) {
        const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(alone_);
        TakeLane(batch_, i, ray);
        ray.inside = kNone;
        ray.enter = 0.0f;
        const uint32_t first = kMostWaiting - waiting_[i];
        PushNearer(ray, stack, waiting_child_[i] + first, waiting_enter_[i] + first, waiting_[i]);
        if (ray.stack_size > 0) {
          alone_ &= alone_ - 1;
          return true;
        }
        finish_(ray.row, ray.best);
      }
      if (row_ == sorted_count_ && !Sort()) return false;
      RunPacket();
    }
  }

  LaneUse use;

 private:
  static constexpr uint32_t kMostWaiting = 24;  // of one ray; beyond, its packet goes on with it

  // False if there are no rows left.
  HWY_INLINE bool Sort() {
    if (first_ == in_.count) return false;
    sorted_count_ = HWY_MIN(kMostSorted, in_.count - first_);
    if (hn::MaxLanes(D()) == 1) {
      for (size_t i = 0; i < sorted_count_; ++i) sorted_[i] = static_cast<uint32_t>(first_ + i);
    } else {
      SortOctants(in_.dir, first_, sorted_count_, sorted_);
    }
    first_ += sorted_count_;
    row_ = 0;
    return true;
  }

  HWY_NOINLINE void RunPacket() {
    const size_t count = HWY_MIN(hn::Lanes(D()), sorted_count_ - row_);
    const RowLanes rows(Load(sorted_, row_), sorted_[row_]);
    row_ += count;
    hn::Store(rows.Numbers(), DU(), lane_row_);
    hn::Store(hn::Zero(DU()), DU(), waiting_);
    const PacketRays rays = SetUpRays(bvh_, in_, rows, count);
    batch_.Fill(rays);
    best_.Clear(rays.t);

    const Mask started = hn::Ge(rays.t, hn::Zero(D()));
    ForEachOctant(batch_, started, [&](Mask lanes, uint32_t octant) HWY_ATTR {
      Descend<false>(rays, 0, lanes, octant);
    });

    const Mask has_more = ToFloatMask(hn::Ne(hn::Load(DU(), waiting_), hn::Zero(DU())));
    const Mask goes_on = hn::Ge(hn::Load(D(), best_.t), hn::Zero(D()));
    alone_ = MaskBits(D(), hn::And(has_more, goes_on));
    if (alone_ == 0 && rows.InTurn() && count == hn::Lanes(D())) {
      finish_(lane_row_[0], best_);
      return;
    }
    for (size_t i = 0; i < count; ++i) {
      if (((alone_ >> i) & 1) != 0) continue;
      finish_(lane_row_[i], HitOf(i));
    }
  }

  // Calls visit(lanes, octant) for the lanes of each octant.
  template <class Visit>
  HWY_INLINE void ForEachOctant(const RayBatch& batch, Mask lanes, const Visit& visit) {
    const U32 octants = hn::Load(DU(), batch.octant);
    for (uint32_t left = MaskBits(D(), lanes); left != 0;) {
      const uint32_t octant = batch.octant[hwy::Num0BitsBelowLS1Bit_Nonzero32(left)];
      const Mask of_octant = hn::And(lanes, ToFloatMask(hn::Eq(octants, SetU(octant))));
      visit(of_octant, octant);
      left &= ~MaskBits(D(), of_octant);
    }
  }

  HWY_INLINE SingleHit HitOf(size_t i) const {
    return {best_.t[i], best_.prim[i], best_.u[i], best_.v[i], best_.instance[i]};
  }

  // In the space of the rays of the batch, an instance's or the world's.
  HWY_INLINE void TakeLane(const RayBatch& batch, size_t i, SingleRay& ray) const {
    batch.Take(i, ray);
    ray.best = HitOf(i);
    ray.row = lane_row_[i];
    ray.stack_size = 0;
    ray.bottom = 0;
  }

  // The lanes, all of one octant, from the root. Inside of an instance its lanes stay a packet.
  template <bool kInside>
  HWY_INLINE void Descend(const PacketRays& rays, uint32_t root, Mask lanes, uint32_t octant) {
    const uint32_t bottom = kInside ? stack_.size : 0;
    stack_.size = bottom;
    stack_.PushRoot(root, lanes);
    while (stack_.size > bottom) {
      --stack_.size;
      const uint32_t child = stack_.child[stack_.size];
      const F32 t = hn::Load(D(), best_.t);
      const Mask active = hn::Le(hn::Load(D(), stack_.enter[stack_.size]), t);
      const uint32_t bits = MaskBits(D(), active);
      if (bits == 0) continue;
      const uint32_t count = static_cast<uint32_t>(hwy::PopCount(bits));
      if (!kInside && count <= few_ && Defer(child, bits)) continue;
      if ((child & kLeafBit) != 0) {
        VisitPacketLeaf<kInside>(rays, child, active, octant, bits, count);
        continue;
      }
      const BvhNode& node = bvh_.nodes[child];
      CountTests(ChildCount(node), count);
      PushChildren(rays, active, t, octant, node, stack_);
    }
  }

  // Puts the child on the lists of the lanes, if there is room on all of them.
  HWY_INLINE bool Defer(uint32_t child, uint32_t bits) {
    const MaskU full = hn::Gt(hn::Load(DU(), waiting_), SetU(kMostWaiting - 1));
    if ((MaskBits(DU(), full) & bits) != 0) return false;
    PrefetchChild(bvh_, child);
    const float* enter = stack_.enter[stack_.size];
    // Four lanes at a time, so that no branch depends on how many there are: the list of one lane
    // beyond takes what is too many and stays empty.
    do {
      for (uint32_t k = 0; k < 4; ++k) {
        const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits | (1u << kPacketRows));
        const uint32_t is_lane = bits != 0 ? 1 : 0;
        const uint32_t at = kMostWaiting - 1 - waiting_[i];
        waiting_[i] += is_lane;
        waiting_child_[i][at] = child;
        waiting_enter_[i][at] = enter[i % kPacketRows];
        bits &= bits - 1;
      }
    } while (bits != 0);
    return true;
  }

  template <bool kInside>
  HWY_INLINE void VisitPacketLeaf(const PacketRays& rays, uint32_t child, Mask active,
                                  uint32_t octant, uint32_t bits, uint32_t count) {
    if (!kInside && (child & kSphereLeafBit) != 0 && (child & kInstanceLeafBit) != 0) {
      CountTests(1, count);
      VisitInstance(rays, child & kSphereIndexMask, active);
    } else if (count <= kFewAtLeaf) {
      for (; bits != 0; bits &= bits - 1)
        VisitLaneLeaf(rays, hwy::Num0BitsBelowLS1Bit_Nonzero32(bits), child);
    } else if ((child & kSphereLeafBit) != 0) {
      CountTests(1, count);
      HitSphere<kAny>(rays, bvh_, child & kSphereIndexMask, best_);
    } else {
      CountTests(LeafCount(child), count);
      HitBlock<kAny>(rays, bvh_.blocks[LeafBlock(child)], LeafCount(child), octant, best_);
    }
  }

  // The lanes that enter the instance go down its object's tree, octant by octant of their
  // directions there. Until they are back, the others have ended.
  HWY_NOINLINE void VisitInstance(const PacketRays& world, uint32_t index, Mask active) {
    PacketRays rays;
    const Mask lanes = hn::And(active, EnterInstance(bvh_, index, world, rays));
    if (hn::AllFalse(D(), lanes)) return;
    object_batch_.Fill(rays);
    const F32 t = hn::Load(D(), best_.t);
    hn::Store(hn::IfThenElse(lanes, t, Set(-1.0f)), D(), best_.t);
    const uint32_t root = bvh_.objects[bvh_.instances[index].object].root;
    ForEachOctant(object_batch_, lanes, [&](Mask of_octant, uint32_t octant) HWY_ATTR {
      Descend<true>(rays, root, of_octant, octant);
    });
    hn::Store(hn::IfThenElse(lanes, hn::Load(D(), best_.t), t), D(), best_.t);
  }

  HWY_INLINE void VisitLaneLeaf(const PacketRays& rays, size_t i, uint32_t child) {
    SingleRay ray;
    TakeLane(rays.inside == kNone ? batch_ : object_batch_, i, ray);
    ray.inside = rays.inside;
    ray.enter = rays.inside == kNone ? 0.0f : hn::ExtractLane(rays.enter, i);
    ray.current = child;
    CountLeaf(child, use);
    bool ended;
    if ((child & kSphereLeafBit) != 0) {
      ended = VisitOddLeaf<kAny>(bvh_, in_, ray, nullptr);
    } else {
      const TriangleBlock& block = bvh_.blocks[LeafBlock(child)];
      const uint32_t crossed = CrossTriangles(ray, block);
      ended = crossed != 0 && HitBlock<kAny>(ray, block, crossed);
    }
    best_.Put(i, ended ? -1.0f : ray.best.t, ray.best);
  }

  HWY_INLINE void CountTests(uint32_t tests, uint32_t lanes) {
    use.active += tests * lanes;
    use.issued += tests * hn::Lanes(D());
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const uint32_t few_;
  const Finish& finish_;

  size_t first_ = 0;         // rows before it were sorted
  size_t sorted_count_ = 0;  // rows in sorted_
  size_t row_ = 0;           // of sorted_, the next to go down
  SortedRows sorted_;

  uint32_t alone_ = 0;  // lanes of the last packet that are still to come out
  RayBatch batch_, object_batch_;
  LaneHits best_;
  alignas(64) uint32_t lane_row_[kPacketRows];
  alignas(64) uint32_t waiting_[kPacketRows + 1] = {};  // entries of a lane's list
  // The last entries of each, the nearest last; whole vectors are read from any of them on.
  uint32_t waiting_child_[kPacketRows + 1][kMostWaiting + kBvhWidth];
  float waiting_enter_[kPacketRows + 1][kMostWaiting + kBvhWidth];
  PacketStack stack_;
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_PACKET_SOURCE_INL_H_
