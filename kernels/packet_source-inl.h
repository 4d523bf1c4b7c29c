// Rays and a tree in, rays that go on alone out: bundles go down from the root as long as enough of
// their rays go together; what is left of each ray waits on its list, and comes out with it.
#if defined(SWELL_KERNELS_PACKET_SOURCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_PACKET_SOURCE_INL_H_
#undef SWELL_KERNELS_PACKET_SOURCE_INL_H_
#else
#define SWELL_KERNELS_PACKET_SOURCE_INL_H_
#endif

#include "kernels/descend_bundle-inl.h"
#include "kernels/sort_directions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A leaf of an object that at most so many rays of a packet enter is tested ray by ray, all
// triangles at once, not triangle by triangle for all rays: 3 to 7 were alike (room, AVX-512).
inline constexpr uint32_t kFewAtLeaf = 4;

// Origins of a bundle farther from each other than this, in extents of the scene, are not coherent:
// 1/32 to 1/8 were alike; 1/64 lost a fifth on shadow rays among pillars (AVX-512).
inline constexpr float kFarOrigins = 0.0625f;

// finish(row, hit) is called once for every row of `in`, in any order; or finish(row, hits) for a
// whole vector of rows from `row` on; or finish(rows, lanes, hits) for those lanes of a vector.
template <bool kAny, class Finish> class PacketSource {
 public:
  // A child that at most `few` rays of a bundle enter waits until they go on alone. 0: none does;
  // as many as there are lanes: all do, from the root.
  PacketSource(const BvhView& bvh, const RayColumns& in, uint32_t few, const Finish& finish)
      : bvh_(bvh), in_(in), few_(few), finish_(finish), descent_(bvh, bundle_, lists_, use) {}

  // The next ray that has something left to visit, at its first child. False if there is none.
  HWY_INLINE bool Take(SingleRay& ray, SingleStack& stack) {
    for (;;) {
      for (; alone_ != 0; alone_ &= alone_ - 1) {
        const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(alone_);
        TakeLane(descent_.BatchOf(i / kPacketRows), i, ray);
        ray.inside = kNone;
        ray.enter = 0.0f;
        PushNearer(ray, stack, lists_.Children(i), lists_.Enters(i), lists_.Size(i));
        if (ray.stack_size > 0) {
          alone_ &= alone_ - 1;
          return true;
        }
        finish_(ray.row, ray.best);
      }
      if (row_ == sorted_count_ && !Sort()) return false;
      RunBundle();
    }
  }

  LaneUse use;

 private:
  // False if there are no rows left.
  HWY_INLINE bool Sort() {
    if (first_ == in_.count) return false;
    sorted_count_ = HWY_MIN(kMostSorted, in_.count - first_);
    if (hn::MaxLanes(D()) == 1) {
      for (size_t i = 0; i < sorted_count_; ++i) sorted_.row[i] = static_cast<uint32_t>(first_ + i);
    } else {
      // Shadow rays that start far apart still end at the same lights; of closest hits first
      // bounces are 4 % slower than by octants alone, as the origins of a bundle spread (AVX-512).
      SortDirections<kAny>(in_.dir, first_, sorted_count_, sorted_);
    }
    first_ += sorted_count_;
    row_ = 0;
    octant_ = 0;
    return true;
  }

  // Rays that start far from each other go alone from the root on.
  HWY_INLINE uint32_t Few() const {
    const bool far = bundle_.bounds.org_extent > kFarOrigins * extent_;
    return few_ != 0 && far ? kBundleRays : few_;
  }

  // The largest extent of the tree's box.
  static HWY_INLINE float ExtentOf(const BvhNode& root) {
    float extent = 0.0f;
    for (uint32_t k = 0; k < 3; ++k) {
      float lower = root.bounds[k][0], upper = root.bounds[k + 3][0];
      for (uint32_t i = 1; i < ChildCount(root); ++i) {
        lower = HWY_MIN(lower, root.bounds[k][i]);
        upper = HWY_MAX(upper, root.bounds[k + 3][i]);
      }
      extent = HWY_MAX(extent, upper - lower);
    }
    return extent;
  }

  // How many of the next rows are of one octant, at most a bundle's.
  HWY_INLINE size_t NextOfOctant() {
    if (hn::MaxLanes(D()) == 1) return 1;
    while (sorted_.end[octant_] == row_) ++octant_;
    return HWY_MIN(kBundleRays, sorted_.end[octant_] - row_);
  }

  HWY_NOINLINE void RunBundle() {
    const size_t count = NextOfOctant();
    const uint32_t* sorted = sorted_.row + row_;
    lane_row_ = sorted;
    row_ += count;
    uint64_t in_turn = 0;  // bit p: the rows of packet p are, and it is full
    bundle_.packets = (count + kPacketRows - 1) / kPacketRows;
    for (size_t p = 0; p < bundle_.packets; ++p) {
      const size_t at = p * kPacketRows;
      const RowLanes rows(Load(sorted, at), sorted[at]);
      SetUpRays(bvh_, in_, rows, HWY_MIN(count - at, kPacketRows), bundle_.rays[p]);
      in_turn |= (rows.InTurn() && count - at >= kPacketRows ? uint64_t{1} : 0) << p;
      bundle_.best[p].Clear(bundle_.rays[p].t);
    }
    const bool any_active = BoundBundle<kAny>(bundle_);
    const uint32_t few = any_active ? Few() : 0;
    if (few > 0) lists_.Clear(bundle_.packets * kPacketRows);
    if (any_active) {
      descent_.Run(few, [&](uint32_t child, uint64_t lanes) HWY_ATTR { OddLeaf(child, lanes); });
    }
    alone_ = 0;
    for (size_t p = 0; p < bundle_.packets; ++p) {
      const size_t at = p * kPacketRows;
      uint64_t waiting = 0;
      if (few > 0) {
        waiting = lists_.Waiting(at) &
                  MaskBits(D(), hn::Ge(hn::Load(D(), bundle_.best[p].t), hn::Zero(D())));
      }
      alone_ |= waiting << at;
      const size_t rows = HWY_MIN(count - at, kPacketRows);
      if (waiting == 0 && ((in_turn >> p) & 1) != 0) {
        finish_(sorted[at], bundle_.best[p]);
        continue;
      }
      const uint64_t all = (uint64_t{1} << rows) - 1;
      finish_(sorted + at, all & ~waiting, bundle_.best[p]);
    }
  }

  // In the space of the rays of the batch, an instance's or the world's.
  HWY_INLINE void TakeLane(const RayBatch& batch, size_t i, SingleRay& ray) const {
    batch.Take(i % kPacketRows, ray);
    ray.best = bundle_.best[i / kPacketRows].Get(i % kPacketRows);
    ray.row = lane_row_[i];
    ray.stack_size = 0;
    ray.bottom = 0;
  }

  // A leaf of the world that is a sphere or an instance.
  HWY_INLINE void OddLeaf(uint32_t child, uint64_t lanes) {
    for (packet_ = 0; packet_ < bundle_.packets; ++packet_) {
      const uint32_t bits =
          static_cast<uint32_t>(lanes >> (packet_ * kPacketRows)) & ((1u << kPacketRows) - 1);
      if (bits == 0) continue;
      const PacketRays& rays = bundle_.rays[packet_];
      CountTests(1, static_cast<uint32_t>(hwy::PopCount(bits)));
      if ((child & kInstanceLeafBit) != 0) {
        VisitInstance(rays, child & kSphereIndexMask, MaskOfBits(bits));
      } else {
        HitSphere<kAny>(rays, bvh_, child & kSphereIndexMask, bundle_.best[packet_]);
      }
    }
  }

  static HWY_INLINE Mask MaskOfBits(uint32_t bits) {
    const uint64_t padded = bits;  // little-endian, as all targets are; eight bytes may be read
    return hn::LoadMaskBits(D(), reinterpret_cast<const uint8_t*>(&padded));
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

  // The lanes that enter the instance go down its object's tree, octant by octant of their
  // directions there. Until they are back, the others have ended.
  HWY_NOINLINE void VisitInstance(const PacketRays& world, uint32_t index, Mask active) {
    PacketRays rays;
    const Mask lanes = hn::And(active, EnterInstance(bvh_, index, world, rays));
    if (hn::AllFalse(D(), lanes)) return;
    LaneHits& best = bundle_.best[packet_];
    object_batch_.Fill(rays);
    const F32 t = hn::Load(D(), best.t);
    hn::Store(hn::IfThenElse(lanes, t, Set(-1.0f)), D(), best.t);
    const uint32_t root = bvh_.objects[bvh_.instances[index].object].root;
    ForEachOctant(object_batch_, lanes, [&](Mask of_octant, uint32_t octant) HWY_ATTR {
      DescendObject(rays, root, of_octant, octant);
    });
    hn::Store(hn::IfThenElse(lanes, hn::Load(D(), best.t), t), D(), best.t);
  }

  // The lanes, all of one octant, from the root of an object.
  HWY_INLINE void DescendObject(const PacketRays& rays, uint32_t root, Mask lanes,
                                uint32_t octant) {
    LaneHits& best = bundle_.best[packet_];
    stack_.size = 0;
    stack_.PushRoot(root, lanes);
    while (stack_.size > 0) {
      --stack_.size;
      const uint32_t child = stack_.child[stack_.size];
      const F32 t = hn::Load(D(), best.t);
      const Mask active = hn::Le(hn::Load(D(), stack_.enter[stack_.size]), t);
      const uint32_t bits = MaskBits(D(), active);
      if (bits == 0) continue;
      const uint32_t count = static_cast<uint32_t>(hwy::PopCount(bits));
      if ((child & kLeafBit) != 0) {
        VisitObjectLeaf(rays, child, octant, bits, count);
        continue;
      }
      const BvhNode& node = bvh_.nodes[child];
      CountTests(ChildCount(node), count);
      PushChildren(rays, active, t, octant, node, stack_);
    }
  }

  HWY_INLINE void VisitObjectLeaf(const PacketRays& rays, uint32_t child, uint32_t octant,
                                  uint32_t bits, uint32_t count) {
    LaneHits& best = bundle_.best[packet_];
    if (count <= kFewAtLeaf) {
      for (; bits != 0; bits &= bits - 1)
        VisitLaneLeaf(rays, hwy::Num0BitsBelowLS1Bit_Nonzero32(bits), child);
    } else if ((child & kSphereLeafBit) != 0) {
      CountTests(1, count);
      HitSphere<kAny>(rays, bvh_, child & kSphereIndexMask, best);
    } else {
      CountTests(LeafCount(child), count);
      HitBlock<kAny>(rays, bvh_.blocks[LeafBlock(child)], LeafCount(child), octant, best);
    }
  }

  HWY_INLINE void VisitLaneLeaf(const PacketRays& rays, size_t i, uint32_t child) {
    SingleRay ray;
    TakeLane(object_batch_, packet_ * kPacketRows + i, ray);
    ray.inside = rays.inside;
    ray.enter = hn::ExtractLane(rays.enter, i);
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
    bundle_.best[packet_].Put(i, ended ? -1.0f : ray.best.t, ray.best);
  }

  HWY_INLINE void CountTests(uint32_t tests, uint32_t lanes) {
    use.active += tests * lanes;
    use.issued += tests * hn::Lanes(D());
  }

  const BvhView& bvh_;
  const RayColumns& in_;
  const uint32_t few_;
  const Finish& finish_;

  const float extent_ = ExtentOf(bvh_.nodes[0]);
  size_t first_ = 0;         // rows before it were sorted
  size_t sorted_count_ = 0;  // rows in sorted_
  size_t row_ = 0;           // of sorted_, the next to go down
  uint32_t octant_ = 0;      // the next row's, or one before
  SortedRows sorted_;

  uint64_t alone_ = 0;        // lanes of the last bundle that are still to come out
  const uint32_t* lane_row_;  // of its lanes
  Bundle bundle_;
  LaneLists lists_;
  BundleDescent<kAny> descent_;
  size_t packet_;  // of the bundle, that is in an instance
  RayBatch object_batch_;
  PacketStack stack_;
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_PACKET_SOURCE_INL_H_
