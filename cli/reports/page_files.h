// The files of cli/reports/pages as they were when the program was built (cmake/embed_files.cmake writes the source).
#pragma once

#include <span>
#include <string_view>

namespace rawtexel::cli {

struct PageFile {
    std::string_view name;  ///< such as "style.css"
    std::string_view text;
};

std::span<const PageFile> page_files();

}  // namespace rawtexel::cli
