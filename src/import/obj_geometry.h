// The text of an OBJ file -> its rows of numbers, and its faces as triangles, by material.
#ifndef SWELL_IMPORT_OBJ_GEOMETRY_H_
#define SWELL_IMPORT_OBJ_GEOMETRY_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/import/diagnostics.h"

namespace swell {

// Faces of one material that have the same kinds of corners: three rows for each triangle.
struct ObjGroup {
  uint32_t material = 0;  // row of ObjGeometry::materials
  uint32_t line = 0;      // of its first face
  std::vector<uint32_t> positions;
  std::vector<uint32_t> uvs, normals;  // as many, or none
};

// A name and where it stood first.
struct ObjName {
  std::string text;
  uint32_t line = 0;
};

struct ObjGeometry {
  std::vector<float> positions;               // x y z
  std::vector<float> uvs;                     // u v
  std::vector<float> normals;                 // x y z
  std::vector<ObjName> materials{ObjName{}};  // as `usemtl` names them; row 0: of faces before any
  std::vector<ObjName> libraries;             // what stands behind `mtllib`
  std::vector<ObjGroup> groups;
};

// `file` is the text's path, for messages. An error is the diagnostics'.
void ReadObjGeometry(std::string_view text, const std::string* file, Diagnostics* diagnostics,
                     ObjGeometry* geometry);

}  // namespace swell

#endif  // SWELL_IMPORT_OBJ_GEOMETRY_H_
