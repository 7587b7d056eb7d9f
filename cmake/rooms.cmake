# A room is one library target. Its include root holds links to itself and to nothing else, so a source file can
# include another room's headers only when the room links that room: the dependency rule is checked by the compiler.
#
#   rawtexel_room(NAME [KNOWS ROOM...])
#
# compiles NAME/*.cpp into the static library rawtexel_NAME, alias rawtexel::NAME.
function(rawtexel_room name)
  cmake_parse_arguments(ROOM "" "" "KNOWS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${name}/*.cpp")
  set(root "${PROJECT_BINARY_DIR}/rooms/${name}")
  file(MAKE_DIRECTORY "${root}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${name}" "${root}/${name}" SYMBOLIC)
  add_library(rawtexel_${name} STATIC ${sources})
  add_library(rawtexel::${name} ALIAS rawtexel_${name})
  set_target_properties(rawtexel_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(rawtexel_${name} PUBLIC
    "$<BUILD_INTERFACE:${root}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rawtexel>")
  target_link_libraries(rawtexel_${name} PUBLIC rawtexel_flags PRIVATE $<BUILD_INTERFACE:rawtexel_warnings>)
  foreach(known IN LISTS ROOM_KNOWS)
    target_link_libraries(rawtexel_${name} PUBLIC rawtexel_${known})
  endforeach()
endfunction()
