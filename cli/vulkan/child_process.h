// Work that may die or hang, in a process of its own: drivers crash on shaders that are damaged, and take nothing else with them.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

namespace rawtexel::cli {

struct ChildOutcome {
    enum class End { Returned, Died, Hung };
    End end = End::Returned;
    int signal = 0;                ///< of which it died
    std::vector<std::byte> bytes;  ///< what the work returned; empty unless it did
};

/// Runs `work`, which throws nothing, in a copy of this process and hands back what it returned. What it prints is dropped. A child that
/// takes longer than `patience` is killed; it dies with its parent. Throws std::system_error where there is no process to be had.
ChildOutcome run_in_child(const std::function<std::vector<std::byte>()>& work, std::chrono::milliseconds patience);

}  // namespace rawtexel::cli
