// The bodies of PLY files, element by element. Every count is checked against the file's size
// first.
#include "src/import/ply.h"

#include <algorithm>
#include <string_view>

#include "src/import/file_bytes.h"
#include "src/import/ply_faces.h"
#include "src/import/ply_header.h"
#include "src/import/ply_rows.h"
#include "src/import/ply_source.h"
#include "src/import/ply_vertices.h"
#include "src/import/read_meter.h"

namespace swell {
namespace {

template <class Source> class BodyReader {
 public:
  BodyReader(Source source, const PlyArrays& arrays)
      : source_(source),
        arrays_(arrays),
        first_vertex_(arrays.positions->size() / 3),
        first_index_(arrays.indices->size()) {}

  Result<PlyContents> Read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements) {
      if (Status fits = CheckCount(element); !fits) return fits.error();
      Status status = Done{};
      if (element.name == "vertex") {
        status = PlyVertices<Source>(source_, arrays_, &contents_).Read(element);
      } else if (element.name == "face") {
        status = PlyFaces<Source>(source_, arrays_, first_vertex_, &contents_).Read(element);
      } else if (element.name == "tristrips") {
        status = PlyErrorAt(element.line, "'tristrips' are not supported; save the mesh as faces");
      } else {
        status = SkipElement(element);
      }
      if (!status) return status.error();
    }
    contents_.triangles = (arrays_.indices->size() - first_index_) / 3;
    return contents_;
  }

 private:
  Status CheckCount(const PlyElement& element) const {
    const uint64_t row = Source::MinBytes(element);
    if (row > 0 && element.count > (source_.remaining() + Source::kSlackBytes) / row) {
      return PlyErrorAt(element.line, std::to_string(element.count) + " " +
                                          std::string(element.name) + " rows do not fit the " +
                                          std::to_string(source_.remaining()) +
                                          " bytes left in the file");
    }
    return Done{};
  }

  Status SkipElement(const PlyElement& element) {
    if (element.properties.empty()) return Done{};
    PlyRows<Source> rows(source_);
    for (uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        if (!rows.SkipProperty(property)) return rows.Truncated(element, row);
      }
    }
    return Done{};
  }

  Source source_;
  PlyArrays arrays_;
  size_t first_vertex_, first_index_;
  PlyContents contents_;
};

}  // namespace

Result<PlyContents> ReadPly(const std::string& path, const PlyArrays& arrays) {
  const Result<FileBytes> file = FileBytes::Read(path);
  if (!file) return Error{path + ": " + file.error().message};
  const std::string_view data = file->bytes();
  const MeteredRead meter(data.size());
  Result<PlyHeader> header = ReadPlyHeader(data);
  if (!header) return Error{path + header.error().message};

  const auto has = [&](std::string_view name) {
    return std::any_of(header->elements.begin(), header->elements.end(),
                       [&](const PlyElement& e) { return e.name == name && e.count > 0; });
  };
  for (std::string_view name : {"vertex", "face"}) {
    if (!has(name)) return Error{path + ": has no element '" + std::string(name) + "'"};
  }
  Result<PlyContents> contents =
      header->encoding == PlyEncoding::kAscii
          ? BodyReader(PlyAsciiSource(data, header->size, header->lines + 1), arrays).Read(*header)
          : BodyReader(PlyBinarySource(data, header->size, header->encoding == PlyEncoding::kBig),
                       arrays)
                .Read(*header);
  if (!contents) return Error{path + contents.error().message};
  return contents;
}

}  // namespace swell
