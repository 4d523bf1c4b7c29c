// Places, errors and warnings of the readers as lines of text.
#include "src/import/diagnostics.h"

namespace swell {
namespace {

constexpr size_t kMaxQuotedChars = 60;

// Names from files may hold any byte; a message stays one line of them.
std::string OneLine(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  return text;
}

}  // namespace

std::string ToString(Place place) {
  std::string text = place.file == nullptr ? "scene" : *place.file;
  if (place.line > 0) text.append(":").append(std::to_string(place.line));
  return text;
}

std::string Quote(std::string_view text) {
  std::string quoted("'");
  quoted += OneLine(std::string(text.substr(0, kMaxQuotedChars)));
  if (text.size() > kMaxQuotedChars) quoted += "...";
  quoted += '\'';
  return quoted;
}

const std::string* Diagnostics::AddFile(const std::string& path) {
  return &files_.emplace_back(path);
}

void Diagnostics::Fail(Place place, std::string_view what) {
  if (!error_) error_ = Error{OneLine(ToString(place) + ": " + std::string(what))};
}

void Diagnostics::Warn(Place place, std::string_view what) {
  const auto found = first_by_text_.find(what);
  if (found != first_by_text_.end()) {
    ++warnings_[found->second].repeats;
    return;
  }
  first_by_text_.emplace(what, warnings_.size());
  warnings_.push_back({OneLine(ToString(place) + ": " + std::string(what)), std::string(what)});
}

void Diagnostics::Take(const Diagnostics& other) {
  for (const Warning& warning : other.warnings_) {
    const auto [at, is_new] = first_by_text_.try_emplace(warning.what, warnings_.size());
    if (is_new) {
      warnings_.push_back(warning);
    } else {
      warnings_[at->second].repeats += warning.repeats + 1;
    }
  }
  if (other.error_) error_ = other.error_;
}

std::vector<std::string> Diagnostics::TakeWarnings() {
  std::vector<std::string> lines;
  for (Warning& warning : warnings_) {
    if (warning.repeats > 0) {
      warning.text += " (and " + std::to_string(warning.repeats) + " more like it)";
    }
    lines.push_back(std::move(warning.text));
  }
  warnings_.clear();
  first_by_text_.clear();
  return lines;
}

}  // namespace swell
