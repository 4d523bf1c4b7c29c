// Recognises byte order marks; UTF-16 of either order becomes UTF-8.
#include "src/import/text_file.h"

#include <cstdint>

namespace swell {
namespace {

constexpr uint32_t kReplacement = 0xFFFD;  // for halves of a pair that stand alone

void AppendUtf8(uint32_t code, std::string* text) {
  if (code < 0x80) {
    text->push_back(static_cast<char>(code));
    return;
  }
  const int tail = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr uint32_t kLead[] = {0, 0xC0, 0xE0, 0xF0};
  text->push_back(static_cast<char>(kLead[tail] | (code >> (6 * tail))));
  for (int i = tail - 1; i >= 0; --i) {
    text->push_back(static_cast<char>(0x80 | ((code >> (6 * i)) & 0x3F)));
  }
}

std::string FromUtf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](size_t i) {
    const auto first = static_cast<uint8_t>(bytes[i]), second = static_cast<uint8_t>(bytes[i + 1]);
    return static_cast<uint32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
    uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xE000) {
      const uint32_t next = i + 3 < bytes.size() ? unit(i + 2) : 0;
      const bool pair = code < 0xDC00 && next >= 0xDC00 && next < 0xE000;
      code = pair ? 0x10000 + ((code - 0xD800) << 10) + (next - 0xDC00) : kReplacement;
      if (pair) i += 2;
    }
    AppendUtf8(code, &text);
  }
  return text;
}

}  // namespace

Result<TextFile> TextFile::Open(const std::string& path) {
  Result<FileBytes> bytes = FileBytes::Map(path);
  if (!bytes) return bytes.error();
  TextFile file(std::move(*bytes));
  const std::string_view data = file.file_.bytes();
  if (data.substr(0, 3) == "\xEF\xBB\xBF") {
    file.skipped_ = 3;
  } else if (data.substr(0, 2) == "\xFE\xFF" || data.substr(0, 2) == "\xFF\xFE") {
    file.converted_ = FromUtf16(data.substr(2), data[0] == '\xFE');
  }
  return file;
}

}  // namespace swell
