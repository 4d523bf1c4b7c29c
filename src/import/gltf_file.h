// A .gltf or .glb file -> its model and the bytes of its buffers, all spans checked.
#ifndef SWELL_IMPORT_GLTF_FILE_H_
#define SWELL_IMPORT_GLTF_FILE_H_

#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "src/import/file_bytes.h"
#include "src/import/gltf_json.h"

namespace swell {

// Files are mapped, not copied. Errors of all methods but Open do not name the file.
class GltfFile {
 public:
  static Result<GltfFile> Open(const std::string& path);

  const std::string& path() const { return path_; }
  const tinygltf::Model& model() const { return text_.model; }
  size_t image_count() const { return text_.images.size(); }

  // Bytes of a buffer view, decompressed if need be.
  Result<std::string_view> View(int view) const;
  // Bytes [offset, offset + length) of a buffer.
  Result<std::string_view> BufferRange(uint64_t buffer, uint64_t offset, uint64_t length) const;

  // The encoded bytes of an image that is embedded; of others the path, and no bytes.
  struct Image {
    std::string path;
    std::string_view bytes;
  };
  Result<Image> FindImage(int image) const;

 private:
  Status ReadContainer();
  Status ReadBuffers(std::string_view binary);
  Status ReadBuffer(size_t index, std::string_view binary);
  Status DecodeImages();
  Status Decompress();
  std::string_view Own(std::string bytes);

  std::string path_;
  GltfText text_;
  std::vector<FileBytes> files_;
  std::list<std::string> owned_;  // decoded data, at fixed addresses
  std::vector<std::string_view> buffers_;
  std::map<size_t, std::string_view> image_data_;  // of data URIs
  std::map<int, std::string_view> decompressed_;   // views
};

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_FILE_H_
