// A transparent layer over an opaque ground: values and samples by random walks between the two.
#if defined(SWELL_KERNELS_LAYERED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LAYERED_INL_H_
#undef SWELL_KERNELS_LAYERED_INL_H_
#else
#define SWELL_KERNELS_LAYERED_INL_H_
#endif

#include "kernels/coat-inl.h"
#include "kernels/lights-inl.h"
#include "kernels/phase-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// What lies between coat and ground: it extinguishes 1 per unit of length, of which albedo goes on
// as scattered light.
struct Layer {
  F32 thickness;
  Rgb albedo;
  F32 g;  // mean cosine of scattering
  uint32_t max_events;
  uint32_t walks;
  bool scatters;

  // thickness, g, albedo (3), maxdepth, nsamples
  explicit HWY_INLINE Layer(const float* params)
      : thickness(hn::Max(Set(params[0]), Set(1.2e-38f))),
        albedo(BroadcastRgb(params + 2)),
        g(Set(params[1] < -0.999f  ? -0.999f
              : params[1] > 0.999f ? 0.999f
                                   : params[1])),
        max_events(static_cast<uint32_t>(params[5])),
        walks(static_cast<uint32_t>(params[6])),
        scatters(params[2] != 0.0f || params[3] != 0.0f || params[4] != 0.0f) {}

  HWY_INLINE F32 Transmittance(F32 height, F32 cosine) const {
    return hn::Exp(D(), hn::Neg(hn::Abs(hn::Div(height, cosine))));
  }
};

// Guo, Hasan and Zhao 2018, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs", as
// pbrt-v4 defines it: at most max_events events of a walk count, and both sides look the same.
// Evaluate walks from wo and connects each event to wi through the coat, by a direction drawn
// there beforehand and by chance, weighed against each other; Sample walks until it is out.
//
// Ground is a material: Evaluate, Sample and whether it is `specular`. Its Proxy(coat, wo, wi) is
// a density that resembles that of its samples as they leave the coat.
template <class Ground> struct Layered {
  Coat coat;
  Ground ground;
  Layer layer;

  // No light sampling could find what it sends.
  HWY_INLINE bool IsSpecular() const { return !Connects() && !layer.scatters; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo_side, const Vec3& wi_side, U32 seed) const {
    const F32 zero = hn::Zero(D());
    const Mask below = hn::Lt(wo_side.z, zero);
    const Vec3 wo = IfThenElse(below, Neg(wo_side), wo_side);
    const Vec3 wi = IfThenElse(below, Neg(wi_side), wi_side);
    const Mask reflects = hn::And(hn::Gt(wo.z, zero), hn::Gt(wi.z, zero));
    Rgb sum = {zero, zero, zero};
    if (IsSpecular() || hn::AllFalse(D(), reflects)) return {sum, zero};
    const U32 own = HashBits(hn::Xor(seed, SetU(0x68E31DA4u)));
    for (uint32_t walk = 0; walk < layer.walks; ++walk) {
      sum = Add(sum, Connect(wo, wi, reflects, own, walk * NumbersPerWalk()));
    }
    const F32 share = hn::Div(wi.z, Set(static_cast<float>(layer.walks)));
    const F32 gloss = coat.EvaluateGloss(wo, wi).f;
    const Rgb value = Add(Scale(share, sum), Rgb{gloss, gloss, gloss});
    return {IfThenElseZero(reflects, value), hn::IfThenElseZero(reflects, Proxy(wo, wi))};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo_side, F32 u0, F32 u1, F32 u2, U32 seed) const {
    const Mask below = hn::Lt(wo_side.z, hn::Zero(D()));
    const Vec3 wo = IfThenElse(below, Neg(wo_side), wo_side);
    const F32 one = Set(1.0f);
    Mask out;  // first reflected, then also those that find their way out
    const CoatDraw first = coat.Scatter(wo, u0, u1, u2, &out);
    Walk walk = {first.wi,
                 {first.weight, first.weight, first.weight},
                 layer.thickness,
                 AndNot(out, first.drawn)};
    out = hn::And(out, first.drawn);
    const Mask all = hn::Eq(one, one);
    Mask specular = coat.smooth ? all : hn::Not(all);
    const U32 own = HashBits(hn::Xor(seed, SetU(0xB5297A4Du)));
    for (uint32_t event = 0; event < layer.max_events; ++event) {
      if (hn::AllFalse(D(), walk.alive)) break;
      const uint32_t number = event * kNumbersPerEvent;
      if (event > 3) Roulette(own, number, walk);
      const Mask scattered = Advance(own, number, walk);
      if (layer.scatters) {
        const PhaseDraw phase = ScatterIn(own, number, scattered, walk);
        walk.w = IfThenElse(scattered, phase.wi, walk.w);
        specular = AndNot(scattered, specular);
      }
      const Mask up = hn::Gt(walk.w.z, hn::Zero(D()));
      const Mask at_coat = hn::And(AndNot(scattered, walk.alive), up);
      const Mask at_ground = AndNot(up, AndNot(scattered, walk.alive));
      const Vec3 back = Neg(walk.w);
      if (!hn::AllFalse(D(), at_ground)) {
        BounceOffGround(own, number, at_ground, walk);
        specular = Connects() ? AndNot(at_ground, specular) : hn::Or(at_ground, specular);
      }
      if (!hn::AllFalse(D(), at_coat)) {
        Mask inward;
        const CoatDraw draw = coat.Scatter(back, Number(own, number + 4), Number(own, number + 5),
                                           Number(own, number + 6), &inward);
        walk.Turn(at_coat, draw.wi, {draw.weight, draw.weight, draw.weight});
        walk.alive = AndNot(AndNot(draw.drawn, at_coat), walk.alive);
        const Mask leaves = AndNot(inward, hn::And(at_coat, walk.alive));
        out = hn::Or(out, leaves);
        walk.alive = AndNot(leaves, walk.alive);
      }
    }
    // Lanes that are out kept their direction and weight.
    const F32 pdf = hn::IfThenElse(specular, Set(kSpecularPdf), Proxy(wo, walk.w));
    const Vec3 wi = IfThenElse(below, Neg(walk.w), walk.w);
    return ScatterIf(hn::And(out, HasSide(wo)), {wi, walk.weight, pdf, one});
  }

 private:
  static constexpr uint32_t kNumbersPerEvent = 8;

  // Whether Evaluate finds what comes from the ground. It finds all that is scattered inside.
  HWY_INLINE bool Connects() const { return !coat.smooth || !ground.specular; }

  struct Walk {
    Vec3 w;
    Rgb weight;
    F32 z;  // height above the ground
    Mask alive;

    HWY_INLINE void Turn(Mask lanes, const Vec3& to, const Rgb& factor) {
      w = IfThenElse(lanes, to, w);
      weight = IfThenElse(lanes, Mul(weight, factor), weight);
    }
  };

  // Numbers have fixed places, so that none depends on what other lanes do.
  HWY_INLINE uint32_t NumbersPerWalk() const { return (layer.max_events + 1) * kNumbersPerEvent; }
  static HWY_INLINE F32 Number(U32 seed, uint32_t place) { return HashUniform(seed, SetU(place)); }

  HWY_INLINE void Roulette(U32 seed, uint32_t number, Walk& walk) const {
    const F32 largest = MaxComponent(walk.weight);
    const Mask gamble = hn::And(walk.alive, hn::Lt(largest, Set(0.25f)));
    const Mask dies = hn::And(gamble, hn::Ge(Number(seed, number), largest));
    const F32 scale = hn::IfThenElse(gamble, hn::Div(Set(1.0f), largest), Set(1.0f));
    walk.alive = AndNot(dies, walk.alive);
    walk.weight = Scale(scale, walk.weight);
  }

  // To the next place of a walk; returns the lanes that are scattered before they reach a side.
  HWY_INLINE Mask Advance(U32 seed, uint32_t number, Walk& walk) const {
    const F32 zero = hn::Zero(D());
    if (!layer.scatters) {
      const F32 share = layer.Transmittance(layer.thickness, walk.w.z);
      walk.weight = IfThenElse(walk.alive, Scale(share, walk.weight), walk.weight);
      return hn::Lt(zero, zero);
    }
    const F32 u = Number(seed, number + 1);
    const F32 step = hn::Neg(hn::Log(D(), hn::Sub(Set(1.0f), u)));
    const F32 z = hn::MulAdd(step, walk.w.z, walk.z);
    const Mask inside = hn::And(hn::Gt(z, zero), hn::Lt(z, layer.thickness));
    walk.z = hn::Min(hn::Max(z, zero), layer.thickness);  // unused in lanes that ended
    return hn::And(inside, walk.alive);
  }

  // Draws where the lanes `scattered` go, and attenuates them; does not turn them yet.
  HWY_INLINE PhaseDraw ScatterIn(U32 seed, uint32_t number, Mask scattered, Walk& walk) const {
    const PhaseDraw phase =
        SamplePhase(layer.g, walk.w, Number(seed, number + 2), Number(seed, number + 3));
    walk.weight = IfThenElse(scattered, Mul(walk.weight, layer.albedo), walk.weight);
    return phase;
  }

  // Returns the density of what the ground drew.
  HWY_INLINE F32 BounceOffGround(U32 seed, uint32_t number, Mask lanes, Walk& walk) const {
    const BsdfSample s = ground.Sample(Neg(walk.w), Number(seed, number + 4),
                                       Number(seed, number + 5), Number(seed, number + 6));
    walk.Turn(lanes, s.wi, s.weight);
    const Mask lost = hn::Or(hn::Eq(s.pdf, hn::Zero(D())), hn::Le(s.wi.z, hn::Zero(D())));
    walk.alive = AndNot(hn::And(lanes, lost), walk.alive);
    return s.pdf;
  }

  static HWY_INLINE Rgb AddWhere(Mask lanes, const Rgb& more, const Rgb& sum) {
    return Add(sum, IfThenElseZero(lanes, more));
  }

  // One walk's estimate of f, without the cosine of wi and the outer reflection.
  HWY_INLINE Rgb Connect(const Vec3& wo, const Vec3& wi, Mask lanes, U32 seed,
                         uint32_t first_number) const {
    const F32 zero = hn::Zero(D());
    const CoatDraw in = coat.Cross(wo, Number(seed, first_number), Number(seed, first_number + 1));
    const CoatDraw light =
        coat.Cross(wi, Number(seed, first_number + 2), Number(seed, first_number + 3));
    const F32 entering = hn::Div(in.weight, hn::Mul(coat.eta, coat.eta));
    Walk walk = {in.wi,
                 {entering, entering, entering},
                 layer.thickness,
                 hn::And(lanes, hn::And(in.drawn, light.drawn))};
    const F32 light_f = hn::Div(light.weight, hn::Neg(light.wi.z));  // without its cosine
    Rgb sum = {zero, zero, zero};
    for (uint32_t event = 0; event < layer.max_events; ++event) {
      if (hn::AllFalse(D(), walk.alive)) break;
      const uint32_t number = first_number + (event + 1) * kNumbersPerEvent;
      if (event > 3) Roulette(seed, number, walk);
      const Mask scattered = Advance(seed, number, walk);
      if (layer.scatters && !hn::AllFalse(D(), scattered)) {
        sum = ConnectInside(wi, light, light_f, seed, number, scattered, walk, sum);
      }
      const Mask up = hn::Gt(walk.w.z, zero);
      const Mask arrived = AndNot(scattered, walk.alive);
      const Mask at_ground = AndNot(up, arrived), at_coat = hn::And(up, arrived);
      if (!hn::AllFalse(D(), at_coat)) {
        const CoatDraw draw =
            coat.Reflect(Neg(walk.w), Number(seed, number + 4), Number(seed, number + 5));
        walk.Turn(at_coat, draw.wi, {draw.weight, draw.weight, draw.weight});
        walk.alive = AndNot(AndNot(draw.drawn, at_coat), walk.alive);
      }
      if (!hn::AllFalse(D(), at_ground)) {
        sum = ConnectGround(wi, light, light_f, seed, number, at_ground, walk, sum);
      }
    }
    return sum;
  }

  // Adds what the ground sends to wi, both ways, and goes on from there.
  HWY_INLINE Rgb ConnectGround(const Vec3& wi, const CoatDraw& light, F32 light_f, U32 seed,
                               uint32_t number, Mask lanes, Walk& walk, Rgb sum) const {
    if (!ground.specular) {
      const BsdfValue value = ground.Evaluate(Neg(walk.w), Neg(light.wi));
      const F32 weight = coat.smooth ? Set(1.0f) : PowerHeuristic(light.pdf, value.pdf);
      const F32 rest = hn::Mul(layer.Transmittance(layer.thickness, light.wi.z), light_f);
      sum = AddWhere(lanes, Scale(hn::Mul(weight, rest), Mul(walk.weight, value.value)), sum);
    }
    const F32 pdf = BounceOffGround(seed, number, lanes, walk);
    if (coat.smooth) return sum;
    const Mask going = hn::And(lanes, walk.alive);
    return ConnectOut(wi, pdf, layer.thickness, going, walk, sum);
  }

  // Adds what a walk brings to wi if it leaves through the coat's facets next; `pdf` is the density
  // of its direction, infinite if it had no choice.
  HWY_INLINE Rgb ConnectOut(const Vec3& wi, F32 pdf, F32 height, Mask lanes, const Walk& walk,
                            const Rgb& sum) const {
    const CoatValue exit = coat.EvaluateOut(Neg(walk.w), wi);
    const F32 weight = PowerHeuristic(pdf, exit.pdf);
    const F32 rest = hn::Mul(layer.Transmittance(height, walk.w.z), exit.f);
    const Mask counts = hn::And(lanes, hn::Gt(exit.f, hn::Zero(D())));
    return AddWhere(counts, Scale(hn::Mul(weight, rest), walk.weight), sum);
  }

  // Adds what the lanes scattered inside of the layer send to wi, both ways, and turns them.
  HWY_INLINE Rgb ConnectInside(const Vec3& wi, const CoatDraw& light, F32 light_f, U32 seed,
                               uint32_t number, Mask scattered, Walk& walk, Rgb sum) const {
    const F32 depth = hn::Sub(layer.thickness, walk.z);
    const F32 value = EvaluatePhase(layer.g, hn::Neg(Dot(walk.w, light.wi)));
    const F32 weight = coat.smooth ? Set(1.0f) : PowerHeuristic(light.pdf, value);
    const F32 rest = hn::Mul(layer.Transmittance(depth, light.wi.z), light_f);
    const PhaseDraw phase = ScatterIn(seed, number, scattered, walk);
    sum = AddWhere(scattered, Scale(hn::Mul(hn::Mul(weight, value), rest), walk.weight), sum);
    walk.w = IfThenElse(scattered, phase.wi, walk.w);
    if (coat.smooth) return sum;
    const Mask going = hn::And(scattered, hn::Gt(walk.w.z, hn::Zero(D())));
    return ConnectOut(wi, phase.pdf, depth, going, walk, sum);
  }

  // A density like that of Sample where it is none of mass: gloss, then the ground seen through a
  // flat coat, and some of everything. Both directions above.
  HWY_INLINE F32 Proxy(const Vec3& wo, const Vec3& wi) const {
    constexpr float kUniformShare = 0.1f, kInvTwoPiF = 0.159154943f;
    F32 body = ground.Proxy(coat, wo, wi);
    if (layer.scatters) {
      body = hn::Mul(Set(0.5f), hn::MulAdd(Set(kInvPi), wi.z, body));
    }
    const F32 pdf = hn::MulAdd(coat.FlatCrossing(wo.z), body, coat.EvaluateGloss(wo, wi).pdf);
    return hn::MulAdd(Set(1.0f - kUniformShare), pdf, Set(kUniformShare * kInvTwoPiF));
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LAYERED_INL_H_
