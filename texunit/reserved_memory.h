// Address space that costs memory only where it is touched.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// `bytes` of zeroed, page-aligned memory; the system commits a page at its first write. Throws std::bad_alloc when the address space
/// is not to be had.
class ReservedMemory {
  public:
    explicit ReservedMemory(uint64_t bytes);
    ~ReservedMemory();
    ReservedMemory(const ReservedMemory&) = delete;
    ReservedMemory& operator=(const ReservedMemory&) = delete;

    /// Lets the system put bytes [first, last), all of them written, on huge pages, which spares most of the misses of address translation.
    /// Safe while others read; without effect where it has none to give.
    void join_pages(uint64_t first, uint64_t last);

    std::byte* data() const { return data_; }
    uint64_t size() const { return size_; }

  private:
    std::byte* data_;
    uint64_t size_;
};

}  // namespace rawtexel::texunit
