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

    std::byte* data() const { return data_; }
    uint64_t size() const { return size_; }

  private:
    std::byte* data_;
    uint64_t size_;
};

}  // namespace rawtexel::texunit
