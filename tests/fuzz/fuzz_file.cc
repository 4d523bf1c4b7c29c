// Files for importers under a fuzzer, and checks of what they return.
#include "tests/fuzz/fuzz_file.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "src/base/check.h"

namespace swell::fuzz {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::error_code ignored;
    const fs::path base =
        fs::is_directory("/dev/shm", ignored) ? "/dev/shm" : fs::temp_directory_path();
    path_ = (base / ("swell_fuzz_" + std::to_string(getpid()))).string();
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void CheckRange(uint64_t first, uint64_t count, uint64_t rows) {
  SWELL_CHECK(first <= rows && count <= rows - first);
}

}  // namespace

std::string WriteFile(const std::string& name, std::string_view bytes) {
  static const Folder folder;
  const std::string path = folder.path() + "/" + name;
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

void Check(const Result<Scene>& result) {
  if (!result) {
    SWELL_CHECK(!result.error().message.empty());
    SWELL_CHECK(result.error().message.find('\n') == std::string::npos);
    return;
  }
  const Scene& scene = *result;
  const size_t vertices = scene.positions.size() / 3;
  SWELL_CHECK(scene.prim_shape.size() == scene.triangle_count() + scene.spheres.size());
  for (const uint32_t index : scene.indices) SWELL_CHECK(index < vertices);
  for (const float value : scene.positions) SWELL_CHECK(std::isfinite(value));
  for (const float value : scene.normals) SWELL_CHECK(std::isfinite(value));
  for (const uint32_t shape : scene.prim_shape) SWELL_CHECK(shape < scene.shapes.size());
  for (const Shape& shape : scene.shapes) {
    const uint32_t material = shape.record.material;
    const bool mixed = (material & kMixedMaterial) != 0;
    SWELL_CHECK((material & ~kMixedMaterial) <
                (mixed ? scene.mixes.size() : scene.materials.size()));
    CheckRange(shape.record.first_prim, shape.record.prim_count, scene.prim_shape.size());
    SWELL_CHECK(shape.alpha == kNoTexture || shape.alpha < scene.texture_nodes.size());
    SWELL_CHECK(shape.emission_image == kNoTexture ||
                shape.emission_image < scene.image_lights.size());
  }
  for (const float value : scene.tangents) SWELL_CHECK(std::isfinite(value));
  for (size_t i = 0; i < scene.indices.size(); ++i) {
    const Shape& mesh = scene.shapes[scene.prim_shape[i / 3]];
    const ShapeRecord& shape = mesh.record;
    const uint32_t index = scene.indices[i];
    SWELL_CHECK(shape.normal_offset == kNone ||
                index + shape.normal_offset < scene.normals.size() / 3);
    SWELL_CHECK(shape.uv_offset == kNone || index + shape.uv_offset < scene.uvs.size() / 2);
    SWELL_CHECK(mesh.second_uv_offset == kNone ||
                index + mesh.second_uv_offset < scene.uvs.size() / 2);
    SWELL_CHECK(mesh.tangent_offset == kNone ||
                index + mesh.tangent_offset < scene.tangents.size() / 4);
  }
  for (const Material& material : scene.materials) {
    SWELL_CHECK(material.kind < kMaterialKindCount);
    for (const MaterialTexture& texture : material.textures) {
      SWELL_CHECK(texture.node < scene.texture_nodes.size());
    }
    SWELL_CHECK(material.normal_map == kNoTexture ||
                material.normal_map < scene.texture_nodes.size());
  }
  for (const TextureStep& step : scene.texture_nodes) {
    SWELL_CHECK(step.op != TextureOp::kImage || step.image < scene.images.size());
  }
  for (const Object& object : scene.objects) {
    CheckRange(object.first_triangle, object.triangle_count, scene.triangle_count());
    CheckRange(object.first_sphere, object.sphere_count, scene.spheres.size());
  }
  for (const InstanceRecord& instance : scene.instances) {
    SWELL_CHECK(instance.object < scene.objects.size());
  }
}

}  // namespace swell::fuzz
