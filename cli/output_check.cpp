#include "cli/output_check.h"

#include "scenes/image_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rawtexel::cli {
namespace {

[[noreturn]] void throw_cannot_write(const std::string& path, int error) {
    throw scenes::OutputError(path + ": cannot be written (" + std::strerror(error) + ")");
}

}  // namespace

void check_output(const std::string& path) {
    struct stat status {};
    const bool exists = stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) throw_cannot_write(path, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) return;  // a device is written to, not replaced
    // Files are written beside their place and renamed: what matters is whether the folder takes a new file.
    const std::string probe = path + "." + std::to_string(getpid()) + ".probe";
    const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) throw_cannot_write(path, errno);
    close(file);
    unlink(probe.c_str());
}

}  // namespace rawtexel::cli
