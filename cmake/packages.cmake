# Everything we use comes from Debian 12; cmake/debian-packages.txt names the packages.
find_package(PkgConfig REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
find_package(hwy CONFIG REQUIRED)
# Private to our own builds; an installed package does not name it.
add_library(rawtexel_warnings_build INTERFACE)
target_link_libraries(rawtexel_warnings_build INTERFACE $<BUILD_INTERFACE:rawtexel_warnings>)

if(RAWTEXEL_APPS)
  find_package(glm CONFIG REQUIRED)
  find_package(TBB CONFIG REQUIRED)
  find_package(nlohmann_json CONFIG REQUIRED)
  find_package(CLI11 CONFIG REQUIRED)
  find_package(TinyGLTF CONFIG REQUIRED)
  find_package(OpenImageIO CONFIG REQUIRED)
  # Debian's OpenImageIO names an OpenCV include folder that none of its dependencies installs.
  foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
    get_target_property(directories OpenImageIO::OpenImageIO ${property})
    if(directories)
      list(FILTER directories EXCLUDE REGEX "opencv")
      set_target_properties(OpenImageIO::OpenImageIO PROPERTIES ${property} "${directories}")
    endif()
  endforeach()
endif()
