#include "cli/vulkan/glsl_compiler.h"

#include "scenes/image_io.h"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace rawtexel::cli {
namespace {

/// A folder of its own, removed with what is in it.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "rawtexel-glsl-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw scenes::OutputError(pattern + ": cannot be made a folder");
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::string operator/(const char* name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

/// Runs a program found on the PATH, what it says going to the file `log`. Its exit status; 127 where there is no such program.
int run_program(std::vector<std::string> words, const std::string& log) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const int error = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) return 127;
    int status = 0;
    if (waitpid(child, &status, 0) < 0) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// The first line that tells of an error, or the last line.
std::string first_error(const std::string& text) {
    std::string last;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        if (line.starts_with("ERROR: ")) return line.substr(7);
        if (!line.empty()) last = line;
        at = end + 1;
    }
    return last.empty() ? "glslangValidator failed without a word" : last;
}

}  // namespace

std::vector<std::byte> compile_glsl(const std::string& path) {
    scenes::read_file(path);  // refuses what is no file
    const ScratchFolder scratch;
    const std::string spirv = scratch / "shader.spv", log = scratch / "log";
    std::string folder = std::filesystem::path(path).parent_path().string();
    if (folder.empty()) folder = ".";
    const int status =
        run_program({"glslangValidator", "-V", "-S", "comp", "--target-env", "vulkan1.0", "-I" + folder, "-o", spirv, path}, log);
    if (status == 127)
        throw scenes::InputError(path + ": no glslangValidator to compile it: install glslang-tools, or hand in SPIR-V with --spirv FILE");
    if (status != 0) {
        const std::vector<std::byte> said = scenes::read_file(log);
        throw scenes::InputError(path + ": " + first_error({reinterpret_cast<const char*>(said.data()), said.size()}));
    }
    return scenes::read_file(spirv);
}

}  // namespace rawtexel::cli
