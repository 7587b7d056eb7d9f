#include "tests/benchmarks/instructions/callgrind.h"

#include "tests/temporary_folder.h"

#include <valgrind/callgrind.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace rawtexel::instructions {
namespace {

/// The sum over one of callgrind's files ("Callgrind Format Specification", totals).
uint64_t total_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("summary:") || line.starts_with("totals:")) return std::stoull(line.substr(line.find(':') + 1));
    }
    throw std::runtime_error("callgrind wrote no total into " + file.string());
}

constexpr int kNoValgrind = 127;

}  // namespace

void counted(const std::function<void()>& work) {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    work();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS;
    CALLGRIND_STOP_INSTRUMENTATION;
}

std::vector<uint64_t> count_instructions(const std::vector<std::string>& command) {
    const test::TemporaryFolder folder;
    const std::string out = folder / "counts";
    // What is not counted is not instrumented either, and so several times as fast.
    std::vector<std::string> words{"valgrind",           "--tool=callgrind",     "--quiet",
                                   "--instr-atstart=no", "--collect-atstart=no", "--callgrind-out-file=" + out};
    words.insert(words.end(), command.begin(), command.end());
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process could be started");
    if (child == 0) {
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        // What the environment holds moves the stack, and with it what copies take.
        std::vector<std::string> kept;
        for (const char* const name : {"PATH", "LD_LIBRARY_PATH", "TMPDIR"})
            if (const char* const value = std::getenv(name)) kept.push_back(std::string(name) + "=" + value);
        std::vector<char*> environment;
        for (std::string& variable : kept) environment.push_back(variable.data());
        environment.push_back(nullptr);
        execvpe(arguments[0], arguments.data(), environment.data());
        _exit(kNoValgrind);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNoValgrind)
        throw std::runtime_error("valgrind could not be started: is it installed?");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("what was to be counted failed under valgrind");
    // One file a call, numbered from 1; what is left at the end has no call in it.
    std::vector<uint64_t> counts;
    for (int n = 1; std::filesystem::exists(out + "." + std::to_string(n)); ++n) counts.push_back(total_of(out + "." + std::to_string(n)));
    return counts;
}

}  // namespace rawtexel::instructions
