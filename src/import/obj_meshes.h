// A group of an OBJ file's faces -> rows of the scene in which a vertex has one number for its
// position, texture coordinate and normal.
#ifndef SWELL_IMPORT_OBJ_MESHES_H_
#define SWELL_IMPORT_OBJ_MESHES_H_

#include <cstdint>
#include <vector>

#include "src/import/obj_geometry.h"
#include "src/scene/scene.h"

namespace swell {

class VertexMerger {
 public:
  explicit VertexMerger(const ObjGeometry& geometry);

  // Appends the group's vertices, each combination of rows (nearly) once, and its triangles.
  void Append(const ObjGroup& group, Scene* scene);

 private:
  struct Vertex {
    uint32_t uv, normal;
    uint32_t next;  // another vertex at the same position
  };
  uint32_t Find(uint32_t position, uint32_t uv, uint32_t normal);

  const ObjGeometry& geometry_;
  std::vector<uint32_t> first_;  // vertex of each position, in the group at hand
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> positions_;  // of vertices_
};

}  // namespace swell

#endif  // SWELL_IMPORT_OBJ_MESHES_H_
