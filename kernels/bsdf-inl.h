// What a material gives to the loop that all materials share. Directions are local: z is the
// shading normal on the surface's outer side, wo points away from the surface, to where the path
// came from.
#if defined(SWELL_KERNELS_BSDF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_BSDF_INL_H_
#undef SWELL_KERNELS_BSDF_INL_H_
#else
#define SWELL_KERNELS_BSDF_INL_H_
#endif

#include <type_traits>

#include "kernels/lanes-inl.h"
#include "kernels/material.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

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
  F32 pdf;        // specular: 1 (a probability mass was divided out of weight already)
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
// All lanes are computed; what lies in unused lanes does not matter.

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
