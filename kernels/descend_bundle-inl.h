// A bundle of rays and a tree in, the rays' best hits out, and for rays that part from the others
// the children that wait. All children of a node and all triangles of a block are first asked with
// the bounds of the bundle, then what is left packet by packet or, where few rays enter, ray by
// ray.
#if defined(SWELL_KERNELS_DESCEND_BUNDLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_DESCEND_BUNDLE_INL_H_
#undef SWELL_KERNELS_DESCEND_BUNDLE_INL_H_
#else
#define SWELL_KERNELS_DESCEND_BUNDLE_INL_H_
#endif

#include "kernels/cross_bundle-inl.h"
#include "kernels/lane_lists-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Blocks that fewer rays come to are not asked with the bounds: 20 to 40 were within 3 %; all
// blocks asked lost a seventh on the valley, none a fifth on the Cornell box (AVX-512).
inline constexpr size_t kManyAtBlock = 41;

template <bool kAny> class BundleDescent {
 public:
  BundleDescent(const BvhView& bvh, Bundle& bundle, LaneLists& lists, LaneUse& use)
      : bvh_(bvh), bundle_(bundle), lists_(lists), use_(use) {}

  // Children that at most `few` rays enter are put on these rays' lists. odd_leaf(child, lanes) is
  // called for spheres and instances.
  template <class OddLeaf> HWY_INLINE void Run(uint32_t few, const OddLeaf& odd_leaf) {
    size_ = 1;
    child_[0] = 0;
    enter_[0] = 0.0f;
    box_[0] = kNone;
    lanes_[0] = ~uint64_t{0};
    farthest_ = Farthest();
    are_batched_ = 0;
    while (size_ > 0) {
      --size_;
      if (enter_[size_] > farthest_) continue;
      const uint32_t child = child_[size_];
      uint32_t triangles = 0;
      const bool is_block = (child & kLeafBit) != 0 && (child & kSphereLeafBit) == 0;
      if (is_block && !AskBounds(child, triangles)) continue;
      const uint64_t lanes = LanesInBox(box_[size_], lanes_[size_]);
      if (lanes == 0) continue;
      const uint32_t count = static_cast<uint32_t>(hwy::PopCount(lanes));
      if (count <= few && Defer(child, lanes)) continue;
      if ((child & kLeafBit) == 0) {
        VisitNode(child, lanes, count);
      } else if ((child & kSphereLeafBit) != 0) {
        odd_leaf(child, lanes);
        farthest_ = Farthest();
      } else {
        VisitBlock(child, triangles, lanes, count);
      }
    }
  }

  // The set-up of one packet's rays, for single rays.
  HWY_INLINE const RayBatch& BatchOf(size_t packet) {
    if (((are_batched_ >> packet) & 1) == 0) batches_[packet].Fill(bundle_.rays[packet]);
    are_batched_ |= uint64_t{1} << packet;
    return batches_[packet];
  }

 private:
  static HWY_INLINE bool AnyOfPacket(uint64_t lanes, size_t packet) {
    constexpr uint64_t kLanes = (uint64_t{1} << kPacketRows) - 1;
    return ((lanes >> (packet * kPacketRows)) & kLanes) != 0;
  }

  HWY_INLINE float Farthest() const {
    F32 t = hn::Load(D(), bundle_.best[0].t);
    for (size_t p = 1; p < bundle_.packets; ++p) t = hn::Max(t, hn::Load(D(), bundle_.best[p].t));
    return hn::GetLane(hn::MaxOfLanes(D(), t));
  }

  // The lanes among `of` that enter a box before their best hit, and where: box / 8 is the node,
  // box % 8 the slot; kNone: everywhere.
  HWY_INLINE uint64_t LanesInBox(uint32_t box, uint64_t of) {
    uint64_t lanes = 0;
    for (size_t p = 0; p < bundle_.packets; ++p) {
      if (!AnyOfPacket(of, p)) continue;
      const F32 best = hn::Load(D(), bundle_.best[p].t);
      uint64_t bits;
      if (box == kNone) {
        bits = MaskBits(D(), hn::Ge(best, hn::Zero(D())));
        hn::Store(hn::Zero(D()), D(), lane_enter_ + p * kPacketRows);
      } else {
        const BvhNode& node = bvh_.nodes[box / kBvhWidth];
        const Interval<F32> in = CrossBoxOf(bundle_.rays[p], node.bounds, box % kBvhWidth,
                                            bundle_.bounds.planes.octant, best);
        bits = MaskBits(D(), hn::Le(in.enter, in.leave));
        hn::Store(in.enter, D(), lane_enter_ + p * kPacketRows);
      }
      lanes |= bits << (p * kPacketRows);
    }
    return lanes & of;
  }

  HWY_INLINE bool Defer(uint32_t child, uint64_t lanes) {
    for (uint64_t left = lanes; left != 0; left &= left - 1) {
      if (lists_.IsFull(hwy::Num0BitsBelowLS1Bit_Nonzero64(left))) return false;
    }
    PrefetchChild(bvh_, child);
    for (uint64_t left = lanes; left != 0; left &= left - 1) {
      const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
      lists_.Put(i, child, lane_enter_[i]);
    }
    return true;
  }

  HWY_INLINE void VisitNode(uint32_t child, uint64_t lanes, uint32_t count) {
    const BvhNode& node = bvh_.nodes[child];
    use_.active += ChildCount(node) * count;
    use_.issued += ChildCount(node) * bundle_.packets * kPacketRows;
    const auto cross = [&](size_t first, MaskB& hit) HWY_ATTR {
      return CrossChildren(bundle_.bounds, node, first, farthest_, hit);
    };
    const uint32_t before = size_;
    size_ += PushCrossed<false>(cross, node, bundle_.bounds.planes.octant, child_ + size_,
                                enter_ + size_, box_ + size_);
    for (uint32_t k = before; k < size_; ++k) {
      PrefetchChild(bvh_, child_[k]);
      box_[k] += child * kBvhWidth;
      lanes_[k] = lanes;
    }
  }

  // Which triangles of a block may be hit. Where many rays come to it, the bounds of the bundle are
  // asked; if they leave one triangle, all rays are tested. False if nothing is left to do.
  HWY_INLINE bool AskBounds(uint32_t child, uint32_t& triangles) {
    triangles = (1u << LeafCount(child)) - 1;
    const uint64_t coming = lanes_[size_];
    if (!bundle_.bounds.have_slopes || hwy::PopCount(coming) < kManyAtBlock) return true;
    const TriangleBlock& block = bvh_.blocks[LeafBlock(child)];
    triangles &= CrossTriangles(bundle_.bounds, block);
    if (triangles == 0) return false;
    if ((triangles & (triangles - 1)) != 0) return true;
    use_.active += bundle_.packets * kPacketRows;
    use_.issued += bundle_.packets * kPacketRows;
    if (HitPackets(block, triangles, coming) && size_ > 0) farthest_ = Farthest();
    return false;
  }

  // A block's triangles against one ray cost about as much as a triangle against a packet; that
  // they cost half of it lost 3 to 7 % (Cornell box, pillars, valley; AVX-512).
  HWY_INLINE void VisitBlock(uint32_t child, uint32_t triangles, uint64_t lanes, uint32_t count) {
    const TriangleBlock& block = bvh_.blocks[LeafBlock(child)];
    uint32_t packets = 0;
    for (size_t p = 0; p < bundle_.packets; ++p) packets += AnyOfPacket(lanes, p) ? 1 : 0;
    const uint32_t tests = packets * static_cast<uint32_t>(hwy::PopCount(triangles));
    bool any = false;
    if (tests < count) {
      use_.active += static_cast<uint32_t>(hwy::PopCount(triangles)) * count;
      use_.issued += tests * kPacketRows;
      any = HitPackets(block, triangles, lanes);
    } else {
      use_.active += LeafCount(child) * count;
      use_.issued += kBlockWidth * count;
      any = HitLanes(block, lanes);
    }
    if (any && size_ > 0) farthest_ = Farthest();
  }

  HWY_INLINE bool HitPackets(const TriangleBlock& block, uint32_t triangles, uint64_t lanes) {
    return bundle_.bounds.one_axis ? HitPackets<true>(block, triangles, lanes)
                                   : HitPackets<false>(block, triangles, lanes);
  }

  template <bool kOneAxis>
  HWY_INLINE bool HitPackets(const TriangleBlock& block, uint32_t triangles, uint64_t lanes) {
    LazyBoxes boxes(block);
    bool any = false;
    const VertexColumns& columns = bundle_.bounds.columns;
    for (; triangles != 0; triangles &= triangles - 1) {
      const uint32_t i = static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(triangles));
      for (size_t p = 0; p < bundle_.packets; ++p) {
        if (!AnyOfPacket(lanes, p)) continue;
        const PacketRays& rays = bundle_.rays[p];
        const auto vertex = [&](size_t k) HWY_ATTR {
          if (!kOneAxis) return PermutedVertex(rays, block, k, i);
          const float* of_vertex = block.vertex[k][0] + i;
          return ShearVertex(rays.shear, Set(of_vertex[columns.x]), Set(of_vertex[columns.y]),
                             Set(of_vertex[columns.z]));
        };
        any |= HitTriangle<kAny>(rays, vertex(0), vertex(1), vertex(2), i,
                                 bundle_.bounds.planes.octant, boxes, bundle_.best[p]);
      }
    }
    return any;
  }

  // All triangles against one ray at a time: first which may be hit, then the hits. Of rays whose
  // closest hit is asked for, camera rays are most, and they have nothing behind them.
  HWY_INLINE bool HitLanes(const TriangleBlock& block, uint64_t lanes) {
    uint32_t crossing = 0;
    for (uint64_t left = lanes; left != 0; left &= left - 1) {
      const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
      const RayBatch& batch = BatchOf(i / kPacketRows);
      const size_t lane = i % kPacketRows;
      const uint32_t crossed =
          CrossTriangles<!kAny>(batch.ShearOf(lane), kVertexColumns[batch.z_axis[lane]], block);
      crosses_[crossing] = static_cast<uint32_t>(i);
      crossed_[crossing] = crossed;
      crossing += crossed != 0 ? 1 : 0;
    }
    for (uint32_t k = 0; k < crossing; ++k) {
      const size_t p = crosses_[k] / kPacketRows, i = crosses_[k] % kPacketRows;
      LaneHits& best = bundle_.best[p];
      SingleRay ray;
      BatchOf(p).Take(i, ray);
      ray.best = best.Get(i);
      ray.inside = kNone;
      ray.enter = 0.0f;
      const bool ended = HitBlock<kAny>(ray, block, crossed_[k]);
      best.Put(i, ended ? -1.0f : ray.best.t, ray.best);
    }
    return crossing != 0;
  }

  const BvhView& bvh_;
  Bundle& bundle_;
  LaneLists& lists_;
  LaneUse& use_;

  float farthest_;        // no hit beyond it counts for any ray
  uint64_t are_batched_;  // bit p: BatchOf(p) is there
  RayBatch batches_[kBundlePackets];
  alignas(64) float lane_enter_[kBundleRays];
  uint32_t crosses_[kBundleRays + 1], crossed_[kBundleRays + 1];  // lanes, their triangles
  // Children that wait, where the first ray may enter them, and where their boxes are.
  uint32_t size_;
  uint32_t child_[kMaxBvhStack + kBvhWidth];
  float enter_[kMaxBvhStack + kBvhWidth];
  uint32_t box_[kMaxBvhStack + kBvhWidth];
  uint64_t lanes_[kMaxBvhStack + kBvhWidth];  // that entered the parent
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_DESCEND_BUNDLE_INL_H_
