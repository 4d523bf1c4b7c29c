// Colours of scene files (rgb, spectrum, blackbody) -> linear sRGB.
#ifndef SWELL_IMPORT_SPECTRUM_H_
#define SWELL_IMPORT_SPECTRUM_H_

#include <array>
#include <string_view>

#include "src/import/parameters.h"

namespace swell {

using Rgb3 = std::array<float, 3>;

// A light's colour, before its "scale". As in pbrt-v4, "rgb" counts as it stands, and any other
// spectrum is scaled to the luminance of white (1, 1, 1).
Rgb3 ReadLightColor(Parameters& parameters, std::string_view name);

// A reflectance or another weight of light, from a parameter of type rgb or spectrum: a spectrum
// becomes its mean over each channel's sensitivity, so that a constant c becomes (c, c, c).
Rgb3 ReadWeightColor(Parameters& parameters, Parameter& parameter);

// Chromaticity of a black body at luminance 1, linear sRGB.
Rgb3 BlackbodyColor(double kelvin);

}  // namespace swell

#endif  // SWELL_IMPORT_SPECTRUM_H_
