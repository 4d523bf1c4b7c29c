# Declares swell_build_info, which writes generated/swell/build_info.h: SWELL_GIT_REVISION (or
# "unknown"), SWELL_COMPILER and SWELL_VERSION. Every build looks; only a change rewrites the file.
set(SWELL_BUILD_INFO_HEADER ${CMAKE_BINARY_DIR}/generated/swell/build_info.h)

find_program(SWELL_GIT git)
mark_as_advanced(SWELL_GIT)

add_custom_target(swell_build_info
  COMMAND ${CMAKE_COMMAND}
    -DGIT=${SWELL_GIT}
    -DSOURCE_DIR=${CMAKE_SOURCE_DIR}
    "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    -DVERSION=${PROJECT_VERSION}
    -DHEADER=${SWELL_BUILD_INFO_HEADER}
    -P ${CMAKE_CURRENT_LIST_DIR}/WriteBuildInfo.cmake
  BYPRODUCTS ${SWELL_BUILD_INFO_HEADER}
  COMMENT "Looking at the git revision"
  VERBATIM)
