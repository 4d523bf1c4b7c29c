// Text of one option value to a checked value; an error says what would be right.
#ifndef SWELL_CLI_PARSE_VALUES_H_
#define SWELL_CLI_PARSE_VALUES_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/result.h"

namespace swell {

// A whole number in [min, max].
Result<uint32_t> ParseCount(const std::string& text, uint32_t min, uint32_t max);
// "1280x720", both in [1, 65535].
Result<std::array<uint32_t, 2>> ParseResolution(const std::string& text);
// "x0,x1,y0,y1" with 0 <= x0 < x1 <= 1, likewise y.
Result<std::array<float, 4>> ParseCropWindow(const std::string& text);
// The index of `text` in `names`. `what` is the noun of the error's text.
Result<uint32_t> ParseName(const std::string& what, const std::string& text,
                           const std::vector<std::string>& names);

// "a, b or c"
std::string OneOf(const std::vector<std::string>& names);

}  // namespace swell

#endif  // SWELL_CLI_PARSE_VALUES_H_
