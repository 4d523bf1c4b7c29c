// URIs of glTF files -> bytes of data URIs, or paths of files.
#ifndef SWELL_IMPORT_GLTF_URI_H_
#define SWELL_IMPORT_GLTF_URI_H_

#include <string>
#include <string_view>

#include "src/base/result.h"

namespace swell {

bool IsDataUri(std::string_view uri);
Result<std::string> DecodeDataUri(std::string_view uri);

// The file that `uri` names, as seen from the file `from`. An error for other schemes than file:.
Result<std::string> FileOfUri(const std::string& uri, const std::string& from);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_URI_H_
