// The text of an OBJ or MTL file -> its statements, one at a time: lines that are not empty and no
// comment, those that a backslash continues joined to one.
#ifndef SWELL_IMPORT_STATEMENTS_H_
#define SWELL_IMPORT_STATEMENTS_H_

#include <cstdint>
#include <string>
#include <string_view>

namespace swell {

class Statements {
 public:
  explicit Statements(std::string_view text) : rest_(text) {}

  // False at the end of the text.
  bool Next();

  // Without space around it; until Next.
  std::string_view statement() const { return statement_; }
  uint32_t line() const { return line_; }  // its first, from 1
  size_t remaining() const { return rest_.size(); }

 private:
  std::string_view NextLine();

  std::string_view rest_, statement_;
  std::string joined_;
  uint32_t line_ = 0, lines_read_ = 0;
};

// Takes the first word off `text`; empty at the end and at a comment.
std::string_view TakeWord(std::string_view* text);

// `text` without spaces and tabs around it.
std::string_view Trim(std::string_view text);

// A number at the beginning of `word`; what stands behind it is left in `word`. False if there is
// none. Beyond the range of doubles: infinity, or 0.
bool TakeNumber(std::string_view* word, double* value);

}  // namespace swell

#endif  // SWELL_IMPORT_STATEMENTS_H_
