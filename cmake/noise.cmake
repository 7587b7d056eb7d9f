# The masks of blue noise become part of rawtexel_texunit as they are. rawtexel_make_noise, built when asked for, makes them anew and needs
# no library of ours.
set(noise_masks "${PROJECT_SOURCE_DIR}/texunit/noise/masks.bin")
set_source_files_properties(texunit/noise_table.cpp PROPERTIES
  COMPILE_DEFINITIONS "RAWTEXEL_NOISE_MASKS=\"${noise_masks}\"" OBJECT_DEPENDS "${noise_masks}")

add_library(rawtexel_void_and_cluster STATIC EXCLUDE_FROM_ALL texunit/noise/void_and_cluster.cpp texunit/noise/mask_file.cpp)
target_include_directories(rawtexel_void_and_cluster PUBLIC "${PROJECT_BINARY_DIR}/rooms/texunit")
target_link_libraries(rawtexel_void_and_cluster PUBLIC rawtexel_flags PRIVATE rawtexel_warnings)
add_executable(rawtexel_make_noise EXCLUDE_FROM_ALL texunit/noise/make_noise.cpp)
target_link_libraries(rawtexel_make_noise PRIVATE rawtexel_void_and_cluster rawtexel_warnings)
