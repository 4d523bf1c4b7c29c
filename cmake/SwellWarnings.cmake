# swell_options: what every target of the project compiles with.
add_library(swell_options INTERFACE)
add_dependencies(swell_options swell_build_info)
target_include_directories(swell_options INTERFACE ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}
  ${CMAKE_BINARY_DIR}/generated)
target_compile_options(swell_options INTERFACE
  -Wall -Wextra
  # g++ 12 warns of std::string's own insert (gcc bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Law 1: one arithmetic everywhere; the compiler may not fuse what the source does not.
  -ffp-contract=off)
if(SWELL_WERROR)
  target_compile_options(swell_options INTERFACE -Werror)
endif()
if(SWELL_SANITIZE)
  target_compile_options(swell_options INTERFACE -fsanitize=${SWELL_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(swell_options INTERFACE -fsanitize=${SWELL_SANITIZE})
endif()
if(SWELL_FUZZ)
  target_compile_options(swell_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(swell_options INTERFACE -fsanitize=address,undefined)
endif()
