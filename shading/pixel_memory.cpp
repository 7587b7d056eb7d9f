#include "shading/pixel_memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <mutex>
#include <new>

namespace rawtexel::shading {
namespace {

constexpr size_t kHugePage = size_t{1} << 21;
/// From here on memory is the system's own; sanitizers, which cannot look into that, get all from the heap.
#ifdef __SANITIZE_ADDRESS__
constexpr size_t kLarge = SIZE_MAX;
#else
constexpr size_t kLarge = 2 * kHugePage;
#endif

constexpr size_t whole_pages(size_t bytes) { return (bytes + kHugePage - 1) & ~(kHugePage - 1); }

/// Starts at a huge page. Throws std::bad_alloc.
[[maybe_unused]] void* map_pages(size_t size) {
    void* const memory = mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    const auto first = reinterpret_cast<uintptr_t>(memory), aligned = whole_pages(first);
    if (aligned > first) munmap(memory, aligned - first);
    munmap(reinterpret_cast<void*>(aligned + size), first + kHugePage - aligned);
    madvise(reinterpret_cast<void*>(aligned), size, MADV_HUGEPAGE);
    return reinterpret_cast<void*>(aligned);
}

/// The block that was given back last.
class SpareBlock {
  public:
    /// Null unless the spare block has this size.
    void* take(size_t size) {
        const std::lock_guard lock(mutex_);
        return size == size_ ? std::exchange(memory_, nullptr) : nullptr;
    }
    void keep(void* memory, size_t size) {
        {
            const std::lock_guard lock(mutex_);
            std::swap(memory, memory_);
            std::swap(size, size_);
        }
        if (memory != nullptr) munmap(memory, size);
    }

  private:
    std::mutex mutex_;
    void* memory_ = nullptr;
    size_t size_ = 0;
};

SpareBlock& spare_block() {
    static SpareBlock* const spare = new SpareBlock;  // outlives every image
    return *spare;
}

}  // namespace

void* allocate_pixels(size_t bytes) {
    if (bytes > SIZE_MAX / 4) throw std::bad_alloc();
    if (bytes < kLarge) return ::operator new(bytes);
    void* const spare = spare_block().take(whole_pages(bytes));
    return spare != nullptr ? spare : map_pages(whole_pages(bytes));
}

void free_pixels(void* memory, size_t bytes) noexcept {
    if (bytes < kLarge) return ::operator delete(memory);
    spare_block().keep(memory, whole_pages(bytes));
}

}  // namespace rawtexel::shading
