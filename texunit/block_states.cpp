#include "texunit/block_states.h"

#include "texunit/texel_source.h"

namespace rawtexel::texunit {
namespace {

uint64_t groups_of(uint64_t blocks) { return (blocks + BlockStates::kGroup - 1) / BlockStates::kGroup; }
uint64_t bit_of(int32_t block) { return uint64_t{1} << (block % BlockStates::kGroup); }

}  // namespace

// Zeroed memory is the initial state of every block; the integers are implicitly created by the mapping and used through atomic_ref only.
BlockStates::BlockStates(uint64_t blocks)
    : ready_memory_(groups_of(blocks) * sizeof(uint64_t)),
      progress_memory_(groups_of(blocks) * sizeof(Progress)),
      ready_(reinterpret_cast<uint64_t*>(ready_memory_.data())),
      progress_(reinterpret_cast<Progress*>(progress_memory_.data())) {}

bool BlockStates::claim(int32_t block) {
    std::atomic_ref claimed(progress_[block / kGroup].claimed);
    return (claimed.fetch_or(bit_of(block), std::memory_order_relaxed) & bit_of(block)) == 0;
}

void BlockStates::publish(int32_t block) {
    std::atomic_ref(ready_[block / kGroup]).fetch_or(bit_of(block), std::memory_order_release);
    settle(block);
}

void BlockStates::fail(int32_t block, const std::string& reason) {
    {
        const std::lock_guard lock(reasons_mutex_);
        reasons_.emplace(block, reason);
    }
    settle(block);
}

void BlockStates::settle(int32_t block) {
    std::atomic_ref settled(progress_[block / kGroup].settled);
    settled.fetch_or(bit_of(block), std::memory_order_release);
    settled.notify_all();
}

void BlockStates::wait(int32_t block) const {
    std::atomic_ref settled(progress_[block / kGroup].settled);
    for (uint64_t seen = settled.load(std::memory_order_acquire); (seen & bit_of(block)) == 0;
         seen = settled.load(std::memory_order_acquire)) {
        settled.wait(seen, std::memory_order_acquire);
    }
    if ((ready(block / kGroup) & bit_of(block)) != 0) return;
    const std::lock_guard lock(reasons_mutex_);
    throw TextureError(reasons_.at(block));
}

}  // namespace rawtexel::texunit
