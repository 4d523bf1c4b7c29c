// Reads the statements of OBJ files.
#include "src/import/obj_geometry.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "src/import/polygon.h"
#include "src/import/read_meter.h"
#include "src/import/shapes.h"
#include "src/import/statements.h"

namespace swell {
namespace {

constexpr size_t kMaxObjMaterials = 1u << 20;

// Statements that say nothing of surfaces' shape or look.
constexpr std::string_view kSilent =
    " g o s mg lod vw vp d_interp c_interp shadow_obj trace_obj t usemap maplib bevel ";
// Those of curves and surfaces without a mesh.
constexpr std::string_view kFreeForm =
    " cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con bzp bsp cdc cdp res ";

bool Has(std::string_view words, std::string_view word) {
  return words.find(" " + std::string(word) + " ") != std::string_view::npos;
}

constexpr const char* kRows[] = {"vertex", "texture coordinate", "normal"};

class GeometryReader {
 public:
  GeometryReader(std::string_view text, const std::string* file, Diagnostics* diagnostics,
                 ObjGeometry* geometry)
      : statements_(text), file_(file), diagnostics_(*diagnostics), geometry_(*geometry) {
    Reserve(text);
    material_rows_.emplace("", 0);
  }

  void Read() {
    MeteredRead meter(statements_.remaining());
    while (!diagnostics_.failed() && statements_.Next()) {
      meter.Left(statements_.remaining());
      std::string_view rest = statements_.statement();
      const std::string_view keyword = TakeWord(&rest);
      if (keyword == "v") {
        ReadVertex(rest);
      } else if (keyword == "vt") {
        ReadRow("texture coordinate", rest, 1, 2, &geometry_.uvs);
      } else if (keyword == "vn") {
        ReadRow("normal", rest, 3, 3, &geometry_.normals);
      } else if (keyword == "f" || keyword == "fo") {
        ReadFace(rest);
      } else {
        ReadOther(keyword, Trim(rest));
      }
    }
    if (!diagnostics_.failed()) CheckWaiting();
  }

 private:
  // A corner's rows; kNone where it has none.
  struct Corner {
    std::array<uint32_t, 3> row{kNone, kNone, kNone};  // of positions, uvs, normals
  };
  // Rows that a face named before the file gave them.
  struct Waiting {
    uint64_t row = 0;
    uint32_t line = 0;  // 0: none
  };

  // Rows are counted first, as growing arrays would need twice their memory.
  void Reserve(std::string_view text) {
    size_t vertices = 0, uvs = 0, normals = 0;
    for (size_t at = text.find('v'); at < text.size(); at = text.find('v', at + 1)) {
      if ((at > 0 && text[at - 1] != '\n') || at + 1 == text.size()) continue;
      const char next = text[at + 1];
      vertices += next == ' ' || next == '\t' ? 1 : 0;
      uvs += next == 't' ? 1 : 0;
      normals += next == 'n' ? 1 : 0;
    }
    geometry_.positions.reserve(3 * vertices);
    geometry_.uvs.reserve(2 * uvs);
    geometry_.normals.reserve(3 * normals);
  }
  void Fail(const std::string& what) { diagnostics_.Fail({file_, statements_.line()}, what); }
  void Warn(const std::string& what) { diagnostics_.Warn({file_, statements_.line()}, what); }
  // Up to `values.size()` numbers; how many there are.
  template <size_t N>
  size_t ReadNumbers(std::string_view rest, const char* what, std::array<double, N>* values) {
    for (size_t count = 0; count < N; ++count) {
      const std::string_view word = TakeWord(&rest);
      if (word.empty()) return count;
      std::string_view tail = word;
      if (!TakeNumber(&tail, &(*values)[count]) || !std::isfinite((*values)[count])) {
        Fail(std::string(what) + " has " + Quote(word) + ", which is no finite number");
        return 0;
      }
      if (!tail.empty()) {
        Warn("numbers end where they stop being numbers: what follows in " + Quote(word) +
             " is ignored");
      }
    }
    return N;
  }

  bool CheckRows(const char* what, size_t rows) {
    if (rows < kMaxVertices) return true;
    Fail("more than " + std::to_string(kMaxVertices) + " rows of " + what + " are not supported");
    return false;
  }

  void ReadVertex(std::string_view rest) {
    std::array<double, 7> values{};
    const size_t count = ReadNumbers(rest, "a vertex", &values);
    if (diagnostics_.failed() || !CheckRows("vertices", geometry_.positions.size() / 3)) return;
    if (count < 3) return Fail("a vertex needs 3 numbers, not " + std::to_string(count));
    if (count >= 6) Warn("colours of vertices are not supported and are ignored");
    const bool weighted = count == 4 && values[3] != 0.0;
    for (size_t i = 0; i < 3; ++i) {
      const auto value = static_cast<float>(weighted ? values[i] / values[3] : values[i]);
      if (!std::isfinite(value)) {
        return Fail("the vertex lies beyond the range of numbers; scale the model down");
      }
      geometry_.positions.push_back(value);
    }
  }

  void ReadRow(const char* what, std::string_view rest, size_t needed, size_t kept,
               std::vector<float>* out) {
    std::array<double, 3> values{};
    const size_t count = ReadNumbers(rest, what, &values);
    if (diagnostics_.failed() || !CheckRows(what, out->size() / kept)) return;
    if (count < needed) {
      return Fail(std::string("a ") + what + " needs " + std::to_string(needed) + " numbers, not " +
                  std::to_string(count));
    }
    for (size_t i = 0; i < kept; ++i) out->push_back(static_cast<float>(values[i]));
  }

  // v, v/vt, v//vn or v/vt/vn; rows from 1, or from -1 backwards.
  bool ReadCorner(std::string_view word, Corner* corner) {
    const size_t counts[3] = {geometry_.positions.size() / 3, geometry_.uvs.size() / 2,
                              geometry_.normals.size() / 3};
    const std::string_view whole = word;
    for (size_t kind = 0; kind < 3; ++kind) {
      int64_t index = 0;
      const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool given = status == std::errc();
      word.remove_prefix(static_cast<size_t>(end - word.data()));
      if (given) {
        const auto rows = static_cast<int64_t>(counts[kind]);
        const int64_t row = index < 0 ? rows + index : index - 1;
        if (row < 0 || row >= static_cast<int64_t>(kMaxVertices) || index == 0) {
          Fail("a face's corner " + Quote(whole) + " names a " + kRows[kind] +
               " that is not there; " + std::to_string(rows) + " come before this line");
          return false;
        }
        corner->row[kind] = static_cast<uint32_t>(row);
        if (row >= rows && static_cast<uint64_t>(row) >= waiting_[kind].row) {
          waiting_[kind] = {static_cast<uint64_t>(row), statements_.line()};
        }
      } else if (kind != 1 || status == std::errc::result_out_of_range) {
        break;
      }
      if (word.empty()) return true;
      if (word[0] != '/' || kind == 2) break;
      word.remove_prefix(1);
      if (word.empty()) return true;  // "1/" and "1/1/"
    }
    Fail("a face's corner is written 1, 1/1, 1//1 or 1/1/1, not " + Quote(whole));
    return false;
  }

  // Rows may come behind the faces that name them. A mesh can do without uvs and normals.
  void CheckWaiting() {
    const size_t positions = geometry_.positions.size() / 3;
    if (waiting_[0].line != 0 && waiting_[0].row >= positions) {
      return diagnostics_.Fail({file_, waiting_[0].line},
                               "a face names vertex " + std::to_string(waiting_[0].row + 1) +
                                   ", but the file has " + std::to_string(positions) +
                                   "; it may be cut off");
    }
    const auto drop = [&](size_t kind, const char* what, size_t rows, const ObjGroup& group,
                          std::vector<uint32_t>* named) {
      if (waiting_[kind].line == 0 || waiting_[kind].row < rows || named->empty()) return;
      if (*std::max_element(named->begin(), named->end()) < rows) return;
      diagnostics_.Warn({file_, group.line}, std::string("faces name ") + what +
                                                 " that the file does not have; their mesh is "
                                                 "rendered without");
      named->clear();
    };
    for (ObjGroup& group : geometry_.groups) {
      drop(1, "texture coordinates", geometry_.uvs.size() / 2, group, &group.uvs);
      drop(2, "normals", geometry_.normals.size() / 3, group, &group.normals);
    }
  }

  void ReadFace(std::string_view rest) {
    face_.clear();
    for (std::string_view word = TakeWord(&rest); !word.empty(); word = TakeWord(&rest)) {
      Corner corner;
      if (!ReadCorner(word, &corner)) return;
      face_.push_back(corner);
    }
    if (face_.size() < 3) return Warn("faces of fewer than 3 corners are left out");
    const auto every_has = [&](size_t kind) {
      return std::all_of(face_.begin(), face_.end(),
                         [kind](const Corner& corner) { return corner.row[kind] != kNone; });
    };
    const bool has_uvs = every_has(1), has_normals = every_has(2);
    ObjGroup& group = GroupOf(has_uvs, has_normals);
    if (!CheckRows("triangles", group.positions.size() / 3 + face_.size())) return;
    triangles_.clear();
    Divide();
    for (const uint32_t i : triangles_) {
      group.positions.push_back(face_[i].row[0]);
      if (has_uvs) group.uvs.push_back(face_[i].row[1]);
      if (has_normals) group.normals.push_back(face_[i].row[2]);
    }
  }

  // face_ into triangles_. Corners that are not known yet count as the origin.
  void Divide() {
    points_.clear();
    for (const Corner& corner : face_) {
      const size_t at = 3 * size_t{corner.row[0]};
      std::array<float, 3> point{};
      if (at + 2 < geometry_.positions.size()) {
        std::copy_n(geometry_.positions.begin() + static_cast<ptrdiff_t>(at), 3, point.begin());
      }
      points_.push_back(point);
    }
    Triangulate(points_, &triangles_);
  }
  ObjGroup& GroupOf(bool has_uvs, bool has_normals) {
    const size_t kind = (has_uvs ? 1 : 0) + (has_normals ? 2 : 0);
    uint32_t& row = group_rows_[4 * size_t{material_} + kind];
    if (row == 0) {
      ObjGroup group;
      group.material = material_;
      group.line = statements_.line();
      geometry_.groups.push_back(std::move(group));
      row = static_cast<uint32_t>(geometry_.groups.size());
    }
    return geometry_.groups[row - 1];
  }

  void ReadOther(std::string_view keyword, std::string_view rest) {
    if (keyword == "usemtl") return UseMaterial(rest);
    if (keyword == "mtllib") {
      geometry_.libraries.push_back({std::string(rest), statements_.line()});
    } else if (keyword == "l" || keyword == "p") {
      Warn("points and lines are left out");
    } else if (Has(kFreeForm, keyword)) {
      Warn("free-form curves and surfaces are not supported and are left out; save them as meshes");
    } else if (keyword == "call" || keyword == "csh") {
      Warn(Quote(keyword) + " is not obeyed; a model reads no files but its materials");
    } else if (!Has(kSilent, keyword)) {
      Warn("unknown statement " + Quote(keyword) + " is ignored");
    }
  }

  void UseMaterial(std::string_view name) {
    const auto [at, is_new] = material_rows_.try_emplace(
        std::string(name), static_cast<uint32_t>(geometry_.materials.size()));
    if (is_new) {
      if (geometry_.materials.size() >= kMaxObjMaterials) {
        return Fail("more than " + std::to_string(kMaxObjMaterials) +
                    " materials are not supported");
      }
      geometry_.materials.push_back({std::string(name), statements_.line()});
    }
    material_ = at->second;
  }

  Statements statements_;
  const std::string* file_;
  Diagnostics& diagnostics_;
  ObjGeometry& geometry_;
  uint32_t material_ = 0;
  std::map<std::string, uint32_t, std::less<>> material_rows_;
  std::map<size_t, uint32_t> group_rows_;  // 1 + row of groups, by material and kinds of corners
  Waiting waiting_[3];                     // positions, uvs, normals
  std::vector<Corner> face_;
  std::vector<std::array<float, 3>> points_;
  std::vector<uint32_t> triangles_;
};

}  // namespace

void ReadObjGeometry(std::string_view text, const std::string* file, Diagnostics* diagnostics,
                     ObjGeometry* geometry) {
  GeometryReader(text, file, diagnostics, geometry).Read();
}

}  // namespace swell
