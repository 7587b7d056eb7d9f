#include "scenes/encoded_bytes.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rawtexel::scenes {
namespace {

using texunit::ByteSource;
using texunit::TextureError;

class FileBytes final : public ByteSource {
  public:
    FileBytes(std::string name, std::string path) : name_(std::move(name)), path_(std::move(path)) {
        size_ = read_under_name([](const ByteSource& file) { return file.size(); });
    }

    uint64_t size() const override { return size_; }
    const std::string& name() const override { return name_; }
    void read(uint64_t offset, std::span<std::byte> out) const override {
        read_under_name([&](const ByteSource& file) {
            if (file.size() != size_)
                throw TextureError(path_ + ": has changed since the scene was loaded (" + std::to_string(file.size()) + " bytes, it had " +
                                   std::to_string(size_) + ")");
            file.read(offset, out);
            return out.size();
        });
    }

  private:
    /// Messages begin with the file's path, which may be anything; they get the name instead.
    template <class Read>
    uint64_t read_under_name(const Read& read) const try {
        return read(*texunit::open_file(path_));
    } catch (const TextureError& error) {
        throw TextureError(name_ + std::string(error.what()).substr(path_.size()));
    }

    std::string name_, path_;
    uint64_t size_ = 0;
};

class PartialBytes final : public ByteSource {
  public:
    PartialBytes(std::string name, EncodedBytes whole, uint64_t offset, uint64_t size)
        : name_(std::move(name)), whole_(std::move(whole)), offset_(offset), size_(size) {
        assert(offset <= whole_->size() && size <= whole_->size() - offset);
    }

    uint64_t size() const override { return size_; }
    const std::string& name() const override { return name_; }
    bool in_memory() const override { return whole_->in_memory(); }
    void read(uint64_t offset, std::span<std::byte> out) const override {
        if (offset > size_ || out.size() > size_ - offset)
            throw TextureError(name_ + ": truncated (" + std::to_string(size_) + " bytes, " + std::to_string(offset + out.size()) +
                               " are needed)");
        whole_->read(offset_ + offset, out);
    }

  private:
    std::string name_;
    EncodedBytes whole_;
    uint64_t offset_, size_;
};

}  // namespace

EncodedBytes bytes_of_file(std::string name, std::string path) {
    return std::make_shared<const FileBytes>(std::move(name), std::move(path));
}

EncodedBytes part_of(std::string name, EncodedBytes whole, uint64_t offset, uint64_t size) {
    return std::make_shared<const PartialBytes>(std::move(name), std::move(whole), offset, size);
}

std::vector<std::byte> leading_bytes(const ByteSource& bytes, uint64_t count) {
    std::vector<std::byte> leading(std::min(count, bytes.size()));
    bytes.read(0, leading);
    return leading;
}

std::vector<std::byte> all_bytes(const ByteSource& bytes) { return leading_bytes(bytes, bytes.size()); }

}  // namespace rawtexel::scenes
