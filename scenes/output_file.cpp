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
#include <utility>

namespace rawtexel::scenes {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
    throw OutputError(path + ": " + what + " (" + std::strerror(error) + ")");
}

/// A name of its own beside `target`, not built from its last part, which may be as long as the system allows.
std::string temporary_name(const std::string& target) {
    static std::atomic<uint64_t> number{0};
    const std::string name = ".rawtexel-" + std::to_string(::getpid()) + "-" + std::to_string(number++) + ".part";
    return (std::filesystem::path(target).parent_path() / name).string();
}

/// What no attempt to create a file beside the place would show: a folder in its place, a name that no file can have.
void check_place(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) fail(path, "cannot be written", EISDIR);
    } else if (errno != ENOENT) {
        fail(path, "cannot be written", errno);
    }
}

}  // namespace

std::string written_path(const std::string& path) {
    constexpr int kMaxLinks = 40;  // as many as Linux follows (path_resolution(7))
    std::filesystem::path target(path);
    std::error_code ignored;
    for (int links = 0; std::filesystem::is_symlink(target, ignored); ++links) {
        if (links == kMaxLinks) fail(path, "cannot be written", ELOOP);
        target = target.parent_path() / std::filesystem::read_symlink(target, ignored);  // an absolute one replaces all before it
    }
    return target.string();
}

bool is_special(const std::string& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status);
}

/// Where bytes go until they are all there.
class OutputStream::Target {
  public:
    Target() = default;
    virtual ~Target() = default;
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    virtual void write(std::span<const std::byte> bytes) = 0;
    virtual void finish() = 0;
};

/// A file under a temporary name that is removed unless it is finished.
class OutputStream::TemporaryFile final : public Target {
  public:
    explicit TemporaryFile(const std::string& path) : path_(path), target_(written_path(path)), temporary_(temporary_name(target_)) {
        file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0) fail(path_, "cannot be written", errno);
    }
    ~TemporaryFile() override {
        if (file_ >= 0) ::close(file_);
        if (!finished_) ::unlink(temporary_.c_str());
    }
    void write(std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail(path_, "cannot be written whole", errno);
            bytes = bytes.subspan(size_t(written));
        }
    }

    void finish() override {
        // Some file systems report a full disk only here.
        const int closed = ::close(file_);
        file_ = -1;
        if (closed != 0) fail(path_, "cannot be written whole", errno);
        if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
        finished_ = true;
    }

  private:
    std::string path_, target_, temporary_;
    int file_ = -1;
    bool finished_ = false;
};

/// A device, which is written to as it is.
class OutputStream::SpecialFile final : public Target {
  public:
    explicit SpecialFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
        if (!file_) fail(path_, "cannot be written", errno);
    }
    ~SpecialFile() override {
        if (file_) std::fclose(file_);
    }
    void write(std::span<const std::byte> bytes) override {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(path_, "cannot be written whole", errno);
    }
    void finish() override {
        const int closed = std::fclose(std::exchange(file_, nullptr));
        if (closed != 0) fail(path_, "cannot be written whole", errno);
    }

  private:
    std::string path_;
    std::FILE* file_;
};

OutputStream::OutputStream(const std::string& path) {
    check_place(path);
    if (is_special(path)) {
        target_ = std::make_unique<SpecialFile>(path);
    } else {
        target_ = std::make_unique<TemporaryFile>(path);
    }
}

OutputStream::~OutputStream() = default;

void OutputStream::write(std::span<const std::byte> bytes) { target_->write(bytes); }

void OutputStream::finish() { target_->finish(); }

void write_file(const std::string& path, std::span<const std::byte> bytes) {
    OutputStream stream(path);
    stream.write(bytes);
    stream.finish();
}

void check_writable(const std::string& path) {
    check_place(path);
    if (!is_special(path)) OutputStream unfinished(path);
}

}  // namespace rawtexel::scenes
