// A primitive compressed by KHR_draco_mesh_compression -> rows of its vertices and triangles.
#include <draco/compression/decode.h>

#include "src/import/gltf_primitive.h"
#include "src/import/gltf_values.h"

namespace swell {
namespace {

constexpr uint32_t kMaxWidth = 4;

// Values of one attribute, one row for each point; normalised integers become numbers up to 1.
Result<GltfRows> ReadAttribute(const draco::Mesh& mesh, uint32_t id) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr) return Error{"there is no attribute " + std::to_string(id)};
  GltfRows rows;
  rows.width = static_cast<uint32_t>(attribute->num_components());
  if (rows.width == 0 || rows.width > kMaxWidth) {
    return Error{"attribute " + std::to_string(id) + " has " + std::to_string(rows.width) +
                 " components"};
  }
  rows.values.resize(size_t{mesh.num_points()} * rows.width);
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
    if (value.value() >= attribute->size() ||
        !attribute->ConvertValue<float>(value, static_cast<int8_t>(rows.width),
                                        &rows.values[size_t{i} * rows.width])) {
      return Error{"attribute " + std::to_string(id) + " is damaged"};
    }
  }
  return rows;
}

}  // namespace

Result<GltfPrimitive> ReadDracoPrimitive(const GltfFile& file, const tinygltf::Value& extension,
                                         const std::vector<std::string>& names) {
  const Result<std::string_view> packed = file.View(IndexOf(&extension, "bufferView"));
  if (!packed) return packed.error();
  draco::DecoderBuffer buffer;
  buffer.Init(packed->data(), packed->size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return Error{"the data is damaged: " + decoded.status().error_msg_string()};
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  GltfPrimitive read;
  for (uint32_t i = 0; i < mesh->num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(i))) {
      if (corner.value() >= mesh->num_points()) return Error{"a triangle names no vertex"};
      read.indices.push_back(corner.value());
    }
  }
  const tinygltf::Value* attributes = Member(&extension, "attributes");
  for (const std::string& name : names) {
    const int id = IndexOf(attributes, name.c_str());
    if (id < 0) continue;
    Result<GltfRows> rows = ReadAttribute(*mesh, static_cast<uint32_t>(id));
    if (!rows) return Error{name + ": " + rows.error().message};
    read.attributes[name] = std::move(*rows);
  }
  return read;
}

}  // namespace swell
