// Points -> lights, down the light tree: at each node a lane goes to the side that may send it more
// light, with a probability in proportion.
#include "kernels/choose_lights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/choose_lights.cc"
#include <hwy/foreach_target.h>

#include "kernels/light_lanes-inl.h"
#include "kernels/light_tree-inl.h"
#include "kernels/sampling-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct SeenFrom {
  Vec3 p;
  Vec3 n;        // 0: light from all sides counts
  Mask no_side;  // the lanes with n = 0
};

// cos(a - b), 1 where b is the larger angle.
HWY_INLINE F32 CosOfDifference(F32 cos_a, F32 sin_a, F32 cos_b, F32 sin_b) {
  const F32 difference = hn::MulAdd(cos_a, cos_b, hn::Mul(sin_a, sin_b));
  return hn::IfThenElse(hn::Gt(cos_a, cos_b), Set(1.0f), difference);
}
HWY_INLINE F32 SinOf(F32 cos) {
  return hn::Sqrt(hn::Max(hn::NegMulAdd(cos, cos, Set(1.0f)), hn::Zero(D())));
}

struct NodeLanes : RecordLanes<LightNode> {
  using RecordLanes::RecordLanes;
  HWY_INLINE U32 child() const { return Word(offsetof(LightNode, child)); }
};

// A bound on the light that a node's lights send to a point, up to a factor (Conty Estevez & Kulla
// 2018, equation 3). u is the half angle of the cone that their box fills.
HWY_INLINE F32 Importance(const NodeLanes& node, const SeenFrom& at) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f);
  const Vec3 to = Sub(node.Vector(offsetof(LightNode, centre)), at.p);
  const F32 radius2 = node.Float(offsetof(LightNode, radius2));
  const F32 d2 = Dot(to, to);
  const Mask inside = hn::Le(d2, radius2);
  const F32 safe_d2 = hn::IfThenElse(inside, one, d2);
  const F32 sin2_u = hn::Div(radius2, safe_d2);  // below 1 outside
  const F32 cos_u = hn::Sqrt(hn::Max(hn::Sub(one, sin2_u), zero));
  const F32 sin_u = hn::Sqrt(sin2_u);
  const F32 inverse = hn::Div(one, hn::Sqrt(safe_d2));
  const Vec3 wi = Scale(inverse, to);

  // The least angle between an axis and a direction to the point.
  const F32 along = hn::Neg(Dot(wi, node.Vector(offsetof(LightNode, axis))));
  const MaskU two_sided = hn::TestBit(node.child(), SetU(kLightNodeTwoSided));
  const F32 cos_w = hn::IfThenElse(ToFloatMask(two_sided), hn::Abs(along), along);
  const F32 cos_a = CosOfDifference(cos_w, SinOf(cos_w), node.Float(offsetof(LightNode, cos_o)),
                                    node.Float(offsetof(LightNode, sin_o)));
  const F32 outside_cos = CosOfDifference(cos_a, SinOf(cos_a), cos_u, sin_u);
  const F32 cos_light = hn::IfThenElse(inside, one, outside_cos);
  const Mask shines = hn::Gt(cos_light, node.Float(offsetof(LightNode, cos_e)));

  // The greatest cosine at the point. That of the coded normal may be off by so much.
  const F32 cos_n = Dot(wi, at.n);
  const F32 seen = hn::Min(
      one, hn::Add(CosOfDifference(cos_n, SinOf(cos_n), cos_u, sin_u), Set(kNormalCodeError)));
  const F32 cos_point = hn::IfThenElse(hn::Or(inside, at.no_side), one, hn::Max(seen, zero));

  // Within the box its own size stands for the distance.
  const F32 least = Set(1e-30f);
  const F32 distance2 = hn::Max(hn::Max(d2, radius2), least);
  const F32 level = hn::Mul(node.Float(offsetof(LightNode, intensity)),
                            hn::Mul(hn::Max(cos_light, zero), cos_point));
  return hn::IfThenElseZero(shines, hn::Min(hn::Div(level, distance2), Set(1e30f)));
}

// Probability of the first of two siblings. Where neither may send light, both are alike.
HWY_INLINE F32 FirstSide(const LightNode* nodes, U32 first, const SeenFrom& at) {
  const F32 a = Importance(NodeLanes(nodes, first), at);
  const F32 b = Importance(NodeLanes(nodes, hn::Add(first, SetU(1))), at);
  const F32 sum = hn::Add(a, b);
  return hn::IfThenElse(hn::Gt(sum, hn::Zero(D())), hn::Div(a, sum), Set(0.5f));
}

HWY_INLINE SeenFrom LoadPoint(const LightTreeLanes& lanes) {
  const U32 side = hn::Load(DU(), lanes.side);
  return {LoadLanes(lanes.point), DecodeNormal(side),
          ToFloatMask(hn::Eq(side, SetU(kNoNormalCode)))};
}

HWY_INLINE MaskU IsLeaf(U32 child) { return hn::TestBit(child, SetU(kLightLeaf)); }
HWY_INLINE U32 WithoutFlags(U32 child) {
  return hn::And(child, SetU(~(kLightLeaf | kLightNodeTwoSided)));
}

// A number that has taken part in so many choices has few digits left; hashed ones replace them.
inline constexpr uint32_t kChoicesPerNumber = 8;
HWY_INLINE F32 Refresh(F32 u, U32 seed, uint32_t depth) {
  const F32 cells = Set(4096.0f);
  const F32 cell = hn::Floor(hn::Mul(u, cells));
  return hn::Div(hn::Add(cell, HashUniform(seed, SetU(depth))), cells);
}

// What is left for the tree beside the distant lights.
HWY_INLINE float TreeShare(const LightTreeView& tree) {
  return tree.any ? 1.0f - static_cast<float>(tree.distant_count) * tree.distant_pdf : 0.0f;
}

void DrawFromLightTree(const LightsView& lights, LightTreeLanes& lanes) {
  const LightTreeView& tree = lights.tree;
  const F32 one = Set(1.0f), below_one = Set(0x1.fffffep-1f);
  const SeenFrom at = LoadPoint(lanes);
  F32 u = hn::Load(D(), lanes.u);
  const U32 seed = HashSeed(u, at.p.x, hn::Add(at.p.y, at.p.z));

  // The distant lights share the first part of u.
  U32 child = SetU(tree.root);
  F32 pdf = Set(TreeShare(tree));
  if (tree.distant_count != 0) {
    const F32 distant = Set(1.0f - TreeShare(tree));
    const Mask is_distant = hn::Lt(u, distant);
    const F32 slot = hn::Floor(hn::Div(u, Set(tree.distant_pdf)));
    const U32 nth = hn::BitCast(DU(), hn::ConvertTo(DI(), hn::IfThenElseZero(is_distant, slot)));
    const U32 light = Gather(tree.distant, hn::Min(nth, SetU(tree.distant_count - 1)));
    child = hn::IfThenElse(ToUintMask(is_distant), hn::Or(light, SetU(kLightLeaf)), child);
    pdf = hn::IfThenElse(is_distant, Set(tree.distant_pdf), pdf);
    if (tree.any) u = hn::Min(hn::Div(hn::Sub(u, distant), pdf), below_one);
  }

  MaskU done = IsLeaf(child);
  for (uint32_t depth = 0; !hn::AllTrue(DU(), done); ++depth) {
    if (depth % kChoicesPerNumber == kChoicesPerNumber - 1) u = Refresh(u, seed, depth);
    const U32 first = hn::IfThenZeroElse(done, WithoutFlags(child));
    const F32 p = FirstSide(tree.nodes, first, at);
    const Mask is_first = hn::Lt(u, p);
    const F32 side_pdf = hn::IfThenElse(is_first, p, hn::Sub(one, p));
    const F32 rest = hn::Div(hn::IfThenElse(is_first, u, hn::Sub(u, p)), side_pdf);
    const U32 node = hn::IfThenElse(ToUintMask(is_first), first, hn::Add(first, SetU(1)));
    const U32 next = NodeLanes(tree.nodes, node).child();
    child = hn::IfThenElse(done, child, next);
    pdf = hn::IfThenElse(ToFloatMask(done), pdf, hn::Mul(pdf, side_pdf));
    u = hn::Min(rest, below_one);
    done = IsLeaf(child);
  }
  hn::Store(WithoutFlags(child), DU(), lanes.light);
  hn::Store(pdf, D(), lanes.pdf);
}

// The same products, along the way that a light's trail tells.
void FindLightTreePdf(const LightsView& lights, LightTreeLanes& lanes) {
  const LightTreeView& tree = lights.tree;
  const F32 one = Set(1.0f);
  const SeenFrom at = LoadPoint(lanes);
  const LightLanes light(lights, hn::Load(DU(), lanes.light));
  const U32 type = light.type();
  U32 trail = light.Word(offsetof(LightRecord, trail));
  const MaskU is_distant =
      hn::Or(hn::Eq(type, SetU(kDistantLight)),
             hn::Or(hn::Eq(type, SetU(kInfiniteLight)), hn::Eq(type, SetU(kImageInfiniteLight))));
  F32 pdf = hn::IfThenElse(ToFloatMask(is_distant), Set(tree.distant_pdf), Set(TreeShare(tree)));
  U32 child = hn::IfThenElse(is_distant, SetU(kLightLeaf), SetU(tree.root));
  MaskU done = IsLeaf(child);
  while (!hn::AllTrue(DU(), done)) {
    const U32 first = hn::IfThenZeroElse(done, WithoutFlags(child));
    const F32 p = FirstSide(tree.nodes, first, at);
    const U32 side = hn::And(trail, SetU(1));
    const MaskU is_first = hn::Eq(side, hn::Zero(DU()));
    const F32 side_pdf = hn::IfThenElse(ToFloatMask(is_first), p, hn::Sub(one, p));
    const U32 next = NodeLanes(tree.nodes, hn::Add(first, side)).child();
    child = hn::IfThenElse(done, child, next);
    pdf = hn::IfThenElse(ToFloatMask(done), pdf, hn::Mul(pdf, side_pdf));
    trail = hn::ShiftRight<1>(trail);
    done = IsLeaf(child);
  }
  hn::Store(pdf, D(), lanes.pdf);
}

HWY_INLINE U32 LoadSide(const ChooseLightsArgs& args, size_t i) {
  if (args.normal.x == nullptr) return SetU(kNoNormalCode);
  return EncodeNormal(Load(args.normal, i));
}

void ChooseLights(const ChooseLightsArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const LightChoice choice =
        ChooseLight(*args.lights, Load(args.point, i), LoadSide(args, i), Load(args.u, i));
    Store(choice.light, args.light, i);
    Store(choice.pdf, args.pdf, i);
  }
}

void ChoicePdfs(const ChooseLightsArgs& args) {
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const U32 light = hn::IfThenElseZero(active, Load(args.light, i));
    Store(ChoicePdf(*args.lights, Load(args.point, i), LoadSide(args, i), light), args.pdf, i);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(ChooseLights);
HWY_EXPORT(ChoicePdfs);
void ChooseLights(const ChooseLightsArgs& args) { HWY_DYNAMIC_DISPATCH(ChooseLights)(args); }
void ChoicePdfs(const ChooseLightsArgs& args) { HWY_DYNAMIC_DISPATCH(ChoicePdfs)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
