#include "cli/output_folder.h"

#include "scenes/image_io.h"

#include <filesystem>
#include <system_error>

namespace rawtexel::cli {

OutputFolder::OutputFolder(std::string path) : path_(std::move(path)) {
    std::error_code error;
    is_new_ = std::filesystem::create_directory(path_, error);
    if (error || !std::filesystem::is_directory(path_, error))
        throw scenes::OutputError(path_ + ": cannot be made a folder (" + (error ? error.message() : "it is a file") + ")");
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;  // a folder that holds something stays
    if (is_new_) std::filesystem::remove(path_, ignored);
}

}  // namespace rawtexel::cli
