#include "texunit/containers.h"

#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rawtexel::texunit {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) { throw TextureError(name + ": " + what); }

/// Throws unless `size` bytes at `offset` are among the `available`.
void check_range(const std::string& name, uint64_t offset, uint64_t size, uint64_t available) {
    if (size <= available && offset <= available - size) return;
    fail(name, "truncated: " + std::to_string(size) + " bytes are needed at offset " + std::to_string(offset) + ", the file has " +
                   std::to_string(available));
}

class FileBytes final : public ByteSource {
  public:
    explicit FileBytes(const std::string& path) : name_(path) {
        // A pipe without a writer would block here; what is not a regular file is refused below.
        descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
        if (descriptor_ < 0) fail(name_, std::string("cannot be opened: ") + std::strerror(errno));
        struct stat about;
        if (fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) {
            close(descriptor_);
            fail(name_, "is not a regular file");
        }
        size_ = uint64_t(about.st_size);
    }
    ~FileBytes() override { close(descriptor_); }
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    uint64_t size() const override { return size_; }
    const std::string& name() const override { return name_; }

    void read(uint64_t offset, std::span<std::byte> out) const override {
        check_range(name_, offset, out.size(), size_);
        while (!out.empty()) {
            const ssize_t got = pread(descriptor_, out.data(), out.size(), off_t(offset));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail(name_, std::string("cannot be read: ") + std::strerror(errno));
            if (got == 0) fail(name_, "has become shorter while it was read");
            out = out.subspan(size_t(got));
            offset += uint64_t(got);
        }
    }

  private:
    std::string name_;
    int descriptor_ = -1;
    uint64_t size_ = 0;
};

class MemoryBytes final : public ByteSource {
  public:
    MemoryBytes(std::string name, std::vector<std::byte> bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

    uint64_t size() const override { return bytes_.size(); }
    const std::string& name() const override { return name_; }
    bool in_memory() const override { return true; }

    void read(uint64_t offset, std::span<std::byte> out) const override {
        check_range(name_, offset, out.size(), bytes_.size());
        if (!out.empty()) std::memcpy(out.data(), bytes_.data() + offset, out.size());
    }

  private:
    std::string name_;
    std::vector<std::byte> bytes_;
};

}  // namespace

std::shared_ptr<ByteSource> open_file(const std::string& path) { return std::make_shared<FileBytes>(path); }

std::shared_ptr<ByteSource> open_memory(std::string name, std::vector<std::byte> bytes) {
    return std::make_shared<MemoryBytes>(std::move(name), std::move(bytes));
}

}  // namespace rawtexel::texunit
