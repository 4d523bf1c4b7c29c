// A .gltf or .glb file -> its model and the bytes of its buffers, all spans checked.
#include "src/import/gltf_file.h"

#include <cstring>

#include "src/import/diagnostics.h"
#include "src/import/gltf_meshopt.h"
#include "src/import/gltf_uri.h"

namespace swell {
namespace {

constexpr size_t kGlbHeader = 12, kGlbChunkHeader = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

uint32_t LittleWord(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 4; i-- > 0;) word = word << 8 | static_cast<uint8_t>(bytes[at + i]);
  return word;
}

struct Chunks {
  std::string_view json, binary;
};

// The first two chunks of a .glb file; all others are of no use here, by the specification.
Result<Chunks> SplitGlb(std::string_view file) {
  if (file.size() < kGlbHeader + kGlbChunkHeader) return Error{"ends within its header"};
  const uint32_t version = LittleWord(file, 4), length = LittleWord(file, 8);
  if (version != 2) {
    return Error{"is a .glb of version " + std::to_string(version) + "; version 2 is read"};
  }
  if (length > file.size()) {
    return Error{"has " + std::to_string(file.size()) + " of the " + std::to_string(length) +
                 " bytes that its header tells"};
  }
  Chunks chunks;
  size_t at = kGlbHeader;
  for (size_t i = 0; i < 2 && at + kGlbChunkHeader <= length; ++i) {
    const uint64_t size = LittleWord(file, at);
    const uint32_t type = LittleWord(file, at + 4);
    at += kGlbChunkHeader;
    if (size > length - at) return Error{"chunk " + std::to_string(i) + " ends beyond the file"};
    if (i == 0 && type != kJsonChunk) return Error{"does not begin with a chunk of JSON"};
    if (i == 0) chunks.json = file.substr(at, size);
    if (i == 1 && type == kBinaryChunk) chunks.binary = file.substr(at, size);
    at += size;
  }
  return chunks;
}

}  // namespace

Result<GltfFile> GltfFile::Open(const std::string& path) {
  GltfFile file;
  file.path_ = path;
  if (Status read = file.ReadContainer(); !read) {
    return Error{path + ": " + read.error().message};
  }
  return file;
}

Status GltfFile::ReadContainer() {
  Result<FileBytes> mapped = FileBytes::Map(path_);
  if (!mapped) return mapped.error();
  files_.push_back(std::move(*mapped));
  Chunks chunks{files_[0].bytes(), {}};
  if (chunks.json.substr(0, 4) == "glTF") {
    Result<Chunks> split = SplitGlb(chunks.json);
    if (!split) return split.error();
    chunks = *split;
  }
  Result<GltfText> text = ParseGltfText(chunks.json);
  if (!text) return text.error();
  text_ = std::move(*text);
  if (Status read = ReadBuffers(chunks.binary); !read) return read;
  if (Status read = DecodeImages(); !read) return read;
  return Decompress();
}

std::string_view GltfFile::Own(std::string bytes) { return owned_.emplace_back(std::move(bytes)); }

Status GltfFile::ReadBuffers(std::string_view binary) {
  buffers_.resize(text_.buffers.size());
  for (size_t i = 0; i < buffers_.size(); ++i) {
    if (Status read = ReadBuffer(i, binary); !read) {
      return Error{"buffer " + std::to_string(i) + ": " + read.error().message};
    }
  }
  return Done{};
}

Status GltfFile::ReadBuffer(size_t index, std::string_view binary) {
  GltfSource& source = text_.buffers[index];
  std::string_view bytes;
  if (source.uri.empty()) {
    if (source.fallback) return Done{};
    if (index != 0 || binary.empty()) return Error{"has neither a \"uri\" nor a binary chunk"};
    bytes = binary;
  } else if (IsDataUri(source.uri)) {
    Result<std::string> decoded = DecodeDataUri(source.uri);
    if (!decoded) return decoded.error();
    std::string().swap(source.uri);
    bytes = Own(std::move(*decoded));
  } else {
    const Result<std::string> file = FileOfUri(source.uri, path_);
    if (!file) return file.error();
    Result<FileBytes> mapped = FileBytes::Map(*file);
    if (!mapped) return Error{*file + ": " + mapped.error().message};
    files_.push_back(std::move(*mapped));
    bytes = files_.back().bytes();
  }
  if (bytes.size() < source.bytes) {
    return Error{"has " + std::to_string(bytes.size()) + " bytes of " +
                 std::to_string(source.bytes) + " that \"byteLength\" tells"};
  }
  buffers_[index] = bytes.substr(0, source.bytes);
  return Done{};
}

Status GltfFile::DecodeImages() {
  for (size_t i = 0; i < text_.images.size(); ++i) {
    if (!IsDataUri(text_.images[i].uri)) continue;
    Result<std::string> decoded = DecodeDataUri(text_.images[i].uri);
    if (!decoded) return Error{"image " + std::to_string(i) + ": " + decoded.error().message};
    image_data_[i] = Own(std::move(*decoded));
    text_.images[i].uri = "data:";
  }
  return Done{};
}

Status GltfFile::Decompress() {
  for (size_t i = 0; i < model().bufferViews.size(); ++i) {
    const auto found = model().bufferViews[i].extensions.find("EXT_meshopt_compression");
    if (found == model().bufferViews[i].extensions.end()) continue;
    Result<std::string> bytes = DecodeMeshopt(*this, found->second);
    if (!bytes) {
      return Error{"buffer view " + std::to_string(i) +
                   ", EXT_meshopt_compression: " + bytes.error().message};
    }
    decompressed_[static_cast<int>(i)] = Own(std::move(*bytes));
  }
  return Done{};
}

Result<std::string_view> GltfFile::BufferRange(uint64_t buffer, uint64_t offset,
                                               uint64_t length) const {
  if (buffer >= buffers_.size()) {
    return Error{"there is no buffer " + std::to_string(buffer)};
  }
  const std::string_view bytes = buffers_[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset) {
    return Error{"bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                 " lie beyond the " + std::to_string(bytes.size()) + " bytes of buffer " +
                 std::to_string(buffer)};
  }
  return bytes.substr(offset, length);
}

Result<std::string_view> GltfFile::View(int view) const {
  if (view < 0 || static_cast<size_t>(view) >= model().bufferViews.size()) {
    return Error{"there is no buffer view " + std::to_string(view)};
  }
  if (const auto found = decompressed_.find(view); found != decompressed_.end()) {
    return found->second;
  }
  const tinygltf::BufferView& span = model().bufferViews[static_cast<size_t>(view)];
  const uint64_t buffer = span.buffer < 0 ? buffers_.size() : static_cast<uint64_t>(span.buffer);
  Result<std::string_view> bytes = BufferRange(buffer, span.byteOffset, span.byteLength);
  if (!bytes) {
    return Error{"buffer view " + std::to_string(view) + ": " + bytes.error().message};
  }
  return bytes;
}

Result<GltfFile::Image> GltfFile::FindImage(int image) const {
  if (image < 0 || static_cast<size_t>(image) >= text_.images.size()) {
    return Error{"there is no image " + std::to_string(image)};
  }
  const GltfSource& source = text_.images[static_cast<size_t>(image)];
  const std::string name = "image " + std::to_string(image);
  if (const auto data = image_data_.find(static_cast<size_t>(image)); data != image_data_.end()) {
    return Image{name, data->second};
  }
  if (source.uri.empty()) {
    const Result<std::string_view> bytes = View(source.buffer_view);
    if (!bytes) return Error{"image " + std::to_string(image) + ": " + bytes.error().message};
    return Image{name, *bytes};
  }
  Result<std::string> file = FileOfUri(source.uri, path_);
  if (!file) return Error{"image " + std::to_string(image) + ": " + file.error().message};
  return Image{std::move(*file), {}};
}

}  // namespace swell
