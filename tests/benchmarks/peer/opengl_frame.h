// The same frame by software OpenGL (Mesa's llvmpipe), headless, into 8-bit sRGB.
#pragma once

#include "shading/image.h"
#include "tests/benchmarks/peer/peer_setting.h"

#include <memory>
#include <string>

namespace rawtexel::peer {

/// A scene on the other side: buffers, textures and programs are made once, frames are drawn from them. BLEND is drawn as MASK is, at 0.5;
/// planes and layers that blend are drawn as their material's own maps.
class OpenglFrame {
  public:
    virtual ~OpenglFrame() = default;
    /// "llvmpipe, Mesa …"
    virtual std::string name() const = 0;
    /// Draws frame number `frame`, which seeds what is drawn at random, and waits until it is there.
    virtual void draw(int frame) = 0;
    /// The last frame: linear, 0 to 1, upper row first.
    virtual shading::Image read() const = 0;
};

/// Null where there is no software OpenGL 4.5, with the reason. `scene` outlives the call alone. Throws std::runtime_error where OpenGL
/// refuses what it is given.
std::unique_ptr<OpenglFrame> make_opengl_frame(const shading::Scene& scene, const Setting& setting, std::string& why_not);

}  // namespace rawtexel::peer
