// Puts geometry and materials of OBJ files together: a mesh for each material.
#include "src/import/obj.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "src/import/diagnostics.h"
#include "src/import/frame_scene.h"
#include "src/import/mtl_surfaces.h"
#include "src/import/obj_geometry.h"
#include "src/import/obj_meshes.h"
#include "src/import/shapes.h"
#include "src/import/text_file.h"
#include "src/scene/objects.h"

namespace swell {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::string& path)
      : file_(diagnostics_.AddFile(path)),
        folder_(std::filesystem::path(path).parent_path().string()) {}

  Result<Scene> Read() {
    ReadFile();
    if (!diagnostics_.failed()) ReadLibraries();
    if (!diagnostics_.failed()) MakeSurfaces();
    if (!diagnostics_.failed()) MakeMeshes();
    if (diagnostics_.failed()) return diagnostics_.error();
    FinishPrimitives(scene_);
    FrameScene(scene_);
    scene_.warnings = diagnostics_.TakeWarnings();
    return std::move(scene_);
  }

 private:
  void ReadFile() {
    const Result<TextFile> file = TextFile::Open(*file_);
    if (!file) return diagnostics_.Fail({file_, 0}, file.error().message);
    ReadObjGeometry(file->text(), file_, &diagnostics_, &geometry_);
    if (!diagnostics_.failed() && geometry_.groups.empty()) {
      diagnostics_.Fail({file_, 0}, "has no faces; only surfaces are rendered");
    }
  }

  // A library's name may hold spaces, or the statement may list several of which the first that
  // exists counts.
  void ReadLibraries() {
    std::set<std::string> read;
    for (const ObjName& library : geometry_.libraries) {
      bool found = false;
      for (const std::string& name : NamesIn(library.text)) {
        const std::string path = (std::filesystem::path(folder_) / name).string();
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path, ignored)) continue;
        found = true;
        if (read.insert(path).second) ReadLibrary(path, library.line);
        break;
      }
      if (found) continue;
      diagnostics_.Warn({file_, library.line},
                        "the material file " + Quote(library.text) +
                            " does not exist; its materials are rendered as grey clay");
    }
  }

  void ReadLibrary(const std::string& path, uint32_t line) {
    const Result<TextFile> file = TextFile::Open(path);
    if (!file) {
      return diagnostics_.Warn({file_, line}, path + ": " + file.error().message +
                                                  "; its materials are rendered as grey clay");
    }
    ReadMtl(file->text(), diagnostics_.AddFile(path), &diagnostics_, &library_);
  }

  static std::vector<std::string> NamesIn(const std::string& text) {
    std::vector<std::string> names{text};
    std::string name;
    for (size_t i = 0; i <= text.size(); ++i) {
      if (i == text.size() || text[i] == ' ' || text[i] == '\t') {
        if (!name.empty()) names.push_back(name);
        name.clear();
      } else if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ') {
        name += text[++i];
      } else {
        name += text[i] == '\\' ? '/' : text[i];
      }
    }
    return names;
  }

  // Of each material that some face has.
  void MakeSurfaces() {
    surfaces_.resize(geometry_.materials.size());
    std::vector<bool> used(surfaces_.size(), false);
    for (const ObjGroup& group : geometry_.groups) used[group.material] = true;
    MtlSurfaces maker(&scene_, &diagnostics_, Size());
    uint32_t clay = kNone;
    for (size_t i = 0; i < surfaces_.size(); ++i) {
      if (!used[i]) continue;
      const ObjName& name = geometry_.materials[i];
      const auto found = i == 0 ? library_.end() : library_.find(name.text);
      if (found != library_.end()) {
        surfaces_[i] = maker.Make(found->second);
        continue;
      }
      if (i > 0 && !library_.empty()) {
        diagnostics_.Warn({file_, name.line}, "material " + Quote(name.text) +
                                                  " is not in any mtllib; grey clay replaces it");
      }
      if (clay == kNone) {
        clay = static_cast<uint32_t>(scene_.materials.size());
        scene_.materials.push_back(ClayMaterial());
      }
      surfaces_[i].material = clay;
    }
  }

  // The diagonal of the box around all vertices.
  double Size() const {
    Bounds box;
    for (size_t i = 0; i < geometry_.positions.size(); ++i) {
      box.Add(i % 3, geometry_.positions[i], geometry_.positions[i]);
    }
    return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
  }

  void MakeMeshes() {
    VertexMerger merger(geometry_);
    for (ObjGroup& group : geometry_.groups) {
      const MtlSurface& surface = surfaces_[group.material];
      Placement placement;
      placement.material = surface.material;
      placement.emission = surface.emission;
      placement.alpha = surface.alpha;
      placement.place = {file_, group.line};
      const std::string& name = geometry_.materials[group.material].text;
      placement.name = name.empty() ? "the mesh" : "the mesh of material " + Quote(name);
      const MeshStart start = BeginMesh(scene_);
      merger.Append(group, &scene_);
      group = {};
      FinishMesh(scene_, diagnostics_, placement, start);
      if (diagnostics_.failed()) return;
    }
    if (scene_.shapes.empty()) {
      diagnostics_.Fail({file_, 0}, "all its faces are without area; there is nothing to render");
    }
    geometry_ = {};
  }

  Diagnostics diagnostics_;
  const std::string* file_;
  std::string folder_;
  Scene scene_;
  ObjGeometry geometry_;
  MtlMaterials library_;
  std::vector<MtlSurface> surfaces_;  // of geometry_.materials
};

}  // namespace

Result<Scene> ReadObj(const std::string& path) { return ObjReader(path).Read(); }

}  // namespace swell
