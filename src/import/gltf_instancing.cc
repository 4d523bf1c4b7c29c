// Accessors of EXT_mesh_gpu_instancing -> the transforms of a mesh's copies.
#include "src/import/gltf_meshes.h"
#include "src/import/gltf_values.h"

namespace swell {
namespace {

// The rows of an attribute of `width` numbers; none if it is absent.
Result<GltfRows> ReadAttribute(const GltfFile& file, const tinygltf::Value* attributes,
                               const char* name, uint32_t width) {
  const int accessor = IndexOf(attributes, name);
  if (accessor < 0) return GltfRows{};
  Result<GltfRows> rows = ReadAllRows(file, accessor);
  if (!rows) return Error{std::string(name) + ": " + rows.error().message};
  if (rows->width != width) {
    return Error{std::string(name) + " has " + std::to_string(rows->width) + " components"};
  }
  return rows;
}

}  // namespace

Result<std::vector<Transform>> ReadInstancing(const GltfFile& file,
                                              const tinygltf::Value& extension) {
  const tinygltf::Value* attributes = Member(&extension, "attributes");
  const Result<GltfRows> translations = ReadAttribute(file, attributes, "TRANSLATION", 3);
  const Result<GltfRows> rotations = ReadAttribute(file, attributes, "ROTATION", 4);
  const Result<GltfRows> scales = ReadAttribute(file, attributes, "SCALE", 3);
  size_t count = 0;
  for (const Result<GltfRows>* rows : {&translations, &rotations, &scales}) {
    if (!*rows) return rows->error();
    if ((*rows)->values.empty()) continue;
    if (count != 0 && (*rows)->count() != count) return Error{"its attributes differ in length"};
    count = (*rows)->count();
  }
  std::vector<Transform> transforms;
  transforms.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Point translation{0, 0, 0}, scale{1, 1, 1};
    std::array<double, 4> rotation{0, 0, 0, 1};
    const auto take = [i](const GltfRows& rows, auto& into) {
      for (size_t c = 0; c < into.size() && !rows.values.empty(); ++c) {
        into[c] = rows.values[into.size() * i + c];
      }
    };
    take(*translations, translation);
    take(*rotations, rotation);
    take(*scales, scale);
    transforms.push_back(FromParts(translation, rotation, scale));
  }
  return transforms;
}

}  // namespace swell
