// A container's payload: bytes that are fetched when first asked for, and kept.
#pragma once

#include "texunit/containers.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace rawtexel::texunit {

/// The bytes [begin, end) of a file, addressed by their offsets in it, read in pages of 64 KiB. Thread-safe without locks: two
/// threads that want the same page at once may both read it, and one copy is kept.
class PagedBytes final : public ByteSource {
  public:
    PagedBytes(std::shared_ptr<const ByteSource> file, uint64_t begin, uint64_t end);
    ~PagedBytes() override;

    uint64_t size() const override { return end_; }
    const std::string& name() const override { return file_->name(); }
    void read(uint64_t offset, std::span<std::byte> out) const override;

  private:
    const std::byte* page(uint64_t index) const;

    std::shared_ptr<const ByteSource> file_;
    uint64_t end_, first_page_;
    mutable std::vector<std::atomic<std::byte*>> pages_;
};

/// A Zstandard frame (or several) of `compressed_bytes` at `offset` of a file that must inflate to exactly `bytes`, done as a whole on
/// the first read. Memory: `compressed_bytes` for that moment and `bytes` from then on. Thread-safe.
class InflatedBytes final : public ByteSource {
  public:
    InflatedBytes(std::shared_ptr<const ByteSource> file, std::string what, uint64_t offset, uint64_t compressed_bytes, uint64_t bytes);

    uint64_t size() const override { return bytes_; }
    const std::string& name() const override { return file_->name(); }
    void read(uint64_t offset, std::span<std::byte> out) const override;

    /// The most bytes that a compressor makes of `bytes`; what claims to need more is damaged.
    static uint64_t compressed_bound(uint64_t bytes);

  private:
    std::unique_ptr<std::byte[]> inflate() const;

    std::shared_ptr<const ByteSource> file_;
    std::string what_;  ///< for messages, such as "level 3"
    uint64_t offset_, compressed_bytes_, bytes_;
    mutable std::mutex inflating_;
    mutable std::atomic<bool> inflated_ = false;
    mutable std::unique_ptr<std::byte[]> data_;
};

}  // namespace rawtexel::texunit
