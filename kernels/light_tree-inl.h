// Draws a light for lanes of points, by the alias table or the light tree. Lanes go to the tree in
// memory: its walk is compiled once, not into every material.
#if defined(SWELL_KERNELS_LIGHT_TREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LIGHT_TREE_INL_H_
#undef SWELL_KERNELS_LIGHT_TREE_INL_H_
#else
#define SWELL_KERNELS_LIGHT_TREE_INL_H_
#endif

#include <cstddef>

#include "kernels/normal_code-inl.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct alignas(64) LightTreeLanes {
  static constexpr size_t kRows = hn::MaxLanes(D());
  float point[3][kRows];
  uint32_t side[kRows];   // EncodeNormal of the side that light may come from, or kNoNormalCode
  float u[kRows];         // in [0, 1)
  uint32_t light[kRows];  // drawn, or given
  float pdf[kRows];       // written: the light's probability
};

// Defined in choose_lights.cc.
void DrawFromLightTree(const LightsView& lights, LightTreeLanes& lanes);
void FindLightTreePdf(const LightsView& lights, LightTreeLanes& lanes);

struct LightChoice {
  U32 light;
  F32 pdf;
};

// Picks a light by Vose's alias table.
HWY_INLINE U32 SelectLight(const LightsView& lights, F32 u) {
  const F32 scaled = hn::Mul(u, Set(static_cast<float>(lights.count)));
  const U32 slot = hn::Min(hn::BitCast(DU(), hn::ConvertTo(DI(), scaled)), SetU(lights.count - 1));
  const F32 rest = hn::Sub(scaled, hn::ConvertTo(D(), hn::BitCast(DI(), slot)));
  const Mask keep = hn::Lt(rest, Gather(lights.alias_threshold, slot));
  return hn::IfThenElse(ToUintMask(keep), slot, Gather(lights.alias, slot));
}

HWY_INLINE F32 SelectPdf(const LightsView& lights, U32 light) {
  return Gather(&lights.records->select_pdf,
                hn::Mul(light, SetU(sizeof(LightRecord) / sizeof(float))));
}

HWY_INLINE void StorePoint(const Vec3& p, U32 side, LightTreeLanes& lanes) {
  StoreLanes(p, lanes.point);
  hn::Store(side, DU(), lanes.side);
}

HWY_INLINE LightChoice ChooseLight(const LightsView& lights, const Vec3& p, U32 side, F32 u) {
  if (lights.tree.nodes == nullptr) {
    const U32 light = SelectLight(lights, u);
    return {light, SelectPdf(lights, light)};
  }
  LightTreeLanes lanes;
  StorePoint(p, side, lanes);
  hn::Store(u, D(), lanes.u);
  DrawFromLightTree(lights, lanes);
  return {hn::Load(DU(), lanes.light), hn::Load(D(), lanes.pdf)};
}

// The probability with which ChooseLight, at the same point, picks this light.
HWY_INLINE F32 ChoicePdf(const LightsView& lights, const Vec3& p, U32 side, U32 light) {
  if (lights.tree.nodes == nullptr) return SelectPdf(lights, light);
  LightTreeLanes lanes;
  StorePoint(p, side, lanes);
  hn::Store(light, DU(), lanes.light);
  FindLightTreePdf(lights, lanes);
  return hn::Load(D(), lanes.pdf);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LIGHT_TREE_INL_H_
