# The CMake package: find_package(rawtexel) gives rawtexel::texunit alone, with highway and zstd;
# find_package(rawtexel COMPONENTS shading|scenes|raster) adds rooms and what they link.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/rawtexel")

function(rawtexel_install_room name)
  install(TARGETS rawtexel_${name} EXPORT rawtexel-${name} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${name}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/rawtexel" FILES_MATCHING PATTERN "*.h")
  install(EXPORT rawtexel-${name} NAMESPACE rawtexel:: DESTINATION "${package_dir}")
endfunction()

install(TARGETS rawtexel_flags EXPORT rawtexel-texunit)
rawtexel_install_room(texunit)
if(RAWTEXEL_APPS)
  rawtexel_install_room(raster)
  rawtexel_install_room(shading)
  rawtexel_install_room(scenes)
endif()

# Ports of the texture unit to shading languages, for users to take (docs/porting.md).
install(DIRECTORY "${PROJECT_SOURCE_DIR}/tests/shaders" DESTINATION "${CMAKE_INSTALL_DATADIR}/rawtexel"
  FILES_MATCHING PATTERN "*.glsl" PATTERN "*.comp" PATTERN "*.wgsl" PATTERN run.mjs PATTERN package.json PATTERN node_modules EXCLUDE)

configure_package_config_file(cmake/rawtexel-config.cmake.in rawtexel-config.cmake INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(rawtexel-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/rawtexel-config.cmake" "${PROJECT_BINARY_DIR}/rawtexel-config-version.cmake"
  DESTINATION "${package_dir}")
