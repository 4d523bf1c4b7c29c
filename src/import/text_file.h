// A path -> the text of a file in UTF-8: mapped as it is, or converted from UTF-16.
#ifndef SWELL_IMPORT_TEXT_FILE_H_
#define SWELL_IMPORT_TEXT_FILE_H_

#include <optional>
#include <string>
#include <string_view>

#include "src/base/result.h"
#include "src/import/file_bytes.h"

namespace swell {

class TextFile {
 public:
  // Errors as those of FileBytes::Map, without the path.
  static Result<TextFile> Open(const std::string& path);

  // Without a byte order mark.
  std::string_view text() const {
    return converted_ ? std::string_view(*converted_) : file_.bytes().substr(skipped_);
  }

 private:
  explicit TextFile(FileBytes file) : file_(std::move(file)) {}

  FileBytes file_;
  size_t skipped_ = 0;
  std::optional<std::string> converted_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_TEXT_FILE_H_
