#include "texunit/container_payload.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include <zstd.h>

namespace rawtexel::texunit {
namespace {

constexpr uint64_t kPageBytes = 64 << 10;

}  // namespace

PagedBytes::PagedBytes(std::shared_ptr<const ByteSource> file, uint64_t begin, uint64_t end)
    : file_(std::move(file)),
      end_(end),
      first_page_(begin / kPageBytes),
      pages_(size_t((end + kPageBytes - 1) / kPageBytes - std::min(begin, end) / kPageBytes)) {
    assert(begin <= end && end <= file_->size());
}

PagedBytes::~PagedBytes() {
    for (std::atomic<std::byte*>& page : pages_) delete[] page.load(std::memory_order_relaxed);
}

const std::byte* PagedBytes::page(uint64_t index) const {
    std::atomic<std::byte*>& kept = pages_[size_t(index - first_page_)];
    if (const std::byte* ready = kept.load(std::memory_order_acquire)) return ready;
    const uint64_t start = index * kPageBytes;
    const size_t bytes = size_t(std::min(kPageBytes, end_ - start));
    auto fresh = std::make_unique_for_overwrite<std::byte[]>(bytes);
    file_->read(start, {fresh.get(), bytes});
    std::byte* none = nullptr;
    if (kept.compare_exchange_strong(none, fresh.get(), std::memory_order_acq_rel)) return fresh.release();
    return none;
}

void PagedBytes::read(uint64_t offset, std::span<std::byte> out) const {
    assert(offset / kPageBytes >= first_page_ && offset <= end_ && out.size() <= end_ - offset);
    while (!out.empty()) {
        const uint64_t index = offset / kPageBytes, within = offset % kPageBytes;
        const size_t bytes = size_t(std::min<uint64_t>(out.size(), kPageBytes - within));
        std::memcpy(out.data(), page(index) + within, bytes);
        out = out.subspan(bytes);
        offset += bytes;
    }
}

InflatedBytes::InflatedBytes(std::shared_ptr<const ByteSource> file, std::string what, uint64_t offset, uint64_t compressed_bytes,
                             uint64_t bytes)
    : file_(std::move(file)), what_(std::move(what)), offset_(offset), compressed_bytes_(compressed_bytes), bytes_(bytes) {}

uint64_t InflatedBytes::compressed_bound(uint64_t bytes) { return ZSTD_compressBound(size_t(bytes)); }

std::unique_ptr<std::byte[]> InflatedBytes::inflate() const {
    auto compressed = std::make_unique_for_overwrite<std::byte[]>(size_t(compressed_bytes_));
    file_->read(offset_, {compressed.get(), size_t(compressed_bytes_)});
    // What is no frame, or one that says it is too long, is told before anything is allocated for it.
    const unsigned long long announced = ZSTD_getFrameContentSize(compressed.get(), size_t(compressed_bytes_));
    if (announced == ZSTD_CONTENTSIZE_ERROR) throw TextureError(name() + ": " + what_ + " is damaged: it is not a zstd frame");
    if (announced != ZSTD_CONTENTSIZE_UNKNOWN && announced > bytes_) {
        throw TextureError(name() + ": " + what_ + " inflates to " + std::to_string(announced) + " bytes, its format and extents need " +
                           std::to_string(bytes_));
    }
    auto data = std::make_unique_for_overwrite<std::byte[]>(size_t(bytes_));
    // Decompression to one buffer needs no window beside it, however large a window the frame asks for.
    const size_t got = ZSTD_decompress(data.get(), size_t(bytes_), compressed.get(), size_t(compressed_bytes_));
    if (ZSTD_isError(got)) throw TextureError(name() + ": " + what_ + " is damaged: zstd reports \"" + ZSTD_getErrorName(got) + "\"");
    if (got != bytes_) {
        throw TextureError(name() + ": " + what_ + " inflates to " + std::to_string(got) + " bytes, its format and extents need " +
                           std::to_string(bytes_));
    }
    return data;
}

void InflatedBytes::read(uint64_t offset, std::span<std::byte> out) const {
    assert(offset <= bytes_ && out.size() <= bytes_ - offset);
    if (!inflated_.load(std::memory_order_acquire)) {
        const std::lock_guard lock(inflating_);
        if (!data_) {
            data_ = inflate();
            inflated_.store(true, std::memory_order_release);
        }
    }
    std::memcpy(out.data(), data_.get() + offset, out.size());
}

}  // namespace rawtexel::texunit
