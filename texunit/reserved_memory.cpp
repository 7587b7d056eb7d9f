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

ReservedMemory::~ReservedMemory() { munmap(data_, size_); }

}  // namespace rawtexel::texunit
