#include "cli/counters.h"

#include <array>

namespace rawtexel::cli {
namespace {

constexpr std::array kCounters{
    CounterInfo{"image.width", "pixels of the image written"},
    CounterInfo{"image.height", "pixels of the image written"},
    CounterInfo{"image.spp", "samples per pixel"},
    CounterInfo{"image.mean_spp", "of --adaptive: samples per pixel, the mean over the image"},
    CounterInfo{"image.samples_shaded", "samples that saw a surface; the background is left out"},
    CounterInfo{"frame_s.min", "wall seconds of the fastest frame, geometry to resolved image"},
    CounterInfo{"frame_s.median", "wall seconds of the median frame"},
    CounterInfo{"frame_s.n", "frames timed (--repeat)"},
    CounterInfo{"time_s.load", "wall seconds until the first frame: scene, environment, shadow map"},
    CounterInfo{"time_s.geometry", "wall seconds: transform, clip, set up, bin"},
    CounterInfo{"time_s.raster", "seconds of visibility, summed over threads"},
    CounterInfo{"time_s.shade", "seconds of lookups and shading, summed over threads"},
    CounterInfo{"time_s.write", "wall seconds: display transform, encoding, file"},
    CounterInfo{"time_s.total", "wall seconds of the whole run"},
    CounterInfo{"memory_bytes.peak_rss", "most memory resident at any time"},
    CounterInfo{"memory_bytes.textures_stored", "bytes of the textures as their files hold them"},
    CounterInfo{"memory_bytes.textures_decoded", "bytes of the blocks decoded or generated"},
    CounterInfo{"geometry.triangles", "triangles of the scene, over all instances"},
    CounterInfo{"geometry.culled_frustum", "triangles outside the view"},
    CounterInfo{"geometry.culled_backface", "triangles seen from behind"},
    CounterInfo{"geometry.culled_degenerate", "triangles without area after snapping"},
    CounterInfo{"geometry.culled_small", "triangles between all points that the pixel filter may sample"},
    CounterInfo{"geometry.culled_unsampled", "triangles between the points that this frame samples"},
    CounterInfo{"geometry.culled_occluded", "triangles of clusters behind what large opaque clusters cover"},
    CounterInfo{"geometry.culled_nonfinite", "triangles with a vertex that is not a number"},
    CounterInfo{"geometry.clipped", "triangles cut by the near plane or the guard band"},
    CounterInfo{"geometry.binned", "triangles that reached a tile"},
    CounterInfo{"geometry.tiles", "tiles of the image"},
    CounterInfo{"geometry.tiles_empty", "tiles without a triangle"},
    CounterInfo{"geometry.hiz_rejected", "triangles or blocks hidden by what a tile holds already"},
    CounterInfo{"texture.lookups", "maps asked at shading points (--count)"},
    CounterInfo{"texture.taps", "taps weighed (--count)"},
    CounterInfo{"texture.texels_requested", "texel reads, with repeats (--count)"},
    CounterInfo{"texture.texels_per_sample", "texels_requested over samples_shaded (--count)"},
    CounterInfo{"texture.texels_unique", "distinct texels of the frame, over textures, levels and layers (--count, as all that follow)"},
    CounterInfo{"texture.blocks_touched", "distinct 4x4 blocks"},
    CounterInfo{"texture.lines_32", "distinct 32-byte lines of decoded texels, in 4x4 blocks"},
    CounterInfo{"texture.lines_64", "the same of 64 bytes"},
    CounterInfo{"texture.lines_128", "the same of 128 bytes"},
    CounterInfo{"texture.lines_stored_32", "distinct 32-byte lines of the file's own blocks or texels, row after row"},
    CounterInfo{"texture.lines_stored_64", "the same of 64 bytes"},
    CounterInfo{"texture.lines_stored_128", "the same of 128 bytes"},
    CounterInfo{"texture.bytes_decoded", "64 * lines_64"},
    CounterInfo{"texture.bytes_stored", "64 * lines_stored_64"},
    CounterInfo{"texture.overfetch", "bytes_decoded over the bytes of the distinct texels"},
    CounterInfo{"texture.layouts.LAYOUT.decoded", "lines of decoded texels lying linear, morton, tiled-4k or tiled-64k"},
    CounterInfo{"texture.layouts.LAYOUT.stored", "lines of the file's blocks or texels lying so"},
    CounterInfo{"texture.cache.l1_hits", "texel reads that the modelled first-level cache held (--cache, as all of texture.cache)"},
    CounterInfo{"texture.cache.l1_misses", "texel reads that it did not; both sum to texels_requested"},
    CounterInfo{"texture.cache.l2_hits", "first-level misses that the second level held"},
    CounterInfo{"texture.cache.l2_misses", "first-level misses that it did not"},
    CounterInfo{"texture.cache.compulsory", "first-level misses of what was never there"},
    CounterInfo{"texture.cache.capacity", "first-level misses that a fully associative cache of the size would have too"},
    CounterInfo{"texture.cache.conflict", "the other first-level misses"},
    CounterInfo{"texture.performed.blocks_decoded", "4x4 blocks read from files or generators"},
    CounterInfo{"texture.performed.blocks_decoded_mips", "4x4 blocks of levels made from finer ones"},
    CounterInfo{"textures[].blocks_total", "4x4 blocks of all levels of one texture; the keys of texture follow"},
    CounterInfo{"textures[].per_level[]", "of each level its number, width and height; texels_requested and the keys after it follow"},
};

}  // namespace

std::span<const CounterInfo> all_counters() { return kCounters; }

}  // namespace rawtexel::cli
