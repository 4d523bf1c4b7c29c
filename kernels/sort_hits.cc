// Hits -> row ids grouped by material, stable.
#include "kernels/sort_hits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/sort_hits.cc"
#include <hwy/foreach_target.h>

#include "kernels/texture_point-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The amounts that textures give the mixes of rows from `row` on; `constant` for the others.
HWY_NOINLINE F32 TexturedAmount(const SortHitsArgs& args, MaskU textured, size_t row, U32 program,
                                F32 constant) {
  const SceneView& scene = *args.scene;
  const size_t leader = static_cast<size_t>(hn::FindKnownFirstTrue(DU(), textured));
  const U32 prim = hn::IfThenElse(textured, Load(args.prims, row), SetU(args.prims[row + leader]));
  const F32 b1 = Load(args.u, row), b2 = Load(args.v, row);
  const U32 none = SetU(kNone);
  const U32 instance =
      scene.instance_count == 0 ? none : hn::IfThenElse(textured, Load(args.instances, row), none);
  const Surface surface = HitSurface(scene, Load(args.orgs, row), Load(args.dirs, row),
                                     Load(args.distances, row), instance, prim, b1, b2);
  const SurfaceUv uv = HitUv(scene, surface.p, instance, prim, b1, b2);
  const TexturePoint at = MakeTexturePoint(scene, args.pixel, surface, uv, instance, prim, b1, b2);
  return TextureNumber(scene.textures, program, textured, at, constant);
}

// The materials of rows from `row` on, where one of a mix stands for the mix: by a hash of the hit,
// so that a hit has one material whatever finds it.
HWY_INLINE U32 ResolveMixes(const SortHitsArgs& args, MaskU hit, size_t row, U32 material) {
  const MixRecord* mixes = args.scene->materials.mixes;
  const uint32_t* words = reinterpret_cast<const uint32_t*>(mixes);
  const float* floats = reinterpret_cast<const float*>(mixes);
  for (;;) {  // until none is left: mixes of mixes end, as none holds itself
    const MaskU mixed = hn::And(hit, hn::TestBit(material, SetU(kMixedMaterial)));
    if (hn::AllFalse(DU(), mixed)) return material;
    const U32 mix = hn::IfThenElseZero(mixed, hn::Xor(material, SetU(kMixedMaterial)));
    const U32 at = hn::ShiftLeft<2>(mix);
    const Vec3 dir = Load(args.dirs, row);
    // Parallel rays differ by nothing else than where they start.
    const Vec3 org = Load(args.orgs, row);
    const U32 place = hn::Xor(HashSeed(org.x, org.y, org.z), Bits(Load(args.distances, row)));
    const U32 seed = hn::Xor(HashSeed(dir.x, dir.y, dir.z), HashBits(place));
    F32 amount = Gather(floats + 2, at);
    if (args.scene->textures.textured_mixes) {
      const U32 program = Gather(words + 3, at);
      const MaskU textured = hn::And(mixed, hn::Ne(program, SetU(kNoTexture)));
      if (!hn::AllFalse(DU(), textured)) {
        amount = TexturedAmount(args, textured, row, program, amount);
      }
    }
    const MaskU second = ToUintMask(hn::Lt(HashUniform(seed, mix), amount));
    const U32 chosen = hn::IfThenElse(second, Gather(words + 1, at), Gather(words, at));
    material = hn::IfThenElse(mixed, chosen, material);
  }
}

// Key of each row: its material, then materials + 0 for a miss, + 1 at the last bounce. Returns
// whether all keys are equal.
bool ComputeKeys(const SortHitsArgs& args) {
  const SceneView& scene = *args.scene;
  const U32 miss_key = SetU(scene.materials.count);
  const U32 end_key = SetU(scene.materials.count + 1);
  const uint32_t* shape_words = reinterpret_cast<const uint32_t*>(scene.shapes);
  U32 differs = hn::Zero(DU());
  U32 first_key = hn::Zero(DU());
  for (size_t i = 0; i < args.count; i += hn::Lanes(DU())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const U32 prim = Load(args.prims, i);
    const U32 bounce = hn::And(Load(args.states, i), SetU(kBounceMask));

    const MaskU hit = hn::And(active, hn::Ne(prim, SetU(kNoPrim)));
    U32 key = miss_key;
    if (!hn::AllFalse(DU(), hit)) {
      const U32 shape = Gather(scene.prim_shape, hn::IfThenElseZero(hit, prim));
      const U32 named = Gather(shape_words, hn::ShiftLeft<3>(shape));
      const U32 material = ResolveMixes(args, hit, i, named);
      const MaskU scatters = hn::Lt(bounce, SetU(args.max_depth));
      key = hn::IfThenElse(hit, hn::IfThenElse(scatters, material, end_key), miss_key);
    }
    if (i == 0) first_key = hn::Set(DU(), hn::GetLane(key));
    differs = hn::Or(differs, hn::IfThenElseZero(active, hn::Xor(key, first_key)));

    Store(key, args.keys, i);
  }
  return hn::AllTrue(DU(), hn::Eq(differs, hn::Zero(DU())));
}

uint32_t RunMaterial(uint32_t key, uint32_t materials) {
  return key < materials ? key : key == materials ? kMissRun : kEndRun;
}

size_t SortHits(const SortHitsArgs& args, uint32_t* rows, Run* runs) {
  if (args.count == 0) return 0;
  const uint32_t materials = args.scene->materials.count;
  const uint32_t count = static_cast<uint32_t>(args.count);
  if (ComputeKeys(args)) {
    for (uint32_t i = 0; i < count; ++i) rows[i] = i;
    runs[0] = {RunMaterial(args.keys[0], materials), 0, count};
    return 1;
  }
  uint32_t* histogram = args.histogram;
  for (uint32_t i = 0; i < count; ++i) ++histogram[args.keys[i]];
  size_t run_count = 0;
  uint32_t first = 0;
  for (uint32_t key = 0; key < materials + 2; ++key) {
    const uint32_t length = histogram[key];
    if (length != 0) runs[run_count++] = {RunMaterial(key, materials), first, length};
    histogram[key] = first;
    first += length;
  }
  for (uint32_t i = 0; i < count; ++i) rows[histogram[args.keys[i]]++] = i;
  for (uint32_t key = 0; key < materials + 2; ++key) histogram[key] = 0;
  return run_count;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(SortHits);
size_t SortHits(const SortHitsArgs& args, uint32_t* rows, Run* runs) {
  return HWY_DYNAMIC_DISPATCH(SortHits)(args, rows, runs);
}
}  // namespace swell::SWELL_WIDTH
#endif
