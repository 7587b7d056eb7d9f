// Blocks read and written one bit at a time, from the lowest bit of the first byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rawtexel::reference {

using Block16 = std::array<std::byte, 16>;

/// Takes fields out of a block, in order.
class BlockReader {
  public:
    explicit BlockReader(const Block16& block) : block_(block) {}

    int take_bit() {
        const int bit = int(block_[size_t(at_ / 8)] >> (at_ % 8)) & 1;
        ++at_;
        return bit;
    }
    void operator()(int& field, int bits) {
        field = 0;
        for (int i = 0; i < bits; ++i) field |= take_bit() << i;
    }
    int at() const { return at_; }

  private:
    Block16 block_;
    int at_ = 0;
};

/// Puts fields into a block, in order.
class BlockWriter {
  public:
    void put_bit(int bit) {
        if (bit) block_[size_t(at_ / 8)] |= std::byte(1 << (at_ % 8));
        ++at_;
    }
    void operator()(const int& field, int bits) {
        for (int i = 0; i < bits; ++i) put_bit((field >> i) & 1);
    }
    int at() const { return at_; }
    const Block16& block() const { return block_; }

  private:
    Block16 block_{};
    int at_ = 0;
};

/// One bit at any place.
inline int block_bit(const Block16& block, int at) { return int(block[size_t(at / 8)] >> (at % 8)) & 1; }
inline void set_block_bit(Block16& block, int at) { block[size_t(at / 8)] |= std::byte(1 << (at % 8)); }

}  // namespace rawtexel::reference
