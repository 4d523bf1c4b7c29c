// URIs of glTF files -> bytes of data URIs, or paths of files.
#include "src/import/gltf_uri.h"

#include <filesystem>

#include "src/import/diagnostics.h"

namespace swell {
namespace {

// 0 to 63, or -1.
int Base64Value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

int HexValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// "%20" -> " ".
std::string WithoutPercents(std::string_view text) {
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size() && HexValue(text[i + 1]) >= 0 &&
                       HexValue(text[i + 2]) >= 0;
    if (!coded) {
      plain += text[i];
      continue;
    }
    plain += static_cast<char>(16 * HexValue(text[i + 1]) + HexValue(text[i + 2]));
    i += 2;
  }
  return plain;
}

Result<std::string> DecodeBase64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    const int value = Base64Value(c);
    if (value < 0) return Error{"a data URI holds " + Quote({&c, 1}) + ", which is not base64"};
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

}  // namespace

bool IsDataUri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

Result<std::string> DecodeDataUri(std::string_view uri) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return Error{"a data URI has no ','"};
  const std::string_view head = uri.substr(0, comma), body = uri.substr(comma + 1);
  if (head.size() >= 7 && head.substr(head.size() - 7) == ";base64") return DecodeBase64(body);
  return WithoutPercents(body);
}

Result<std::string> FileOfUri(const std::string& uri, const std::string& from) {
  std::string_view rest = uri;
  if (rest.substr(0, 7) == "file://") {
    rest.remove_prefix(7);
  } else if (rest.find("://") != std::string_view::npos) {
    return Error{Quote(uri) + " is not a file; download it and name its path"};
  }
  const std::string name = WithoutPercents(rest);
  if (name.empty() || name.find('\0') != std::string::npos) {
    return Error{Quote(uri) + " names no file"};
  }
  const std::filesystem::path path(name);
  if (path.is_absolute()) return path.string();
  return (std::filesystem::path(from).parent_path() / path).string();
}

}  // namespace swell
