// The transparent media that scene files can name, as one index of refraction each.
#ifndef SWELL_KERNELS_TRANSPARENT_MEDIA_H_
#define SWELL_KERNELS_TRANSPARENT_MEDIA_H_

#include "kernels/material.h"

namespace swell {

// Without dispersion. Glasses: mean over D65 and the eye's sensitivity of the curves in Schott's
// catalogue of 2017 (scripts/metal_colours.py); pbrt-v4 calls SF5, SF10 and SF11 F5, F10 and F11.
// The others at 587.6 nm, air at 0 C.
inline constexpr NamedValue kTransparentMedia[] = {
    {"vacuum", {1.0f}},          {"air", {1.00029f}},         {"ice", {1.31f}},
    {"water", {1.333f}},         {"crown-glass", {1.52f}},    {"diamond", {2.417f}},
    {"glass-BK7", {1.5184f}},    {"glass-BAF10", {1.67287f}}, {"glass-FK51A", {1.48771f}},
    {"glass-LASF9", {1.85557f}}, {"glass-F5", {1.6769f}},     {"glass-F10", {1.73341f}},
    {"glass-F11", {1.79087f}},   {"glass-SF5", {1.6769f}},    {"glass-SF10", {1.73341f}},
    {"glass-SF11", {1.79087f}},
};

}  // namespace swell

#endif  // SWELL_KERNELS_TRANSPARENT_MEDIA_H_
