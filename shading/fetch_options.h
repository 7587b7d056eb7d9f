// Which fetches of a frame are counted, and how closely.
#pragma once

#include "texunit/cache_spec.h"

#include <optional>
#include <string_view>

namespace rawtexel::texunit {
class FetchTraceWriter;
}

namespace rawtexel::shading {

/// Which fragments ask for texels.
///
/// visible: what rawtexel shades. Of every sample the surface that is seen asks for all its maps; MASK and BLEND surfaces before it that
///   let it through ask for their base colour.
/// forward: a renderer that draws opaque surfaces, then the others, each in scene order, with a depth test before shading. Every fragment
///   that passes it asks for all maps; for its base colour alone where alpha then discards it.
/// quad: forward on aligned 2x2 quads, as GPUs run: where one fragment of a triangle asks, its quad's four lanes do, beyond the triangle's
///   edge with coordinates of its plane.
enum class FetchModel { Visible, Forward, Quad };
std::string_view to_string(FetchModel model);  // visible forward quad
std::optional<FetchModel> parse_fetch_model(std::string_view text);

struct FetchOptions {
    bool count = false;  ///< totals per texture and level
    FetchModel model = FetchModel::Visible;
    bool pixel_texels = false;  ///< FrameFetches::pixels of texels_requested
    bool pixel_lines = false;   ///< of lines_pixel
    bool pixel_layers = false;  ///< of everything
    std::optional<texunit::CacheSpec> cache;
    texunit::FetchTraceWriter* trace = nullptr;  ///< gets the frame's fetches, from its first to its last

    /// Whether fetches have to be seen in canonical order: tiles are then 64x64 whatever the tile size asked for.
    bool needs_order() const { return pixel_layers || cache || trace != nullptr; }
    bool counts() const { return count || pixel_texels || pixel_lines || needs_order(); }
};

}  // namespace rawtexel::shading
