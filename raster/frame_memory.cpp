#include "raster/frame_memory.h"

#include <cassert>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rawtexel::raster {

namespace {

constexpr size_t kHugePage = size_t{2} << 20;
constexpr size_t kMostKept = 128;  // slabs, 512 MiB

/// Slabs without a frame.
struct Pool {
    std::mutex mutex;
    std::vector<std::byte*> slabs;
    ~Pool() {
        for (std::byte* slab : slabs) std::free(slab);
    }
};

Pool& pool() {
    static Pool all;
    return all;
}

std::byte* new_slab() {
    {
        Pool& kept = pool();
        const std::lock_guard lock(kept.mutex);
        if (!kept.slabs.empty()) {
            std::byte* const slab = kept.slabs.back();
            kept.slabs.pop_back();
            return slab;
        }
    }
    void* const memory = std::aligned_alloc(kHugePage, FrameMemory::kSlabBytes);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
    madvise(memory, FrameMemory::kSlabBytes, MADV_HUGEPAGE);  // a wish: without it, more page faults
#endif
    return static_cast<std::byte*>(memory);
}

}  // namespace

FrameMemory::~FrameMemory() {
    Pool& kept = pool();
    const std::lock_guard lock(kept.mutex);
    for (std::byte* slab : owned_) {
        if (kept.slabs.size() < kMostKept) {
            kept.slabs.push_back(slab);
        } else {
            std::free(slab);
        }
    }
}

FrameMemory::Slab FrameMemory::take(size_t bytes) {
    assert(bytes <= kSlabBytes);
    {
        const std::lock_guard lock(mutex_);
        while (!open_.empty()) {
            const Slab slab = open_.back();
            open_.pop_back();
            if (slab.bytes >= bytes) return slab;  // what is too small now is so for all of a frame's tasks
        }
    }
    std::byte* const memory = new_slab();
    const std::lock_guard lock(mutex_);
    owned_.push_back(memory);
    return {memory, kSlabBytes};
}

void FrameMemory::give(const Slab& rest) {
    const std::lock_guard lock(mutex_);
    open_.push_back(rest);
}

}  // namespace rawtexel::raster
