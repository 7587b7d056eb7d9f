// Which blocks of a texture are there. Every block goes once from claimed to ready or failed: one thread takes it there, the others wait.
#pragma once

#include "texunit/reserved_memory.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

namespace rawtexel::texunit {

/// Blocks are kept in groups of 64 consecutive numbers, one bit each, so a wave asks for its neighbourhood with one load.
class BlockStates {
  public:
    static constexpr int kGroup = 64;

    explicit BlockStates(uint64_t blocks);

    /// Bit b: block 64*group + b is ready. What its maker wrote is visible to whoever sees the bit.
    uint64_t ready(int32_t group) const { return std::atomic_ref(ready_[group]).load(std::memory_order_acquire); }

    /// True for exactly one caller, who must then call `publish` or `fail`.
    bool claim(int32_t block);
    void publish(int32_t block);
    void fail(int32_t block, const std::string& reason);

    /// Sleeps until a claimed block is ready. Throws TextureError with the maker's reason when it failed.
    void wait(int32_t block) const;

  private:
    // Kept apart from the ready bits, which alone are read when all is well. Settled: ready or failed.
    struct Progress {
        uint64_t claimed, settled;
    };
    void settle(int32_t block);

    ReservedMemory ready_memory_, progress_memory_;
    uint64_t* ready_;
    Progress* progress_;
    mutable std::mutex reasons_mutex_;
    std::unordered_map<int32_t, std::string> reasons_;
};

}  // namespace rawtexel::texunit
