// Values of glTF's extensions, as tinygltf keeps them -> numbers and words, or defaults.
#ifndef SWELL_IMPORT_GLTF_VALUES_H_
#define SWELL_IMPORT_GLTF_VALUES_H_

#include <tiny_gltf.h>

#include <array>
#include <optional>
#include <string>

namespace swell {

// The value of an extension, or null.
inline const tinygltf::Value* FindExtension(const tinygltf::ExtensionMap& extensions,
                                            const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

// A member of an object, or null. `object` may be null.
inline const tinygltf::Value* Member(const tinygltf::Value* object, const char* name) {
  if (object == nullptr || !object->IsObject() || !object->Has(name)) return nullptr;
  return &object->Get(name);
}

inline double NumberOf(const tinygltf::Value* object, const char* name, double fallback) {
  const tinygltf::Value* value = Member(object, name);
  return value != nullptr && value->IsNumber() ? value->GetNumberAsDouble() : fallback;
}

// A whole number from 0 to 2^53; nothing for anything else.
inline std::optional<uint64_t> WholeOf(const tinygltf::Value* object, const char* name) {
  const double number = NumberOf(object, name, -1.0);
  if (!(number >= 0.0 && number <= 9007199254740992.0)) return std::nullopt;
  const auto whole = static_cast<uint64_t>(number);
  if (static_cast<double>(whole) != number) return std::nullopt;
  return whole;
}

// An index of one of glTF's lists; -1 if there is none.
inline int IndexOf(const tinygltf::Value* object, const char* name) {
  const std::optional<uint64_t> whole = WholeOf(object, name);
  return whole && *whole <= 0x7FFFFFFF ? static_cast<int>(*whole) : -1;
}

inline std::string WordOf(const tinygltf::Value* object, const char* name) {
  const tinygltf::Value* value = Member(object, name);
  return value != nullptr && value->IsString() ? value->Get<std::string>() : std::string();
}

template <size_t N>
std::array<double, N> NumbersOf(const tinygltf::Value* object, const char* name,
                                std::array<double, N> fallback) {
  const tinygltf::Value* value = Member(object, name);
  if (value == nullptr || !value->IsArray() || value->ArrayLen() != N) return fallback;
  for (size_t i = 0; i < N; ++i) {
    const tinygltf::Value& number = value->Get(static_cast<int>(i));
    if (number.IsNumber()) fallback[i] = number.GetNumberAsDouble();
  }
  return fallback;
}

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_VALUES_H_
