// Bytes packed by gzip -> the bytes themselves.
#ifndef SWELL_IMPORT_GUNZIP_H_
#define SWELL_IMPORT_GUNZIP_H_

#include <cstddef>
#include <string>
#include <string_view>

#include "src/base/result.h"

namespace swell {

bool IsGzip(std::string_view bytes);

// Fails for what is cut short or damaged, and for more than `max_bytes`.
Result<std::string> Gunzip(std::string_view packed, size_t max_bytes);

}  // namespace swell

#endif  // SWELL_IMPORT_GUNZIP_H_
