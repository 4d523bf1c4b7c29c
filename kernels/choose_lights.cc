// Points -> lights, down the light tree: of a row of siblings a lane goes to one, with a
// probability in proportion to the light that it may send.
#include "kernels/choose_lights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/choose_lights.cc"
#include <hwy/foreach_target.h>

#include "kernels/light_lanes-inl.h"
#include "kernels/light_nodes-inl.h"
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

// Whether a cone of emission narrower than a half space may reach the point: cos_w as Importance
// has `along`, at distance d.
HWY_NOINLINE Mask Reaches(const NodeLanes& node, F32 cos_w, F32 d, F32 d2) {
  const F32 chord2 = hn::NegMulAdd(node.radius, node.radius, d2);
  const F32 cos_u = hn::Div(hn::Sqrt(hn::Max(chord2, hn::Zero(D()))), d);
  const F32 cos_a = CosOfDifference(cos_w, SinOf(cos_w), node.cos_o, node.sin_o);
  const F32 cos = CosOfDifference(cos_a, SinOf(cos_a), cos_u, hn::Div(node.radius, d));
  return hn::Gt(cos, node.cos_e);
}

// A bound on the light that a node's lights send to a point, up to a factor (Conty Estevez & Kulla
// 2018, equation 3). u is the half angle of the cone that their box fills; for cos(a - u) stands
// cos a + sin u, which is not less and takes no root.
HWY_INLINE F32 Importance(const NodeLanes& node, const SeenFrom& at) {
  const F32 zero = hn::Zero(D());
  const Vec3 to = Sub(node.centre, at.p);
  const F32 to2 = Dot(to, to);
  const F32 radius2 = hn::Mul(node.radius, node.radius);
  const Mask inside = hn::Le(to2, radius2);
  // Within the box its own size stands for the distance.
  const F32 d2 = hn::Max(hn::Max(to2, radius2), Set(1e-20f));
  const F32 d = hn::Sqrt(d2);

  // d times the cosine of the least angle between an axis and a direction to the point.
  const F32 away = Dot(to, node.axis);
  const MaskU two_sided = hn::TestBit(node.child, SetU(kLightNodeTwoSided));
  const F32 along = hn::IfThenElse(ToFloatMask(two_sided), hn::Abs(away), hn::Neg(away));
  const F32 across = hn::Sqrt(hn::Max(hn::NegMulAdd(along, along, d2), zero));
  const F32 from_edge = hn::MulAdd(along, node.cos_o, hn::Mul(across, node.sin_o));
  const Mask in_cone = hn::Gt(along, hn::Mul(d, node.cos_o));
  const F32 light = hn::IfThenElse(hn::Or(inside, in_cone), d,
                                   hn::Min(hn::Max(hn::Add(from_edge, node.radius), zero), d));

  // d times the greatest cosine at the point. That of the coded normal may be off by so much.
  const F32 up = hn::Add(hn::MulAdd(Set(kNormalCodeError), d, Dot(to, at.n)), node.radius);
  const F32 point = hn::IfThenElse(hn::Or(inside, at.no_side), d, hn::Min(hn::Max(up, zero), d));

  const F32 inverse = hn::Div(Set(1.0f), d2);
  const F32 cosines = hn::Mul(inverse, hn::Mul(light, point));
  const F32 level = hn::Min(hn::Mul(hn::Mul(node.intensity, inverse), cosines), Set(1e30f));
  const MaskU narrow = hn::TestBit(node.child, SetU(kLightNodeNarrow));
  if (hn::AllFalse(DU(), narrow)) return level;
  const Mask reaches = hn::Or(inside, Reaches(node, hn::Div(along, d), d, d2));
  return hn::IfThenElseZero(hn::Or(reaches, ToFloatMask(hn::Not(narrow))), level);
}

struct Siblings {
  F32 level[kLightSiblings];  // importance
  F32 sum[kLightSiblings];    // of it and those before
  U32 child[kLightSiblings];
  HWY_INLINE F32 total() const { return sum[kLightSiblings - 1]; }
  HWY_INLINE void AddUp() {
    sum[0] = level[0];
    for (uint32_t k = 1; k < kLightSiblings; ++k) sum[k] = hn::Add(sum[k - 1], level[k]);
  }
};

// Where none of the siblings may send light, all are alike.
HWY_INLINE Siblings Weigh(const LightNode* nodes, U32 first, const SeenFrom& at) {
  const SiblingLanes lanes(nodes, first);
  Siblings row;
  for (uint32_t k = 0; k < kLightSiblings; ++k) {
    const NodeLanes node = lanes.Get(k);
    row.level[k] = Importance(node, at);
    row.child[k] = node.child;
  }
  row.AddUp();
  const Mask dark = hn::Le(row.total(), hn::Zero(D()));
  if (hn::AllFalse(D(), dark)) return row;
  for (uint32_t k = 0; k < kLightSiblings; ++k) {
    const Mask is_one = ToFloatMask(hn::Ne(row.child[k], SetU(kNoLightNode)));
    row.level[k] = hn::IfThenElse(hn::And(dark, is_one), Set(1.0f), row.level[k]);
  }
  row.AddUp();
  return row;
}

HWY_INLINE SeenFrom LoadPoint(const LightTreeLanes& lanes) {
  const U32 side = hn::Load(DU(), lanes.side);
  return {LoadLanes(lanes.point), DecodeNormal(side),
          ToFloatMask(hn::Eq(side, SetU(kNoNormalCode)))};
}

HWY_INLINE MaskU IsLeaf(U32 child) { return hn::TestBit(child, SetU(kLightLeaf)); }
HWY_INLINE U32 WithoutFlags(U32 child) { return hn::And(child, SetU(~kLightNodeFlags)); }

// A number that has taken part in so many choices has few digits left; hashed ones replace them.
inline constexpr uint32_t kChoicesPerNumber = 3;  // of one of eight
inline constexpr float kBelowOne = 0x1.fffffep-1f;
HWY_INLINE F32 Refresh(F32 u, U32 seed, uint32_t depth) {
  const F32 cells = Set(4096.0f);
  const F32 cell = hn::Floor(hn::Mul(u, cells));
  const F32 refreshed = hn::Div(hn::Add(cell, HashUniform(seed, SetU(depth))), cells);
  return hn::Min(refreshed, Set(kBelowOne));  // the sum rounds
}

// What is left for the tree beside the distant lights.
HWY_INLINE float TreeShare(const LightTreeView& tree) {
  return tree.any ? 1.0f - static_cast<float>(tree.distant_count) * tree.distant_pdf : 0.0f;
}

void DrawFromLightTree(const LightsView& lights, LightTreeLanes& lanes) {
  const LightTreeView& tree = lights.tree;
  const F32 below_one = Set(kBelowOne);
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
    const Siblings row = Weigh(tree.nodes, first, at);
    // u < 1, so x is below the total, and a sibling without importance is never taken.
    const F32 x = hn::Mul(u, row.total());
    F32 before = hn::Zero(D()), level = row.level[0];
    U32 next = row.child[0];
    for (uint32_t k = 1; k < kLightSiblings; ++k) {
      const Mask past = hn::Ge(x, row.sum[k - 1]);
      before = hn::IfThenElse(past, row.sum[k - 1], before);
      level = hn::IfThenElse(past, row.level[k], level);
      next = hn::IfThenElse(ToUintMask(past), row.child[k], next);
    }
    const F32 side_pdf = hn::Div(level, row.total());
    const F32 rest = hn::Div(hn::Sub(x, before), level);
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
    const Siblings row = Weigh(tree.nodes, first, at);
    const U32 side = hn::And(trail, SetU(kLightSiblings - 1));
    F32 level = row.level[0];
    U32 next = row.child[0];
    for (uint32_t k = 1; k < kLightSiblings; ++k) {
      const MaskU is_side = hn::Eq(side, SetU(k));
      level = hn::IfThenElse(ToFloatMask(is_side), row.level[k], level);
      next = hn::IfThenElse(is_side, row.child[k], next);
    }
    const F32 side_pdf = hn::Div(level, row.total());
    child = hn::IfThenElse(done, child, next);
    pdf = hn::IfThenElse(ToFloatMask(done), pdf, hn::Mul(pdf, side_pdf));
    trail = hn::ShiftRight<kLightTrailBits>(trail);
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
