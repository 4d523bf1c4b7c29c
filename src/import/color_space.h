// The colour spaces that pbrt-v4 names -> the maps from their numbers to linear sRGB, which
// everything here is computed in.
#ifndef SWELL_IMPORT_COLOR_SPACE_H_
#define SWELL_IMPORT_COLOR_SPACE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace swell {

enum class ColorSpaceName : uint32_t { kSrgb, kDciP3, kRec2020, kAces2065 };

// In the order of the enumeration.
inline const std::vector<std::string_view> kColorSpaceNames = {"srgb", "dci-p3", "rec2020",
                                                               "aces2065-1"};

// What (1, 1, 1) means: for a light the white of the space, for a weight of light no change at all.
enum class ColorUse : uint32_t { kLight, kWeight };

// Linear numbers of the space in, linear sRGB out. Colours outside of sRGB are moved to its edge.
std::array<float, 3> ToSrgb(ColorSpaceName space, ColorUse use, const std::array<float, 3>& color);

}  // namespace swell

#endif  // SWELL_IMPORT_COLOR_SPACE_H_
