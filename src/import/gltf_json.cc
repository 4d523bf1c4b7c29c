// The JSON text of a glTF file -> tinygltf's model, and the buffers and images that it names.
#include "src/import/gltf_json.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "src/base/text.h"
#include "src/import/diagnostics.h"
#include "src/import/gltf_limits.h"

namespace swell {
namespace {

using Json = nlohmann::json;

// tinygltf's reader of extensions calls itself, so the depth is bounded before it sees the text.
Status CheckShape(std::string_view text) {
  size_t depth = 0, values = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
      continue;
    }
    quoted = c == '"';
    if (c == '[' || c == '{') {
      if (++depth > kMaxGltfJsonDepth) {
        return Error{"its JSON is nested more than " + std::to_string(kMaxGltfJsonDepth) + " deep"};
      }
    }
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == ',' || c == '[' || c == '{') ++values;
  }
  if (values > kMaxGltfJsonValues) {
    return Error{"its JSON has more than " + std::to_string(kMaxGltfJsonValues) + " values"};
  }
  return Done{};
}

std::string TextOf(const Json& object, const char* name) {
  const auto at = object.find(name);
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

uint64_t WholeOf(const Json& object, const char* name, uint64_t fallback) {
  const auto at = object.find(name);
  return at != object.end() && at->is_number_unsigned() ? at->get<uint64_t>() : fallback;
}

bool IsFallback(const Json& buffer) {
  const auto extensions = buffer.find("extensions");
  if (extensions == buffer.end() || !extensions->is_object()) return false;
  const auto meshopt = extensions->find("EXT_meshopt_compression");
  return meshopt != extensions->end() && meshopt->is_object() && meshopt->value("fallback", false);
}

// Takes the list `name` out of the document.
Result<std::vector<GltfSource>> TakeSources(Json& document, const char* name) {
  std::vector<GltfSource> sources;
  const auto list = document.find(name);
  if (list == document.end()) return sources;
  if (!list->is_array()) return Error{"\"" + std::string(name) + "\" is not a list"};
  for (const Json& entry : *list) {
    if (!entry.is_object()) {
      return Error{name + std::string(" ") + std::to_string(sources.size()) + " is not an object"};
    }
    GltfSource source;
    source.uri = TextOf(entry, "uri");
    source.bytes = WholeOf(entry, "byteLength", 0);
    const uint64_t view = WholeOf(entry, "bufferView", ~uint64_t{0});
    if (view <= 0x7FFFFFFF) source.buffer_view = static_cast<int>(view);
    source.fallback = IsFallback(entry);
    sources.push_back(std::move(source));
  }
  document.erase(list);
  return sources;
}

// tinygltf refuses accessors of indices that name no data, though compressed and sparse ones need
// not. They get a view here, and lose it again in the model.
std::vector<size_t> LendViews(Json& document) {
  std::vector<size_t> lent;
  const auto accessors = document.find("accessors");
  if (accessors == document.end() || !accessors->is_array()) return lent;
  for (size_t i = 0; i < accessors->size(); ++i) {
    Json& accessor = (*accessors)[i];
    if (!accessor.is_object() || accessor.contains("bufferView")) continue;
    accessor["bufferView"] = 0;
    lent.push_back(i);
  }
  Json& views = document["bufferViews"];
  if (!lent.empty() && (views.is_null() || (views.is_array() && views.empty()))) {
    views = Json::array({{{"buffer", 0}, {"byteLength", 1}}});
  }
  if (views.is_null()) document.erase("bufferViews");
  return lent;
}

Result<GltfText> Parse(std::string_view text) {
  Json document = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (document.is_discarded()) return Error{"is not JSON"};
  if (!document.is_object()) return Error{"its JSON is not an object"};
  const auto asset = document.find("asset");
  const std::string version =
      asset != document.end() && asset->is_object() ? TextOf(*asset, "version") : std::string();
  if (version.substr(0, 2) != "2.") {
    return Error{"is glTF of version " + Quote(version) + "; version 2.0 is read"};
  }
  GltfText result;
  for (const auto& [name, list] :
       {std::pair{"buffers", &result.buffers}, std::pair{"images", &result.images}}) {
    Result<std::vector<GltfSource>> sources = TakeSources(document, name);
    if (!sources) return sources.error();
    *list = std::move(*sources);
  }
  const std::vector<size_t> lent = LendViews(document);
  const std::string rest = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  document = nullptr;
  if (rest.size() > kMaxGltfJsonBytes) return Error{"its JSON is too long"};
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  if (!reader.LoadASCIIFromString(&result.model, &error, &warning, rest.data(),
                                  static_cast<unsigned>(rest.size()), "")) {
    return Error{"is not valid glTF: " + Quote(FirstLine(error))};
  }
  for (size_t i : lent) {
    if (i < result.model.accessors.size()) result.model.accessors[i].bufferView = -1;
  }
  return result;
}

}  // namespace

Result<GltfText> ParseGltfText(std::string_view json) {
  if (json.size() > kMaxGltfJsonBytes) {
    return Error{"its JSON has more than " + std::to_string(kMaxGltfJsonBytes) + " bytes"};
  }
  if (Status shape = CheckShape(json); !shape) return shape.error();
  try {
    return Parse(json);
  } catch (const std::exception& exception) {
    return Error{"is not valid glTF: " + Quote(FirstLine(exception.what()))};
  }
}

}  // namespace swell
