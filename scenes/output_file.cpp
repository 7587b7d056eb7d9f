#include "scenes/output_file.h"

#include "scenes/image_io.h"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace rawtexel::scenes {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
    throw OutputError(path + ": " + what + " (" + std::strerror(error) + ")");
}

/// A name of its own beside `path`, not built from its last part, which may be as long as the system allows.
std::string temporary_name(const std::string& path) {
    static std::atomic<uint64_t> number{0};
    const std::string name = ".rawtexel-" + std::to_string(::getpid()) + "-" + std::to_string(number++) + ".part";
    return (std::filesystem::path(path).parent_path() / name).string();
}

/// A file under a temporary name that is removed unless it is published.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& path) : path_(path), temporary_(temporary_name(path)) {
        file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0) fail(path_, "cannot be written", errno);
    }
    ~TemporaryFile() {
        if (file_ >= 0) ::close(file_);
        if (!published_) ::unlink(temporary_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail(path_, "cannot be written whole", errno);
            bytes = bytes.subspan(size_t(written));
        }
    }

    void publish() {
        // Some file systems report a full disk only here.
        const int closed = ::close(file_);
        file_ = -1;
        if (closed != 0) fail(path_, "cannot be written whole", errno);
        if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
        published_ = true;
    }

  private:
    std::string path_, temporary_;
    int file_ = -1;
    bool published_ = false;
};

/// Devices such as /dev/null are written to, not replaced.
bool is_special(const std::string& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status);
}

void write_special(const std::string& path, std::span<const std::byte> bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) fail(path, "cannot be written", errno);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    if (std::fclose(file) != 0 || !written) fail(path, "cannot be written whole", errno);
}

}  // namespace

void write_file(const std::string& path, std::span<const std::byte> bytes) {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) fail(path, "cannot be written", EISDIR);
    if (is_special(path)) return write_special(path, bytes);
    TemporaryFile file(path);
    file.write(bytes);
    file.publish();
}

}  // namespace rawtexel::scenes
