// glTF 2.0 files (.gltf, .glb) -> a Scene.
#include "src/import/gltf_reader.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>

#include "src/import/dark_emitters.h"
#include "src/import/frame_scene.h"
#include "src/import/gltf_meshes.h"
#include "src/import/gltf_view.h"

namespace swell {
namespace {

// Those that are read, and those whose absence the surface's maker warns of.
constexpr std::string_view kKnown[] = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};
// Those that say nothing of the picture.
constexpr std::string_view kSilent[] = {"KHR_animation_pointer", "KHR_xmp", "KHR_xmp_json_ld"};

template <size_t N> bool Contains(const std::string_view (&list)[N], std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

void CheckExtensions(const tinygltf::Model& model, Diagnostics& diagnostics, Place place) {
  for (const std::string& name : model.extensionsRequired) {
    if (Contains(kKnown, name)) continue;
    return diagnostics.Fail(place, "requires the extension " + Quote(name) +
                                       ", which is not supported; export the scene without it");
  }
  for (const std::string& name : model.extensionsUsed) {
    if (Contains(kKnown, name) || Contains(kSilent, name)) continue;
    diagnostics.Warn(place, "the extension " + Quote(name) + " is not supported and is ignored");
  }
}

// The largest channel of what a shape emits.
float Brightest(const Scene& scene, const Shape& shape) {
  if (!shape.emits) return 0.0f;
  std::array<float, 3> texel{1, 1, 1};
  if (shape.emission_image != kNoTexture) {
    texel = {};
    const TexelImage& image = scene.image_lights[shape.emission_image].image;
    for (uint32_t y = 0; y < image.levels[0].height; ++y) {
      for (uint32_t x = 0; x < image.levels[0].width; ++x) {
        const std::array<float, 3> value = TexelAt(image, 0, x, y);
        for (size_t c = 0; c < 3; ++c) texel[c] = std::max(texel[c], value[c]);
      }
    }
  }
  float most = 0.0f;
  for (size_t c = 0; c < 3; ++c) most = std::max(most, shape.radiance[c] * texel[c]);
  return most;
}

// Surfaces that emit no more than white reflects are lit signs, not what lights a scene.
bool HasLamps(const Scene& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [&](const Shape& shape) { return Brightest(scene, shape) > 1.0f; });
}

void ReadScene(const GltfFile& file, const ImportOptions& options, Diagnostics& diagnostics,
               Place place, Scene& scene) {
  CheckExtensions(file.model(), diagnostics, place);
  if (diagnostics.failed()) return;
  const Result<std::vector<GltfPlacedNode>> nodes = PlaceNodes(file);
  if (!nodes) return diagnostics.Fail(place, nodes.error().message);
  GltfMaterials materials(file, &scene, &diagnostics, place);
  GltfMeshes(file, &scene, &diagnostics, place, &materials).Place(*nodes);
  if (diagnostics.failed()) return;
  if (Status loaded = materials.LoadImages(); !loaded) {
    return diagnostics.Fail(place, loaded.error().message);
  }
  AddGltfLights(file, *nodes, &diagnostics, place, &scene);
  FinishPrimitives(scene);
  LeaveDarkUnlit(&scene);
  const bool has_camera = SetGltfCamera(file, *nodes, options.camera, &diagnostics, place, &scene);
  if (diagnostics.failed()) return;
  if (!has_camera) {
    FrameScene(scene);
  } else if (scene.lights.empty() && !HasLamps(scene)) {
    AddSoftSky(scene);
  }
}

Result<Scene> Read(const std::string& path, const ImportOptions& options) {
  const Result<GltfFile> file = GltfFile::Open(path);
  if (!file) return file.error();
  Diagnostics diagnostics;
  const Place place{diagnostics.AddFile(path), 0};
  Scene scene;
  ReadScene(*file, options, diagnostics, place, scene);
  if (diagnostics.failed()) return diagnostics.error();
  scene.warnings = diagnostics.TakeWarnings();
  return scene;
}

}  // namespace

Result<Scene> ReadGltf(const std::string& path, const ImportOptions& options) {
  try {
    return Read(path, options);
  } catch (const std::exception& exception) {  // memory, or what a decoder throws
    return Error{path + ": cannot be read: " + exception.what()};
  }
}

}  // namespace swell
