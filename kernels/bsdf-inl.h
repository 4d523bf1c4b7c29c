// What a material gives to the loop that all materials share. Directions are local: z is the
// shading normal on the surface's outer side, wo points away from the surface, to where the path
// came from.
#if defined(SWELL_KERNELS_BSDF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_BSDF_INL_H_
#undef SWELL_KERNELS_BSDF_INL_H_
#else
#define SWELL_KERNELS_BSDF_INL_H_
#endif

#include <limits>
#include <type_traits>

#include "kernels/lanes-inl.h"
#include "kernels/material.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The density of a direction that has a probability of its own. Multiple importance sampling then
// leaves such a sample its full weight.
inline constexpr float kSpecularPdf = std::numeric_limits<float>::infinity();

// f(wo, wi) * |cos(wi)| and the solid-angle density with which Sample draws wi. Both 0 for
// directions that Sample never draws. A specular material returns zeros.
struct BsdfValue {
  Rgb value;
  F32 pdf;
};

// A drawn direction. weight = f * |cos| / pdf; 0 where nothing is scattered (then pdf is 0 too).
struct BsdfSample {
  Vec3 wi;
  Rgb weight;
  F32 pdf;        // kSpecularPdf if wi has a probability mass, which is divided out of weight
  F32 eta_scale;  // squared relative index of refraction if wi crosses the surface, else 1
};

// A word of a material's parameters: the same for all rows, or a column where a texture varies it.
// As a number it is the constant, which of a textured word is only typical.
struct ParamWord {
  float constant;
  const float* column;  // at the first of a vector's rows; null: none
  HWY_INLINE operator float() const { return constant; }
};
HWY_INLINE F32 Set(const ParamWord& word) {
  return word.column == nullptr ? Set(word.constant) : Load(word.column, 0);
}

// The parameters of one vector of rows, from some word on.
class Params {
 public:
  explicit Params(const float* words) : words_(words) {}
  Params(const float* words, const float* const* columns, size_t row)
      : words_(words), columns_(columns), row_(row) {}

  // Templates, so that no conversion to a pointer competes.
  template <class I> HWY_INLINE ParamWord operator[](I i) const {
    const float* column = columns_ == nullptr ? nullptr : columns_[i];
    return {words_[i], column == nullptr ? nullptr : column + row_};
  }
  template <class I> HWY_INLINE Params operator+(I words) const {
    return Params(words_ + words, columns_ == nullptr ? nullptr : columns_ + words, row_);
  }
  HWY_INLINE operator const float*() const { return words_; }

 private:
  const float* words_;
  const float* const* columns_ = nullptr;
  size_t row_ = 0;
};
HWY_INLINE Rgb BroadcastRgb(const Params& params) {
  return {Set(params[0]), Set(params[1]), Set(params[2])};
}

// Whether textures can vary a material: whether it is made of Params, not only of constants.
struct OnlyParams {
  operator const Params&() const;
};
template <class M>
inline constexpr bool kTakesColumns =
    std::is_constructible_v<M, const OnlyParams&, const PathSettings&>;

// A material is a class with
//   M(const Params& params, const PathSettings& settings);
//   static bool IsSpecular(const float* params);   // of the constants
//   BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const;
//   BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2) const;   // three numbers in [0, 1)
// All lanes are computed; what lies in unused lanes does not matter. One that looks different along
// u and v also has
//   static bool NeedsTangent(const float* params);   // whether x must be the direction of u
// and, if its parameters hold directions, may have
//   Frame Turn(const Frame& frame, F32 side, const Frame& smooth);
// which gets that frame, the sign of its y axis along v, and the frame of the normal without
// relief; it may turn the first about its z axis, and then its local directions are of what it
// returns. One that estimates its values by random walks takes a U32 as a last argument of Evaluate
// and Sample, the seed of numbers by HashUniform. Then the pdf may be any function of wo and wi
// that resembles the density of Sample, as it only weighs Evaluate against Sample. One that
// scatters light only to the side of wo, so that Evaluate and Sample are void elsewhere, may say
//   static constexpr bool kOpaque = true;   // or, if its parameters decide,
//   static bool IsOpaque(const Params& params);
// and the light tree then leaves out the lights behind it.

template <class M>
inline constexpr bool kIsEstimate = requires(const M& m, const Vec3& w, U32 seed) {
  m.Evaluate(w, w, seed);
};
template <class M> HWY_INLINE bool IsOpaque(const Params& params) {
  if constexpr (requires { M::IsOpaque(params); }) {
    return M::IsOpaque(params);
  } else {
    return requires { requires M::kOpaque; };
  }
}
template <class M> HWY_INLINE bool NeedsTangent(const float* params) {
  if constexpr (requires { M::NeedsTangent(params); }) {
    return M::NeedsTangent(params);
  } else {
    return false;
  }
}
template <class M>
HWY_INLINE BsdfValue EvaluateBsdf(const M& material, const Vec3& wo, const Vec3& wi, U32 seed) {
  if constexpr (kIsEstimate<M>) {
    return material.Evaluate(wo, wi, seed);
  } else {
    return material.Evaluate(wo, wi);
  }
}
template <class M>
HWY_INLINE BsdfSample SampleBsdf(const M& material, const Vec3& wo, F32 u0, F32 u1, F32 u2,
                                 U32 seed) {
  if constexpr (kIsEstimate<M>) {
    return material.Sample(wo, u0, u1, u2, seed);
  } else {
    return material.Sample(wo, u0, u1, u2);
  }
}

HWY_INLINE F32 CosTheta(const Vec3& w) { return w.z; }
HWY_INLINE F32 AbsCosTheta(const Vec3& w) { return hn::Abs(w.z); }
HWY_INLINE Mask SameHemisphere(const Vec3& a, const Vec3& b) {
  return hn::Gt(hn::Mul(a.z, b.z), hn::Zero(D()));
}

// The sample where `scattered`; elsewhere nothing, in a direction that is finite.
HWY_INLINE BsdfSample ScatterIf(Mask scattered, const BsdfSample& sample) {
  const Vec3 up = {hn::Zero(D()), hn::Zero(D()), Set(1.0f)};
  return {IfThenElse(scattered, sample.wi, up), IfThenElseZero(scattered, sample.weight),
          hn::IfThenElseZero(scattered, sample.pdf),
          hn::IfThenElse(scattered, sample.eta_scale, Set(1.0f))};
}
// False where wo lies in the surface or is not a number.
HWY_INLINE Mask HasSide(const Vec3& wo) { return hn::Gt(hn::Abs(wo.z), hn::Zero(D())); }
HWY_INLINE Vec3 MirrorDirection(const Vec3& wo) { return {hn::Neg(wo.x), hn::Neg(wo.y), wo.z}; }

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_BSDF_INL_H_
