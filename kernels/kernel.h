// How a kernel is declared: once, for two widths of the same source.
#ifndef SWELL_KERNELS_KERNEL_H_
#define SWELL_KERNELS_KERNEL_H_

#include <utility>

namespace swell {

// kWide uses all lanes of the chosen instruction set; kOneLane is the same arithmetic, one row at a
// time, to the same bits (--engine megakernel).
enum class Width { kWide, kOneLane };

// The two compilations of one kernel; called like the kernel with the width in front.
template <class F> struct KernelPair;
template <class R, class... A> struct KernelPair<R(A...)> {
  R (*wide)(A...);
  R (*one_lane)(A...);

  R operator()(Width width, A... args) const {
    return (width == Width::kWide ? wide : one_lane)(std::forward<A>(args)...);
  }
};

}  // namespace swell

// Declares swell::wide::Name, swell::one_lane::Name and swell::Name, the pair.
#define SWELL_KERNEL(Return, Name, ...) \
  namespace wide {                      \
  Return Name(__VA_ARGS__);             \
  }                                     \
  namespace one_lane {                  \
  Return Name(__VA_ARGS__);             \
  }                                     \
  inline constexpr KernelPair<decltype(wide::Name)> Name { &wide::Name, &one_lane::Name }

#endif  // SWELL_KERNELS_KERNEL_H_
