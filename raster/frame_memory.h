// Memory of frames in large pieces, which the next frame finds warm.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

namespace rawtexel::raster {

/// Hands out uninitialised memory that lives as long as this. Tasks take a slab each, use it from the front and give the rest back: one
/// lock per task. Slabs of frames that are gone are kept for those that follow.
class FrameMemory {
  public:
    static constexpr size_t kSlabBytes = size_t{4} << 20;

    struct Slab {
        std::byte* memory = nullptr;  ///< aligned to 64 bytes
        size_t bytes = 0;
    };

    FrameMemory() = default;
    ~FrameMemory();
    FrameMemory(const FrameMemory&) = delete;
    FrameMemory& operator=(const FrameMemory&) = delete;

    /// At least `bytes`, of which kSlabBytes may be asked for.
    Slab take(size_t bytes);
    /// What the task did not use, from any 64-byte boundary on.
    void give(const Slab& rest);

  private:
    std::mutex mutex_;
    std::vector<Slab> open_;
    std::vector<std::byte*> owned_;
};

}  // namespace rawtexel::raster
