// Texts in, parts or other spellings of them out.
#ifndef SWELL_BASE_TEXT_H_
#define SWELL_BASE_TEXT_H_

#include <cctype>
#include <string>

namespace swell {

// Messages of libraries may have several.
inline std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// Of ASCII letters.
inline char LowerCase(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}
inline std::string LowerCase(std::string text) {
  for (char& c : text) c = LowerCase(c);
  return text;
}

}  // namespace swell

#endif  // SWELL_BASE_TEXT_H_
