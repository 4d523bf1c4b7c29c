# swell_add_revision(TARGET): gives TARGET the header swell/revision.h with version and git revision, which
# every build brings up to date.
function(swell_add_revision target)
  set(header ${CMAKE_BINARY_DIR}/generated/swell/revision.h)
  add_custom_target(swell_revision BYPRODUCTS ${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DOUTPUT=${header}
      -DVERSION=${PROJECT_VERSION} -P ${CMAKE_SOURCE_DIR}/cmake/write_revision.cmake
    COMMENT "")
  add_dependencies(${target} swell_revision)
endfunction()
