#include "tests/texunit/container_allocations.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace rawtexel::texunit::test_files {
namespace {

std::atomic<size_t> live = 0, peak = 0;

void count_allocation(size_t bytes) {
    const size_t now = live += bytes;
    size_t highest = peak;
    while (highest < now && !peak.compare_exchange_weak(highest, now)) {
    }
}

}  // namespace

size_t live_bytes() { return live; }
size_t peak_bytes() { return peak; }
void forget_peak() { peak = live.load(); }

}  // namespace rawtexel::texunit::test_files

void* operator new(size_t size) {
    void* const memory = std::malloc(std::max<size_t>(size, 1));
    if (!memory) throw std::bad_alloc();
    rawtexel::texunit::test_files::count_allocation(malloc_usable_size(memory));
    return memory;
}

void operator delete(void* memory) noexcept {
    rawtexel::texunit::test_files::live -= malloc_usable_size(memory);
    std::free(memory);
}

void operator delete(void* memory, size_t) noexcept { operator delete(memory); }
