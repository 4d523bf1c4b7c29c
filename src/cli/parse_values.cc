// Strict readers of option values: the whole text must be the value.
#include "src/cli/parse_values.h"

#include <charconv>
#include <string_view>

#include "src/base/suggest.h"

namespace swell {
namespace {

template <class T> bool ReadAll(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

Result<uint32_t> ParseCount(const std::string& text, uint32_t min, uint32_t max) {
  uint64_t value = 0;
  if (ReadAll(text, value) && value >= min && value <= max) return static_cast<uint32_t>(value);
  return Error{"'" + text + "' is not a whole number from " + std::to_string(min) + " to " +
               std::to_string(max)};
}

Result<std::array<uint32_t, 2>> ParseResolution(const std::string& text) {
  const size_t x = text.find('x');
  if (x != std::string::npos) {
    const Result<uint32_t> width = ParseCount(text.substr(0, x), 1, 65535);
    const Result<uint32_t> height = ParseCount(text.substr(x + 1), 1, 65535);
    if (width && height) return std::array<uint32_t, 2>{*width, *height};
  }
  return Error{"'" + text + "' is not WIDTHxHEIGHT with both from 1 to 65535, such as 1280x720"};
}

Result<std::array<float, 4>> ParseCropWindow(const std::string& text) {
  std::array<float, 4> window{};
  std::string_view rest = text;
  bool good = true;
  for (size_t i = 0; i < 4 && good; ++i) {
    const size_t end = i < 3 ? rest.find(',') : rest.size();
    good = end != std::string_view::npos && ReadAll(rest.substr(0, end), window[i]);
    if (good && i < 3) rest.remove_prefix(end + 1);
  }
  if (!good) return Error{"'" + text + "' is not x0,x1,y0,y1, such as 0,0.5,0,1"};
  for (float edge : window) {
    if (!(edge >= 0 && edge <= 1)) {
      return Error{"'" + text + "' leaves the frame; x0,x1,y0,y1 are fractions from 0 to 1"};
    }
  }
  if (!(window[0] < window[1] && window[2] < window[3])) {
    return Error{"'" + text + "' is empty; the order is x0,x1,y0,y1 with x0 < x1 and y0 < y1"};
  }
  return window;
}

Result<uint32_t> ParseName(const std::string& what, const std::string& text,
                           const std::vector<std::string>& names) {
  for (uint32_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return i;
  }
  std::string close = DidYouMean(text, {names.begin(), names.end()});
  if (close.empty()) close = "; use " + OneOf(names);
  return Error{"unknown " + what + " '" + text + "'" + close};
}

std::string OneOf(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace swell
