// Other samplers asked for the same lookups: OpenImageIO's TextureSystem, and OpenGL on llvmpipe.
#pragma once

#include "tests/reference/texunit/sampler_reference.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rawtexel::tools {

/// One channel of a square texture with all its levels, 16-bit codes.
struct Pyramid {
    int extent = 0;
    std::vector<std::vector<uint16_t>> level;
};

/// The red channel of a square image, codes over their range.
std::vector<double> read_red_channel(const std::string& path, int extent);

/// Repeats; anisotropic up to `probes`. Values in [0, 1].
class PeerSampler {
  public:
    virtual ~PeerSampler() = default;
    virtual std::string name() const = 0;
    /// Derivatives are multiplied by `scale`.
    virtual std::vector<double> look_up(const std::vector<texunit::reference::Lookup>& lookups, double scale) = 0;
};

/// Writes the texture as a tiled file of its own in `folder`.
std::unique_ptr<PeerSampler> make_texture_system_sampler(const Pyramid& pyramid, int probes, const std::string& folder);
/// Null when there is no software OpenGL 4.3 without a display.
std::unique_ptr<PeerSampler> make_opengl_sampler(const Pyramid& pyramid, int probes);

}  // namespace rawtexel::tools
