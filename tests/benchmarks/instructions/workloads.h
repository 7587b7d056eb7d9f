// Small pieces of work whose instructions are counted.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::instructions {

/// The same work at every call of what `prepare` returns, on the calling thread alone.
struct Workload {
    std::string name;
    std::string_view unit;  ///< of what a call does `units` times, in the singular
    int64_t units;
    /// Whatever is not to be counted: textures, scenes, meshes.
    std::function<std::function<void()>()> prepare;
};

/// Lookups, decoding, raster stages, and a frame of every built-in scene.
std::vector<Workload> all_workloads();

}  // namespace rawtexel::instructions
