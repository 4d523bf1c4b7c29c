// Rows of a file are copied for all uses but the last, to which they are moved.
#include "src/import/shared_ply.h"

#include <new>

namespace swell {

void SharedPly::Read() try {
  contents_ = ReadPly(path_, {&rows_.positions, &rows_.normals, &rows_.uvs, &rows_.indices});
} catch (const std::bad_alloc&) {
  rows_ = {};
}

Result<PlyContents> SharedPly::Give(Scene* part) {
  const std::lock_guard lock(mutex_);
  if (!contents_) throw std::bad_alloc();
  if (!*contents_) return contents_->error();
  if (--uses_ == 0) {
    part->positions = std::move(rows_.positions);
    part->normals = std::move(rows_.normals);
    part->uvs = std::move(rows_.uvs);
    part->indices = std::move(rows_.indices);
  } else {
    part->positions = rows_.positions;
    part->normals = rows_.normals;
    part->uvs = rows_.uvs;
    part->indices = rows_.indices;
  }
  return *contents_;
}

}  // namespace swell
