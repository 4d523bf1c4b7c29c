// pbrt text files -> words, strings, numbers and brackets, each with the file and line it stands
// on. Included files are read in place.
#ifndef SWELL_IMPORT_TOKENS_H_
#define SWELL_IMPORT_TOKENS_H_

#include <atomic>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/import/diagnostics.h"
#include "src/import/file_bytes.h"
#include "src/import/read_meter.h"

namespace swell {

inline constexpr size_t kMaxIncludeDepth = 64;
// They stay mapped while they are read, and Linux maps 65530 regions for a process. A few files
// that include each other twice at every level would be more than could ever be read.
inline constexpr size_t kMaxIncludedFiles = 32768;
std::string TooManyFiles();

enum class TokenKind { kEnd, kWord, kString, kNumber, kOpen, kClose };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  // a string's without quotes; lives as long as the stream
  Place place;
};

// Where a stream of its own reads an imported file: the files that are being read around it, from
// the scene's on, and the count of all that were ever opened.
struct ImportChain {
  std::vector<std::string> files;
  std::atomic<size_t>* opened = nullptr;
};

class TokenStream {
 public:
  explicit TokenStream(Diagnostics* diagnostics, ImportChain around = {})
      : diagnostics_(diagnostics), around_(std::move(around)) {}

  // Reads `path` next. `from` is the including directive; a null file for a main scene file.
  void Open(const std::string& path, Place from);

  Token Next();
  const Token& Peek();

  // Of a file that is imported from here.
  ImportChain Chain() const;
  // Forgets all files, and with them the texts of tokens.
  void Close();

 private:
  struct OpenFile {
    Place place;  // of the next character
    std::string_view rest;
    MeteredRead meter{};
  };
  Token Read();
  Token ReadString(OpenFile& file);
  void SkipSpace(OpenFile& file);
  bool MayOpen(const std::string& path, Place from);

  Diagnostics* diagnostics_;
  ImportChain around_;
  std::atomic<size_t> opened_{0};  // where no count is given
  std::deque<FileBytes> files_;
  std::deque<std::string> unescaped_;
  std::vector<OpenFile> stack_;
  std::optional<Token> peeked_;
};

// The number that `token` spells; fails for anything else and beyond the range of float.
float ParseFloat(const Token& token, Diagnostics* diagnostics);
int32_t ParseInteger(const Token& token, Diagnostics* diagnostics);
double ParseDouble(const Token& token, Diagnostics* diagnostics);

}  // namespace swell

#endif  // SWELL_IMPORT_TOKENS_H_
