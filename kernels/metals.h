// The metals that scene files can name, as real and imaginary parts of their index for linear sRGB.
#ifndef SWELL_KERNELS_METALS_H_
#define SWELL_KERNELS_METALS_H_

#include "kernels/material.h"

namespace swell {

// Each channel's Fresnel curve is nearest to the mean of the metal's under D65, as a colorimetric
// sensor weighs it. Made by scripts/metal_colours.py from tables of refractiveindex.info:
// Ag: Rakic et al. 1998 (Brendel-Bormann model); Al: Cheng et al. 2016; Au: McPeak et al. 2015;
// Cu: Hagemann et al. 1975; CuZn (70:30): Querry 1985; MgO: Stephens and Malitson 1952; TiO2
// (rutile, extraordinary ray): Devore 1951. Gold's red would reflect more than it receives.
inline constexpr float kAgEta[3] = {0.1602f, 0.1455f, 0.1359f};
inline constexpr float kAgK[3] = {3.9264f, 3.1775f, 2.3278f};
inline constexpr float kAlEta[3] = {0.8680f, 0.5753f, 0.3748f};
inline constexpr float kAlK[3] = {6.1480f, 5.2190f, 4.2129f};
inline constexpr float kAuEta[3] = {0.0741f, 0.3783f, 1.6179f};
inline constexpr float kAuK[3] = {41.8550f, 2.2681f, 1.7279f};
inline constexpr float kCuEta[3] = {0.1822f, 0.9686f, 1.2134f};
inline constexpr float kCuK[3] = {3.6127f, 2.6263f, 2.3593f};
inline constexpr float kCuZnEta[3] = {0.4672f, 0.5219f, 1.1266f};
inline constexpr float kCuZnK[3] = {4.2249f, 2.6720f, 1.8108f};
inline constexpr float kMgOEta[3] = {1.7337f, 1.7408f, 1.7534f};
inline constexpr float kMgOK[3] = {0.0125f, 0.0124f, 0.0126f};
inline constexpr float kTiO2Eta[3] = {2.8598f, 2.9568f, 3.1855f};
inline constexpr float kTiO2K[3] = {0.0303f, 0.0263f, 0.0328f};

constexpr NamedValue NamedRgb(const char* name, const float (&value)[3]) {
  return {name, {value[0], value[1], value[2]}};
}

inline constexpr NamedValue kMetalEta[] = {
    NamedRgb("metal-Ag-eta", kAgEta),
    NamedRgb("metal-Al-eta", kAlEta),
    NamedRgb("metal-Au-eta", kAuEta),
    NamedRgb("metal-Cu-eta", kCuEta),
    NamedRgb("metal-CuZn-eta", kCuZnEta),
    NamedRgb("metal-MgO-eta", kMgOEta),
    NamedRgb("metal-TiO2-eta", kTiO2Eta),
    NamedRgb("Ag", kAgEta),
    NamedRgb("Al", kAlEta),
    NamedRgb("Au", kAuEta),
    NamedRgb("Cu", kCuEta),
    NamedRgb("CuZn", kCuZnEta),
    NamedRgb("MgO", kMgOEta),
    NamedRgb("TiO2", kTiO2Eta),
};
inline constexpr NamedValue kMetalK[] = {
    NamedRgb("metal-Ag-k", kAgK),
    NamedRgb("metal-Al-k", kAlK),
    NamedRgb("metal-Au-k", kAuK),
    NamedRgb("metal-Cu-k", kCuK),
    NamedRgb("metal-CuZn-k", kCuZnK),
    NamedRgb("metal-MgO-k", kMgOK),
    NamedRgb("metal-TiO2-k", kTiO2K),
    NamedRgb("Ag", kAgK),
    NamedRgb("Al", kAlK),
    NamedRgb("Au", kAuK),
    NamedRgb("Cu", kCuK),
    NamedRgb("CuZn", kCuZnK),
    NamedRgb("MgO", kMgOK),
    NamedRgb("TiO2", kTiO2K),
};

}  // namespace swell

#endif  // SWELL_KERNELS_METALS_H_
