// Strict readers of option values: the whole text must be the value.
#include "src/cli/parse_values.h"

#include <algorithm>
#include <charconv>

namespace swell {
namespace {

template <class T> bool ReadAll(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// Levenshtein's distance: insertions, removals, replacements.
size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
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
  std::string close = DidYouMean(text, names);
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

std::string DidYouMean(std::string_view text, const std::vector<std::string>& names) {
  // A third of the letters may be wrong: more than that is another word.
  size_t best = std::max<size_t>(text.size() / 3, 1) + 1;
  const std::string* closest = nullptr;
  for (const std::string& name : names) {
    const size_t distance = EditDistance(text, name);
    if (distance >= best || distance >= name.size()) continue;
    best = distance;
    closest = &name;
  }
  return closest == nullptr ? "" : "; did you mean '" + *closest + "'?";
}

}  // namespace swell
