// The tokenizer of pbrt's scene description language.
#include "src/import/tokens.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace swell {
namespace {

bool IsSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool EndsWord(char c) { return IsSpace(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

bool LooksLikeNumber(std::string_view text) {
  const char first = text.front();
  return (first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.';
}

bool SameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a == b || std::filesystem::equivalent(a, b, ignored);
}

// The character that backslash and `c` stand for; 0: none.
char Unescape(char c) {
  switch (c) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
    case '\'':
    case '"':
      return c;
    default:
      return 0;
  }
}

}  // namespace

std::string TooManyFiles() {
  return "more than " + std::to_string(kMaxIncludedFiles) + " files are included";
}

ImportChain TokenStream::Chain() const {
  ImportChain chain = around_;
  for (const OpenFile& file : stack_) chain.files.push_back(*file.place.file);
  return chain;
}

void TokenStream::Close() {
  peeked_.reset();
  stack_.clear();
  files_.clear();
  unescaped_.clear();
}

bool TokenStream::MayOpen(const std::string& path, Place from) {
  const std::vector<std::string> files = Chain().files;
  for (size_t i = 0; i < files.size(); ++i) {
    if (!SameFile(files[i], path)) continue;
    std::string chain;
    for (size_t j = i; j < files.size(); ++j) chain += files[j] + " -> ";
    diagnostics_->Fail(from, "a file includes itself: " + chain + path);
    return false;
  }
  if (files.size() >= kMaxIncludeDepth) {
    diagnostics_->Fail(
        from, "files are included more than " + std::to_string(kMaxIncludeDepth) + " deep");
    return false;
  }
  if (++(around_.opened == nullptr ? opened_ : *around_.opened) > kMaxIncludedFiles) {
    diagnostics_->Fail(from, TooManyFiles());
    return false;
  }
  return true;
}

void TokenStream::Open(const std::string& path, Place from) {
  if (!MayOpen(path, from)) return;
  Result<FileBytes> file = FileBytes::Read(path);
  const Place place{diagnostics_->AddFile(path), 0};
  if (!file) {
    const bool main_file = from.file == nullptr;
    diagnostics_->Fail(main_file ? place : from,
                       (main_file ? "" : Quote(path) + " ") + file.error().message);
    return;
  }
  std::string_view text = file->bytes();
  if (text.substr(0, 2) == "\xFE\xFF" || text.substr(0, 2) == "\xFF\xFE") {
    diagnostics_->Fail(place, "is UTF-16 text; save it as UTF-8");
    return;
  }
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  files_.push_back(std::move(*file));
  stack_.push_back({{place.file, 1}, text});
  stack_.back().meter = MeteredRead(text.size());
}

Token TokenStream::Next() {
  if (peeked_) {
    const Token token = *peeked_;
    peeked_.reset();
    return token;
  }
  return Read();
}

const Token& TokenStream::Peek() {
  if (!peeked_) peeked_ = Read();
  return *peeked_;
}

void TokenStream::SkipSpace(OpenFile& file) {
  size_t i = 0;
  for (; i < file.rest.size(); ++i) {
    const char c = file.rest[i];
    if (c == '\n') {
      ++file.place.line;
    } else if (c == '#') {
      const size_t end = file.rest.find('\n', i);
      if (end == std::string_view::npos) {
        i = file.rest.size();
        break;
      }
      i = end - 1;
    } else if (!IsSpace(c)) {
      break;
    }
  }
  file.rest.remove_prefix(i);
}

Token TokenStream::Read() {
  while (!stack_.empty() && !diagnostics_->failed()) {
    OpenFile& file = stack_.back();
    SkipSpace(file);
    file.meter.Left(file.rest.size());
    if (file.rest.empty()) {
      stack_.pop_back();
      continue;
    }
    const char first = file.rest.front();
    if (first == '"') return ReadString(file);
    size_t length = 1;
    TokenKind kind = TokenKind::kOpen;
    if (first == ']') {
      kind = TokenKind::kClose;
    } else if (first != '[') {
      while (length < file.rest.size() && !EndsWord(file.rest[length])) ++length;
      kind = LooksLikeNumber(file.rest.substr(0, length)) ? TokenKind::kNumber : TokenKind::kWord;
    }
    const Token token{kind, file.rest.substr(0, length), file.place};
    file.rest.remove_prefix(length);
    return token;
  }
  return {};
}

Token TokenStream::ReadString(OpenFile& file) {
  const Place place = file.place;
  std::string* unescaped = nullptr;
  for (size_t i = 1; i < file.rest.size() && file.rest[i] != '\n'; ++i) {
    if (file.rest[i] == '"') {
      const std::string_view text = unescaped ? *unescaped : file.rest.substr(1, i - 1);
      file.rest.remove_prefix(i + 1);
      return {TokenKind::kString, text, place};
    }
    if (file.rest[i] == '\\' && i + 1 < file.rest.size()) {
      if (unescaped == nullptr) {
        unescaped = &unescaped_.emplace_back(file.rest.substr(1, i - 1));
      }
      const char c = Unescape(file.rest[++i]);
      if (c == 0) {
        diagnostics_->Fail(place, "unknown escape '\\" + Quote(file.rest.substr(i, 1)).substr(1) +
                                      " in a string; write \\\\ for a backslash");
        return {};
      }
      unescaped->push_back(c);
    } else if (unescaped != nullptr) {
      unescaped->push_back(file.rest[i]);
    }
  }
  diagnostics_->Fail(place, "a string starts here and has no closing quote on its line");
  return {};
}

double ParseDouble(const Token& token, Diagnostics* diagnostics) {
  std::string_view text = token.text;
  if (token.kind != TokenKind::kNumber) {
    diagnostics->Fail(token.place, token.kind == TokenKind::kEnd
                                       ? "a number is missing at the end of the file"
                                       : "a number is expected, not " + Quote(text));
    return 0.0;
  }
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  if (status == std::errc::result_out_of_range && whole) {
    value = std::strtod(std::string(text).c_str(), nullptr);  // 0 for an underflow, else infinite
  } else if (status != std::errc() || !whole) {
    diagnostics->Fail(token.place, Quote(token.text) + " is not a number");
    return 0.0;
  }
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    diagnostics->Fail(token.place, Quote(token.text) + " is not a finite 32-bit number");
    return 0.0;
  }
  return value;
}

float ParseFloat(const Token& token, Diagnostics* diagnostics) {
  return static_cast<float>(ParseDouble(token, diagnostics));
}

int32_t ParseInteger(const Token& token, Diagnostics* diagnostics) {
  std::string_view text = token.text;
  if (token.kind == TokenKind::kNumber && text.front() == '+') text.remove_prefix(1);
  int32_t value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (token.kind != TokenKind::kNumber || end != text.data() + text.size() ||
      status == std::errc::invalid_argument) {
    diagnostics->Fail(token.place, "a whole number is expected, not " + Quote(token.text));
  } else if (status == std::errc::result_out_of_range) {
    diagnostics->Fail(token.place, Quote(token.text) + " does not fit 32 bits");
  }
  return value;
}

}  // namespace swell
