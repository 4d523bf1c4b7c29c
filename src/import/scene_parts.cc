// Runs what is deferred, and shifts the rows of parts to where they are in the whole scene.
#include "src/import/scene_parts.h"

#include <new>
#include <string>
#include <utility>

#include "src/import/shapes.h"

namespace swell {
namespace {

// Moves where it can: a scene of one part is not copied.
template <class T> void AppendRows(std::vector<T>& to, std::vector<T>& from) {
  if (to.empty() && to.capacity() <= from.capacity()) {
    to = std::move(from);
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
  from = {};
}

}  // namespace

void SceneParts::Append(Rows& part, Scene* scene) {
  const auto vertices = static_cast<uint32_t>(scene->positions.size() / 3);
  const auto triangles = static_cast<uint32_t>(scene->triangle_count());
  const auto shapes = static_cast<uint32_t>(scene->shapes.size());
  const auto spheres = static_cast<uint32_t>(scene->spheres.size());
  const uint32_t normals = static_cast<uint32_t>(scene->normals.size() / 3) - vertices;
  const uint32_t uvs = static_cast<uint32_t>(scene->uvs.size() / 2) - vertices;
  for (Shape& shape : part.shapes) {
    ShapeRecord& record = shape.record;
    if ((record.flags & kShapeIsSphere) != 0) {
      record.sphere += spheres;
    } else {
      record.first_prim += triangles;
    }
    if (record.normal_offset != kNone) record.normal_offset += normals;
    if (record.uv_offset != kNone) record.uv_offset += uvs;
  }
  if (vertices != 0) {
    for (uint32_t& index : part.indices) index += vertices;
  }
  if (shapes != 0) {
    for (uint32_t& shape : part.prim_shape) shape += shapes;
  }
  AppendRows(scene->positions, part.positions);
  AppendRows(scene->normals, part.normals);
  AppendRows(scene->uvs, part.uvs);
  AppendRows(scene->indices, part.indices);
  AppendRows(scene->prim_shape, part.prim_shape);
  AppendRows(scene->shapes, part.shapes);
  AppendRows(scene->spheres, part.spheres);
}

SceneParts::Rows SceneParts::TakeRows(Scene& scene) {
  Rows rows{std::move(scene.positions),  std::move(scene.normals),
            std::move(scene.uvs),        std::move(scene.indices),
            std::move(scene.prim_shape), std::move(scene.shapes),
            std::move(scene.spheres),    nullptr};
  if (!scene.images.empty()) {
    rows.image = std::make_unique<TexelImage>(std::move(scene.images.front()));
  }
  return rows;
}

void SceneParts::Run(const Make& make, Part* part) {
  Diagnostics diagnostics;
  try {
    Scene scene;
    make(scene, diagnostics);
    part->rows = TakeRows(scene);
  } catch (const std::bad_alloc&) {
    diagnostics.Fail(part->place, "there is not enough memory for the file it names");
  }
  if (diagnostics.silent()) return;
  part->diagnostics = std::make_unique<Diagnostics>(std::move(diagnostics));
}

SceneParts::Part& SceneParts::Begin(Place place) {
  Part& part = parts_.emplace_back();
  part.place = place;
  return part;
}

Scene& SceneParts::Open(Place place) {
  if (!open_) Begin(place).open = std::make_unique<Scene>();
  open_ = true;
  return *parts_.back().open;
}

void SceneParts::Defer(Place place, Make make) {
  Part& part = Begin(place);
  part.deferred = true;
  open_ = false;
  group_.run([&part, make = std::move(make)] { Run(make, &part); });
}

void SceneParts::DeferPly(Place place, const std::string& path, MakeOfPly make) {
  Part& part = Begin(place);
  part.deferred = true;
  open_ = false;
  std::shared_ptr<SharedPly>& ply = plys_[path];
  const bool is_new = ply == nullptr;
  if (is_new) ply = std::make_shared<SharedPly>(path);
  ply->AddUse();
  if (is_new) group_.run([ply] { ply->Read(); });
  ply_uses_.push_back({&part, ply, std::move(make)});
}

// When all files are read. A file whose last part is made is forgotten.
void SceneParts::MakeOfPlys() {
  plys_.clear();
  for (PlyUse& use : ply_uses_) {
    group_.run([part = use.part, ply = std::move(use.ply), make = std::move(use.make)] {
      const auto make_part = [&](Scene& scene, Diagnostics& diagnostics) {
        make(*ply, scene, diagnostics);
      };
      Run(make_part, part);
    });
  }
  ply_uses_ = {};
  group_.wait();
}

void SceneParts::DeferImage(Place place, uint32_t row, Make make) {
  Defer(place, std::move(make));
  parts_.back().image = row;
}

size_t SceneParts::Close() {
  open_ = false;
  return parts_.size();
}

bool SceneParts::MayHoldShapes(size_t first) const {
  for (size_t i = first; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    // A deferred part is another thread's until it is joined.
    if (part.deferred ? part.image == kNoTexture : !part.open->shapes.empty()) return true;
  }
  return false;
}

// What is reserved takes no memory before it is written, and parts go as it is.
void SceneParts::Reserve(Scene* scene) const {
  size_t positions = 0, normals = 0, uvs = 0, indices = 0;
  for (const Part& part : parts_) {
    positions += part.rows.positions.size();
    normals += part.rows.normals.size();
    uvs += part.rows.uvs.size();
    indices += part.rows.indices.size();
  }
  scene->positions.reserve(positions);
  scene->normals.reserve(normals);
  scene->uvs.reserve(uvs);
  scene->indices.reserve(indices);
  scene->prim_shape.reserve(indices / 3);
}

void SceneParts::Join(Scene* scene, Diagnostics* diagnostics) {
  group_.wait();
  MakeOfPlys();
  for (Part& part : parts_) {
    if (part.open != nullptr) part.rows = TakeRows(*part.open);
    part.open.reset();
    if (part.diagnostics == nullptr) continue;
    diagnostics->Take(*part.diagnostics);
    if (part.diagnostics->failed()) return;
  }
  if (diagnostics->failed()) return;
  Reserve(scene);
  for (Part& part : parts_) {
    if (part.image != kNoTexture) {
      scene->images[part.image] = std::move(*part.rows.image);
    }
    starts_.push_back({static_cast<uint32_t>(scene->triangle_count()),
                       static_cast<uint32_t>(scene->spheres.size()),
                       static_cast<uint32_t>(scene->shapes.size())});
    if ((scene->positions.size() + part.rows.positions.size()) / 3 > kMaxVertices ||
        (scene->indices.size() + part.rows.indices.size()) / 3 > kMaxVertices) {
      return diagnostics->Fail(
          part.place,
          "the scene has more than " + std::to_string(kMaxVertices) + " vertices or triangles");
    }
    Append(part.rows, scene);
    part.rows = {};
  }
  starts_.push_back({static_cast<uint32_t>(scene->triangle_count()),
                     static_cast<uint32_t>(scene->spheres.size()),
                     static_cast<uint32_t>(scene->shapes.size())});
  parts_.clear();
}

}  // namespace swell
