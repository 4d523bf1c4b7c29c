# swell_generate_material_registry(OUT_VAR FILE...): writes generated/material_registry.cc, the table
# kMaterialKinds in the order of the file names; rough_conductor.cc exports kRoughConductorMaterial.
function(swell_generate_material_registry out)
  set(declarations "")
  set(entries "")
  foreach(file ${ARGN})
    get_filename_component(stem ${file} NAME_WE)
    string(REPLACE "_" ";" words ${stem})
    set(class "")
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND class ${first}${rest})
    endforeach()
    string(APPEND declarations "extern const MaterialInfo k${class}Material;\n")
    string(APPEND entries "    &k${class}Material,\n")
  endforeach()
  set(path ${CMAKE_BINARY_DIR}/generated/material_registry.cc)
  file(CONFIGURE OUTPUT ${path} CONTENT
"// Generated from the names of kernels/materials/*.cc by cmake/SwellRegistry.cmake.
#include <iterator>

#include \"kernels/material.h\"

namespace swell {

@declarations@
constinit const MaterialInfo* const kMaterialKinds[] = {
@entries@};
constinit const uint32_t kMaterialKindCount = std::size(kMaterialKinds);

}  // namespace swell
" @ONLY)
  set(${out} ${path} PARENT_SCOPE)
endfunction()
