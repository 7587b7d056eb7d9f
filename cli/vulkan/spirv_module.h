// What a SPIR-V module says of itself, as far as running it as a port needs: no more of the language is understood here.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// Bindings of the contract (docs/porting.md): buffers, then an image for each kind of textures.
inline constexpr uint32_t kBufferBindings = 5, kFlatBinding = 5, kArrayBinding = 6, kCubeBinding = 7, kVolumeBinding = 8, kBindings = 9;

struct SpirvModule {
    std::vector<uint32_t> words;
    std::string entry_point;  ///< of the one compute shader
    uint32_t group_size = 1;  ///< invocations along x
    std::set<uint32_t> bindings;

    /// Whether it asks the device's own texture unit.
    bool samples_images() const { return !bindings.empty() && *bindings.rbegin() >= kBufferBindings; }
};

/// Throws scenes::InputError naming `path`: no SPIR-V, no compute shader or several, a workgroup that is not one row, bindings that the
/// contract has not (docs/porting.md).
SpirvModule parse_spirv(const std::string& path, std::span<const std::byte> bytes);

}  // namespace rawtexel::cli
