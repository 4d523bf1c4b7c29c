// An MTL file -> its materials, as tinyobjloader reads them, with what was said of each and where.
#ifndef SWELL_IMPORT_MTL_FILE_H_
#define SWELL_IMPORT_MTL_FILE_H_

#include <tiny_obj_loader.h>

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "src/import/diagnostics.h"

namespace swell {

struct MtlMaterial {
  tinyobj::material_t values;
  std::set<std::string, std::less<>> given;  // statements, as "Kd"
  Place place;                               // of its newmtl

  bool Has(std::string_view statement) const { return given.count(statement) != 0; }
};

using MtlMaterials = std::map<std::string, MtlMaterial, std::less<>>;

// Adds the materials of a file's text; of those with one name the first counts. Statements that
// are not understood are left out with a warning. `file` is owned by the diagnostics.
void ReadMtl(std::string_view text, const std::string* file, Diagnostics* diagnostics,
             MtlMaterials* materials);

}  // namespace swell

#endif  // SWELL_IMPORT_MTL_FILE_H_
