// Lines, words and numbers of OBJ and MTL files.
#include "src/import/statements.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace swell {
namespace {

constexpr std::string_view kSpace = " \t\v\f";

}  // namespace

std::string_view Trim(std::string_view text) {
  const size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string_view TakeWord(std::string_view* text) {
  const size_t first = text->find_first_not_of(kSpace);
  if (first == std::string_view::npos || (*text)[first] == '#') {
    *text = {};
    return {};
  }
  const size_t end = std::min(text->find_first_of(kSpace, first), text->size());
  const std::string_view word = text->substr(first, end - first);
  text->remove_prefix(end);
  return word;
}

bool TakeNumber(std::string_view* word, double* value) {
  const char* first = word->data();
  const char* last = first + word->size();
  if (first < last && *first == '+') ++first;
  const auto [end, status] = std::from_chars(first, last, *value);
  if (status == std::errc::invalid_argument) return false;
  if (status == std::errc::result_out_of_range) {  // overflow or underflow: the exponent tells
    const std::string_view text(first, static_cast<size_t>(end - first));
    const size_t exponent = text.find_first_of("eE");
    const bool tiny =
        exponent != std::string_view::npos && text.substr(exponent + 1).substr(0, 1) == "-";
    *value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  *word = std::string_view(end, static_cast<size_t>(last - end));
  return true;
}

// Lines end in LF, CR or both.
std::string_view Statements::NextLine() {
  const size_t newline = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, newline);
  size_t taken = std::min(newline + 1, rest_.size());
  const size_t carriage_return = line.find('\r');
  if (carriage_return != std::string_view::npos) {
    if (carriage_return + 1 < line.size()) taken = carriage_return + 1;
    line = line.substr(0, carriage_return);
  }
  rest_.remove_prefix(taken);
  ++lines_read_;
  return line;
}

bool Statements::Next() {
  while (!rest_.empty()) {
    std::string_view line = NextLine();
    line_ = lines_read_;
    statement_ = Trim(line);
    if (statement_.empty() || statement_[0] == '#') continue;
    if (statement_.back() != '\\') return true;
    joined_.clear();
    line = statement_;
    while (!line.empty() && line.back() == '\\') {
      joined_.append(line.substr(0, line.size() - 1)).append(" ");
      line = Trim(NextLine());
    }
    joined_.append(line);
    statement_ = Trim(joined_);
    if (!statement_.empty()) return true;
  }
  return false;
}

}  // namespace swell
