// Names that only files for pbrt-v3 have -> what to do about such a file.
#ifndef SWELL_IMPORT_PBRT_V3_H_
#define SWELL_IMPORT_PBRT_V3_H_

#include <string>
#include <string_view>

namespace swell {

// To be put behind an error about `name`; "" if it is no name of pbrt-v3.
std::string UpgradeHint(std::string_view name);

}  // namespace swell

#endif  // SWELL_IMPORT_PBRT_V3_H_
