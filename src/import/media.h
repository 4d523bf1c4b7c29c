// Parameters of MakeNamedMedium -> what a medium absorbs.
#ifndef SWELL_IMPORT_MEDIA_H_
#define SWELL_IMPORT_MEDIA_H_

#include <array>

#include "src/import/parameters.h"

namespace swell {

// The absorption by channel, per unit of length. A medium that scatters, varies or glows has none,
// with a warning: it is left out of the picture.
std::array<float, 3> ReadMedium(Parameters& parameters);

}  // namespace swell

#endif  // SWELL_IMPORT_MEDIA_H_
