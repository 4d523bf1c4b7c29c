// Accessors of a glTF file -> floats and indices: every type, normalised or not, sparse or not.
#include "src/import/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "src/import/gltf_limits.h"

namespace swell {
namespace {

// Bytes of a component; 0 for an unknown type.
uint32_t ComponentBytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

uint32_t Width(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;
  }
}

// Elements of one type at equal distances; all of them lie within `bytes`.
struct Elements {
  std::string_view bytes;  // from the first element on; none: zeros
  uint64_t stride = 0;
  int component = 0;
  uint32_t component_bytes = 0, width = 0;
  bool normalized = false;

  template <class T> T Component(uint64_t row, uint32_t c) const {
    T value;
    std::memcpy(&value, bytes.data() + row * stride + c * sizeof(T), sizeof(T));
    return value;
  }
  // The specification's equations of normalised integers.
  template <class T> float Number(uint64_t row, uint32_t c) const {
    const auto value = static_cast<float>(Component<T>(row, c));
    if constexpr (!std::numeric_limits<T>::is_integer) return value;
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }
  float Float(uint64_t row, uint32_t c) const {
    switch (component) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return Number<int8_t>(row, c);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return Number<uint8_t>(row, c);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return Number<int16_t>(row, c);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return Number<uint16_t>(row, c);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return Number<uint32_t>(row, c);
      default:
        return Number<float>(row, c);
    }
  }
  uint32_t Index(uint64_t row) const {
    switch (component_bytes) {
      case 1:
        return Component<uint8_t>(row, 0);
      case 2:
        return Component<uint16_t>(row, 0);
      default:
        return Component<uint32_t>(row, 0);
    }
  }
  bool is_index() const {
    return width == 1 && (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  }
};

// Finds the data of `count` elements. `stride` 0: as close as can be.
Status Locate(const GltfFile& file, int view, uint64_t offset, uint64_t stride, uint64_t count,
              Elements* elements) {
  const Result<std::string_view> bytes = file.View(view);
  if (!bytes) return bytes.error();
  const uint64_t size = uint64_t{elements->component_bytes} * elements->width;
  elements->stride = stride == 0 ? size : stride;
  if (elements->stride < size) return Error{"the elements overlap"};
  if (count == 0) return Done{};
  // tinygltf takes strides below 2^8, Open counts below 2^31.
  const uint64_t needed = elements->stride * (count - 1) + size;
  if (offset > bytes->size() || needed > bytes->size() - offset) {
    return Error{std::to_string(count) + " elements from byte " + std::to_string(offset) +
                 " on lie beyond the " + std::to_string(bytes->size()) + " bytes of buffer view " +
                 std::to_string(view)};
  }
  elements->bytes = bytes->substr(offset);
  return Done{};
}

struct Opened {
  const tinygltf::Accessor* accessor = nullptr;
  Elements base;
  uint64_t sparse_count = 0;
  Elements sparse_rows, sparse_values;
};

Status OpenSparse(const GltfFile& file, Opened* opened) {
  const auto& sparse = opened->accessor->sparse;
  if (sparse.count < 0 || static_cast<uint64_t>(sparse.count) > opened->accessor->count ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    return Error{"its sparse part has a wrong count or offset"};
  }
  opened->sparse_count = static_cast<uint64_t>(sparse.count);
  Elements& rows = opened->sparse_rows;
  rows.component = sparse.indices.componentType;
  rows.component_bytes = ComponentBytes(rows.component);
  rows.width = 1;
  if (!rows.is_index()) return Error{"the indices of its sparse part have a wrong type"};
  if (Status found =
          Locate(file, sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset),
                 0, opened->sparse_count, &rows);
      !found) {
    return found;
  }
  opened->sparse_values = opened->base;
  opened->sparse_values.bytes = {};
  return Locate(file, sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset), 0,
                opened->sparse_count, &opened->sparse_values);
}

Result<Opened> Open(const GltfFile& file, int index) {
  const auto& accessors = file.model().accessors;
  if (index < 0 || static_cast<size_t>(index) >= accessors.size()) return Error{"is not there"};
  Opened opened;
  opened.accessor = &accessors[static_cast<size_t>(index)];
  const tinygltf::Accessor& accessor = *opened.accessor;
  Elements& base = opened.base;
  base.component = accessor.componentType;
  base.component_bytes = ComponentBytes(accessor.componentType);
  base.width = Width(accessor.type);
  base.normalized = accessor.normalized;
  if (base.component_bytes == 0 || base.width == 0) return Error{"has an unknown type"};
  if (accessor.count > kMaxGltfAccessorCount) {
    return Error{"has " + std::to_string(accessor.count) + " elements; at most " +
                 std::to_string(kMaxGltfAccessorCount) + " are supported"};
  }
  if (accessor.bufferView >= 0) {
    const auto& views = file.model().bufferViews;
    const auto view = static_cast<size_t>(accessor.bufferView);
    const uint64_t stride = view < views.size() ? views[view].byteStride : 0;
    if (Status found =
            Locate(file, accessor.bufferView, accessor.byteOffset, stride, accessor.count, &base);
        !found) {
      return found.error();
    }
  } else if (accessor.count > kMaxGltfZeroCount) {
    return Error{"has " + std::to_string(accessor.count) + " elements without data; at most " +
                 std::to_string(kMaxGltfZeroCount) + " are supported"};
  }
  if (accessor.sparse.isSparse) {
    if (Status found = OpenSparse(file, &opened); !found) return found.error();
  }
  return opened;
}

Result<Opened> OpenNamed(const GltfFile& file, int index) {
  Result<Opened> opened = Open(file, index);
  if (!opened) return Error{"accessor " + std::to_string(index) + ": " + opened.error().message};
  return opened;
}

}  // namespace

Result<uint64_t> CountRows(const GltfFile& file, int accessor) {
  const Result<Opened> opened = OpenNamed(file, accessor);
  if (!opened) return opened.error();
  return uint64_t{opened->accessor->count};
}

Result<GltfRows> ReadRows(const GltfFile& file, int accessor, uint64_t first, uint64_t count) {
  const Result<Opened> opened = OpenNamed(file, accessor);
  if (!opened) return opened.error();
  if (first > opened->accessor->count || count > opened->accessor->count - first) {
    return Error{"accessor " + std::to_string(accessor) + ": has " +
                 std::to_string(opened->accessor->count) + " elements where " +
                 std::to_string(first + count) + " are needed"};
  }
  const Elements& base = opened->base;
  GltfRows rows;
  rows.width = base.width;
  rows.values.resize(count * base.width);
  const bool plain = base.component == TINYGLTF_COMPONENT_TYPE_FLOAT && !base.bytes.empty();
  for (uint64_t row = 0; row < count; ++row) {
    float* to = rows.values.data() + row * base.width;
    if (plain) {
      std::memcpy(to, base.bytes.data() + (first + row) * base.stride, 4 * base.width);
    } else if (!base.bytes.empty()) {
      for (uint32_t c = 0; c < base.width; ++c) to[c] = base.Float(first + row, c);
    }
  }
  for (uint64_t i = 0; i < opened->sparse_count; ++i) {
    const uint64_t row = opened->sparse_rows.Index(i);
    if (row < first || row - first >= count) continue;
    for (uint32_t c = 0; c < base.width; ++c) {
      rows.values[(row - first) * base.width + c] = opened->sparse_values.Float(i, c);
    }
  }
  return rows;
}

Result<GltfRows> ReadAllRows(const GltfFile& file, int accessor) {
  const Result<uint64_t> count = CountRows(file, accessor);
  if (!count) return count.error();
  return ReadRows(file, accessor, 0, *count);
}

Result<std::vector<uint32_t>> ReadIndices(const GltfFile& file, int accessor) {
  const Result<Opened> opened = OpenNamed(file, accessor);
  if (!opened) return opened.error();
  if (!opened->base.is_index()) {
    return Error{"accessor " + std::to_string(accessor) + ": is of no type that indices have"};
  }
  std::vector<uint32_t> indices(opened->accessor->count);
  for (size_t i = 0; i < indices.size() && !opened->base.bytes.empty(); ++i) {
    indices[i] = opened->base.Index(i);
  }
  for (uint64_t i = 0; i < opened->sparse_count; ++i) {
    const uint64_t row = opened->sparse_rows.Index(i);
    if (row < indices.size()) indices[row] = opened->sparse_values.Index(i);
  }
  return indices;
}

}  // namespace swell
