// Counts and sizes of a scene's arrays.
#include "src/cli/scene_facts.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "src/cli/resolve.h"
#include "src/film/film.h"

namespace swell {
namespace {

constexpr const char* kLightNames[] = {"triangle",   "sphere",     "ellipsoid", "point",
                                       "distant",    "infinite",   "spot",      "goniometric",
                                       "projection", "environment"};
constexpr const char* kFormatNames[] = {"bytes", "halves", "floats"};

template <class T> uint64_t Bytes(const std::vector<T>& column) {
  return column.capacity() * sizeof(T);
}

TextureFacts ImageFacts(const TexelImage& image, const char* use) {
  TextureFacts facts;
  facts.name = image.name;
  facts.use = use;
  facts.format = kFormatNames[static_cast<size_t>(image.format)];
  facts.channels = image.channels;
  facts.bytes = Bytes(image.words) + Bytes(image.decode) + Bytes(image.levels);
  if (!image.levels.empty()) {
    facts.width = image.levels[0].width;
    facts.height = image.levels[0].height;
  }
  return facts;
}

void CountGeometry(const Scene& scene, SceneFacts* facts) {
  facts->meshes = static_cast<uint64_t>(
      std::count_if(scene.shapes.begin(), scene.shapes.end(),
                    [](const Shape& s) { return (s.record.flags & kShapeIsSphere) == 0; }));
  facts->objects = scene.objects.size();
  facts->instances = scene.instances.size();
  facts->unique = {scene.triangle_count(), scene.spheres.size()};
  facts->drawn = CountDrawn(scene);
  facts->left_out = scene.left_out_triangles;
  facts->vertices = scene.positions.size() / 3;
  facts->normals = scene.normals.size() / 3;
  facts->uvs = scene.uvs.size() / 2;
  facts->bounds = WorldBounds(scene);
}

void CountMaterials(const Scene& scene, const SceneTables& tables,
                    std::span<const MaterialInfo* const> kinds, SceneFacts* facts) {
  const auto kind_name = [&](uint32_t kind) {
    return kind < kinds.size() ? kinds[kind]->name : "unknown";
  };
  for (const Material& m : scene.materials) ++facts->materials[kind_name(m.kind)];
  if (!scene.mixes.empty()) facts->materials["mix"] = scene.mixes.size();
  const std::vector<std::string> labels = MaterialLabels(scene.materials, kinds);
  for (size_t i = 0; i < labels.size(); ++i) {
    facts->material_labels.emplace_back(labels[i], kind_name(scene.materials[i].kind));
  }
  for (const LightRecord& light : tables.lights) {
    ++facts->lights[light.type < std::size(kLightNames) ? kLightNames[light.type] : "unknown"];
  }
}

uint64_t SkyBytes(const std::vector<SkyTable>& skies) {
  uint64_t bytes = 0;
  for (const SkyTable& sky : skies) {
    bytes += Bytes(sky.row_cdf) + Bytes(sky.column_cdf) + Bytes(sky.row_cosine) +
             Bytes(sky.inverse_angle);
  }
  return bytes;
}

void MeasureMemory(const Scene& scene, const SceneTables& tables, SceneFacts* facts) {
  const RenderRequest& r = scene.request;
  const Result<PixelBounds> crop = CropPixels(r.width, r.height, r.crop_window);
  const uint64_t pixels = crop ? uint64_t{crop->width()} * crop->height() : 0;
  uint64_t textures = Bytes(scene.texture_nodes) + Bytes(tables.textures.steps);
  uint64_t light_images = SkyBytes(tables.skies);
  for (const TextureFacts& image : facts->textures) {
    (image.use == "light" ? light_images : textures) += image.bytes;
  }
  facts->memory = {
      {"vertices", Bytes(scene.positions)},
      {"normals, uvs, colours",
       Bytes(scene.normals) + Bytes(scene.uvs) + Bytes(scene.colors) + Bytes(scene.tangents)},
      {"triangles", Bytes(scene.indices) + Bytes(scene.prim_shape)},
      {"shapes, spheres", Bytes(scene.shapes) + Bytes(scene.spheres) + Bytes(tables.shapes)},
      {"instances", Bytes(scene.instances) + Bytes(scene.objects)},
      {"materials", Bytes(scene.materials) + Bytes(tables.params) + Bytes(tables.kinds)},
      {"textures", textures},
      {"lights", Bytes(scene.lights) + Bytes(tables.lights) + Bytes(tables.alias_threshold) +
                     Bytes(tables.alias) + Bytes(tables.light_nodes)},
      {"images of lights", light_images},
      {"tree", facts->tree.bytes},
      {"film", pixels * sizeof(FilmPixel)},
  };
  for (const auto& [name, bytes] : facts->memory) facts->memory_bytes += bytes;
}

// Takes " (and 3 more like it)" off, as the readers' diagnostics write it.
uint64_t TakeRepeats(std::string* text) {
  constexpr std::string_view kBegin = " (and ", kEnd = " more like it)";
  const size_t begin = text->rfind(kBegin);
  if (begin == std::string::npos || !text->ends_with(kEnd)) return 0;
  const char* first = text->data() + begin + kBegin.size();
  const char* last = text->data() + text->size() - kEnd.size();
  uint64_t repeats = 0;
  const auto [end, status] = std::from_chars(first, last, repeats);
  if (status != std::errc() || end != last) return 0;
  text->resize(begin);
  return repeats;
}

// What warnings of one kind have in common: no place, no quoted names, no numbers.
std::string KindOfWarning(const std::string& warning) {
  const size_t place = warning.find(": ");
  std::string kind;
  bool quoted = false;
  for (size_t i = place == std::string::npos ? 0 : place + 2; i < warning.size(); ++i) {
    const char c = warning[i];
    if (c == '\'') quoted = !quoted;
    if (!quoted && std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  }
  return kind;
}

}  // namespace

std::vector<WarningFacts> GroupWarnings(const std::vector<std::string>& warnings) {
  std::vector<WarningFacts> groups;
  std::map<std::string, size_t> rows;
  for (std::string text : warnings) {
    const uint64_t count = 1 + TakeRepeats(&text);
    const auto [at, is_new] = rows.try_emplace(KindOfWarning(text), groups.size());
    if (is_new) groups.push_back({text, 0});
    groups[at->second].count += count;
  }
  return groups;
}

SceneFacts CollectFacts(const Scene& scene, const SceneTables& tables,
                        std::span<const MaterialInfo* const> kinds, const TreeSummary& tree) {
  SceneFacts facts;
  facts.camera = scene.camera;
  facts.request = scene.request;
  facts.tree = tree;
  CountGeometry(scene, &facts);
  CountMaterials(scene, tables, kinds, &facts);
  for (const TexelImage& image : scene.images) {
    facts.textures.push_back(ImageFacts(image, "texture"));
  }
  for (const ImageLight& light : scene.image_lights) {
    facts.textures.push_back(ImageFacts(light.image, "light"));
  }
  MeasureMemory(scene, tables, &facts);
  facts.warnings = GroupWarnings(scene.warnings);
  return facts;
}

}  // namespace swell
