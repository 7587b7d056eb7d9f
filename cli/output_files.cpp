#include "cli/output_files.h"

#include "cli/usage_error.h"
#include "scenes/output_file.h"

#include <filesystem>

namespace rawtexel::cli {
namespace {

namespace fs = std::filesystem;

// By device and inode where both exist, else by where their paths lead; never for devices, which hold nothing to lose.
bool is_same_file(const std::string& a, const std::string& b) {
    if (scenes::is_special(a)) return false;
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const auto place = [](const std::string& path) {
        std::error_code unknown;
        return fs::weakly_canonical(fs::absolute(path, unknown), unknown);
    };
    return place(a) == place(b);
}

}  // namespace

void check_apart(std::span<const OutputFile> outputs, std::span<const std::string> inputs) {
    for (size_t i = 0; i < outputs.size(); ++i) {
        const OutputFile& output = outputs[i];
        const std::string written = scenes::written_path(output.path);
        for (const OutputFile& other : outputs.first(i))
            if (is_same_file(written, scenes::written_path(other.path)))
                throw UsageError(output.option + ": '" + output.path + "' is the file that " + other.option + " writes");
        for (const std::string& input : inputs)
            if (is_same_file(written, input)) throw UsageError(output.option + ": '" + output.path + "' would replace a file that is read");
    }
}

void check_outputs(std::span<const OutputFile> outputs, std::span<const std::string> inputs) {
    for (const OutputFile& output : outputs) scenes::check_writable(output.path);
    check_apart(outputs, inputs);
}

}  // namespace rawtexel::cli
