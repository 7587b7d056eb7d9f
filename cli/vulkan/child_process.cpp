#include "cli/vulkan/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace rawtexel::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A child that returned ends with this, however its driver's threads fare.
constexpr int kReturned = 0, kNotReturned = 1;

[[noreturn]] void be_child(const std::function<std::vector<std::byte>()>& work, int result) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    constexpr rlimit kNone{0, 0};
    setrlimit(RLIMIT_CORE, &kNone);
    if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    const std::vector<std::byte> bytes = work();
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t written = write(result, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno != EINTR) _exit(kNotReturned);
        if (written > 0) done += size_t(written);
    }
    // Not exit: neither the parent's handlers nor the driver's are this process's to run.
    _exit(kReturned);
}

/// Whether there is something to read, or the end of it, before `deadline`.
bool wait_for(int file, Clock::time_point deadline) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return false;
        pollfd waiting{file, POLLIN, 0};
        const int ready = poll(&waiting, 1, int(std::min<long long>(left, 1000)));
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
    }
}

}  // namespace

ChildOutcome run_in_child(const std::function<std::vector<std::byte>()>& work, std::chrono::milliseconds patience) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    const pid_t child = fork();
    if (child == 0) be_child(work, ends[1]);
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        throw std::system_error(errno, std::generic_category(), "fork");
    }
    ChildOutcome outcome;
    const Clock::time_point deadline = Clock::now() + patience;
    std::array<std::byte, 1 << 16> part;
    for (;;) {
        if (!wait_for(ends[0], deadline)) {
            outcome.end = ChildOutcome::End::Hung;
            kill(child, SIGKILL);
            break;
        }
        const ssize_t got = read(ends[0], part.data(), part.size());
        if (got > 0) outcome.bytes.insert(outcome.bytes.end(), part.begin(), part.begin() + got);
        if (got == 0 || (got < 0 && errno != EINTR)) break;
    }
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (outcome.end == ChildOutcome::End::Hung) {
        outcome.bytes.clear();
    } else if (!WIFEXITED(status) || WEXITSTATUS(status) != kReturned) {
        outcome = {ChildOutcome::End::Died, WIFSIGNALED(status) ? WTERMSIG(status) : 0, {}};
    }
    return outcome;
}

}  // namespace rawtexel::cli
