// glTF files built in memory: data that grows, accessors that name it, and the JSON around them.
#ifndef SWELL_TESTS_IMPORT_GLTF_TEXTS_H_
#define SWELL_TESTS_IMPORT_GLTF_TEXTS_H_

#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "src/import/import_scene.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {

inline std::string Base64(std::string_view bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

// 2 x 2 pixels, red, green of alpha 128, blue of alpha 0, white of alpha 64, as base64.
inline constexpr char kPng[] =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFUlEQVR42mP4z8DwHwgbGMD0//8OAD8YB7qSpF8lAAAA"
    "AElFTkSuQmCC";

// One buffer and what lies in it.
class GltfData {
 public:
  std::string bytes;
  std::vector<std::string> views, accessors;  // JSON objects

  template <class T> size_t View(const std::vector<T>& values, const std::string& more = "") {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    const size_t offset = bytes.size(), size = values.size() * sizeof(T);
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
    views.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                    ",\"byteLength\":" + std::to_string(size) + more + "}");
    return views.size() - 1;
  }
  // An accessor by its JSON, without the view's number.
  size_t Accessor(size_t view, const std::string& members) {
    accessors.push_back("{\"bufferView\":" + std::to_string(view) + "," + members + "}");
    return accessors.size() - 1;
  }
  size_t Floats(const char* type, size_t width, const std::vector<float>& values) {
    return Accessor(View(values), Members(5126, values.size() / width, type));
  }
  size_t Indices(const std::vector<uint16_t>& values) {
    return Accessor(View(values), Members(5123, values.size(), "SCALAR"));
  }
  static std::string Members(int component, size_t count, const char* type) {
    return "\"componentType\":" + std::to_string(component) +
           ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"";
  }

  // The file, with `rest`: members of its object.
  std::string Json(const std::string& rest, const std::string& uri = "") const {
    const auto list = [](const std::vector<std::string>& entries) {
      std::string text;
      for (const std::string& entry : entries) text += (text.empty() ? "" : ",") + entry;
      return "[" + text + "]";
    };
    std::string text = "{\"asset\":{\"version\":\"2.0\"}";
    if (!bytes.empty()) {
      const std::string data =
          uri.empty() ? "data:application/octet-stream;base64," + Base64(bytes) : uri;
      text += ",\"buffers\":[{\"byteLength\":" + std::to_string(bytes.size()) +
              (data == "none" ? "" : ",\"uri\":\"" + data + "\"") + "}]";
    }
    if (!views.empty()) text += ",\"bufferViews\":" + list(views);
    if (!accessors.empty()) text += ",\"accessors\":" + list(accessors);
    return text + (rest.empty() ? "" : "," + rest) + "}";
  }
};

// A right angle of two triangles: 4 positions, as accessor 0, and texture coordinates, as 1.
inline GltfData SquareData() {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  data.Floats("VEC2", 2, {0, 1, 1, 1, 1, 0, 0, 0});
  data.Indices({0, 1, 2, 0, 2, 3});
  return data;
}
inline const std::string kSquare =
    "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,"
    "\"material\":0}]";
inline const std::string kOneNode = "\"nodes\":[{\"mesh\":0}]";

inline Result<Scene> ReadGltfText(const std::string& json, const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  return ImportScene({folder.Write("scene.gltf", json)}, options);
}

inline Scene GltfScene(const std::string& json, const ImportOptions& options = {}) {
  Result<Scene> scene = ReadGltfText(json, options);
  INFO(json.substr(0, 2000));
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

// The scene of a textured square of one material, given by its members.
inline Scene SquareOf(const std::string& material, const std::string& more = "") {
  return GltfScene(SquareData().Json("\"meshes\":[{" + kSquare + "}]," + kOneNode +
                                     ",\"materials\":[{" + material + "}]" +
                                     (more.empty() ? "" : "," + more)));
}
// Textures 0 and 1, of the same image.
inline const std::string kTextures =
    std::string(
        "\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0}],"
        "\"images\":[{\"uri\":\"data:image/png;base64,") +
    kPng + "\"}]";

// Whether the file is refused with `fragment` in the one line of the error.
inline void CheckRefused(const Result<Scene>& scene, std::string_view fragment) {
  REQUIRE_FALSE(scene);
  CAPTURE(scene.error().message);
  CAPTURE(std::string(fragment));
  CHECK(scene.error().message.find(fragment) != std::string::npos);
  CHECK(scene.error().message.find('\n') == std::string::npos);
}
inline void CheckGltfError(const std::string& json, std::string_view fragment) {
  CheckRefused(ReadGltfText(json), fragment);
}

inline size_t CountWarnings(const Scene& scene, std::string_view fragment) {
  size_t count = 0;
  for (const std::string& warning : scene.warnings) {
    count += warning.find(fragment) != std::string::npos;
  }
  return count;
}

}  // namespace swell::test

#endif  // SWELL_TESTS_IMPORT_GLTF_TEXTS_H_
