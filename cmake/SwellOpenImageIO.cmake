# Finds OpenImageIO as OpenImageIO::OpenImageIO, for the two folders that read and write images.
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)  # Imath's configuration tells of an optional Python binding
find_package(OpenImageIO REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)

# Debian's target names OpenCV's headers, which neither its package nor its users need.
get_target_property(swell_oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
foreach(folder ${swell_oiio_includes})
  if(NOT EXISTS ${folder})
    list(REMOVE_ITEM swell_oiio_includes ${folder})
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${swell_oiio_includes}"
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${swell_oiio_includes}")
unset(swell_oiio_includes)
