// Cells of text in, aligned columns out; numbers formatted for people.
#ifndef SWELL_STATS_TEXT_TABLE_H_
#define SWELL_STATS_TEXT_TABLE_H_

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swell {

// As printf, for results of less than 160 characters.
template <class... T> std::string Format(const char* format, T... values) {
  char text[160];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

// "-" where there is nothing to format.
inline std::string FormatOr(const char* format, const std::optional<double>& value) {
  return value ? Format(format, *value) : "-";
}

// Columns of text: the first two to the left, the others to the right.
class TextTable {
 public:
  explicit TextTable(size_t left_columns) : left_columns_(left_columns) {}
  void Add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  std::string Text() const {
    std::vector<size_t> width;
    for (const auto& row : rows_) {
      if (row.size() > width.size()) width.resize(row.size());
      for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
    }
    std::string text;
    for (const auto& row : rows_) {
      std::string line = " ";
      for (size_t c = 0; c < row.size(); ++c) {
        const std::string space(width[c] - row[c].size(), ' ');
        line += " " + (c < left_columns_ ? row[c] + space : space + row[c]) + " ";
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
  }

 private:
  size_t left_columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace swell

#endif  // SWELL_STATS_TEXT_TABLE_H_
