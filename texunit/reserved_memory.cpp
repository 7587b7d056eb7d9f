#include "texunit/reserved_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace rawtexel::texunit {

ReservedMemory::ReservedMemory(uint64_t bytes) : size_(std::max<uint64_t>(bytes, 1)) {
    // NORESERVE: a pyramid far larger than memory is fine as long as few of its blocks are sampled.
    void* const address = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (address == MAP_FAILED) throw std::bad_alloc();
    // A huge page would commit 2 MiB for one touched block.
    madvise(address, size_, MADV_NOHUGEPAGE);
    data_ = static_cast<std::byte*>(address);
}

void ReservedMemory::join_pages(uint64_t first, uint64_t last) {
    constexpr uintptr_t kHugePage = uintptr_t{1} << 21;
    constexpr int kCollapse = 25;  // MADV_COLLAPSE of Linux 6.1, which the headers of Debian 12 lack
    const auto base = reinterpret_cast<uintptr_t>(data_);
    const uintptr_t begin = (base + first + kHugePage - 1) & ~(kHugePage - 1), end = (base + last) & ~(kHugePage - 1);
    if (begin >= end) return;
    void* const address = reinterpret_cast<void*>(begin);
    if (madvise(address, end - begin, MADV_HUGEPAGE) == 0) madvise(address, end - begin, kCollapse);
}

ReservedMemory::~ReservedMemory() { munmap(data_, size_); }

}  // namespace rawtexel::texunit
