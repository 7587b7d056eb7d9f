#include "cli/output_file.h"

#include "scenes/image_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rawtexel::cli {
namespace {

[[noreturn]] void throw_cannot_write(const std::string& path, int error) {
    throw scenes::OutputError(path + ": cannot be written (" + std::strerror(error) + ")");
}

// A new file beside `path`, removed again unless it is renamed to it.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& path) : path_(path), temporary_(path + ".part-" + std::to_string(getpid())) {
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw_cannot_write(path_, errno);
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        if (!renamed_) unlink(temporary_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write_all(std::string_view text) {
        while (!text.empty()) {
            const ssize_t written = write(descriptor_, text.data(), text.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) throw_cannot_write(path_, errno);
            text.remove_prefix(size_t(written));
        }
    }
    void commit() {
        // Some file systems tell only now that the space was not there.
        if (close(std::exchange(descriptor_, -1)) != 0) throw_cannot_write(path_, errno);
        if (rename(temporary_.c_str(), path_.c_str()) != 0) throw_cannot_write(path_, errno);
        renamed_ = true;
    }

  private:
    std::string path_, temporary_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

}  // namespace

void check_output(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) throw_cannot_write(path, EISDIR);
    const TemporaryFile probe(path);
}

void write_text(const std::string& path, std::string_view text) {
    TemporaryFile file(path);
    file.write_all(text);
    file.commit();
}

}  // namespace rawtexel::cli
