# Writes OUTPUT, a C++ source that holds the text of FILES for cli/reports/page.cpp, found by their names.
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"rawtexel(${text})rawtexel\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"cli/reports/page_files.h\"\n\n#include <array>\n\nnamespace rawtexel::cli {\nnamespace {\n\n"
  "constexpr PageFile kFiles[] = {\n${entries}};\n\n}  // namespace\n\n"
  "std::span<const PageFile> page_files() { return kFiles; }\n\n}  // namespace rawtexel::cli\n")
