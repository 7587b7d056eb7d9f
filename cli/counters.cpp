#include "cli/counters.h"

#include <array>

namespace rawtexel::cli {
namespace {

constexpr std::array kCounters{
    CounterInfo{"image.width", "pixels of the image written"},
    CounterInfo{"image.height", "pixels of the image written"},
    CounterInfo{"image.spp", "samples per pixel"},
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
    CounterInfo{"geometry.culled_small", "triangles that no sample point can hit"},
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
    CounterInfo{"texture.texels_unique", "distinct texels among them, each counted once a frame"},
    CounterInfo{"texture.blocks_touched", "distinct 4x4 blocks that hold them"},
    CounterInfo{"texture.lines_64", "distinct 64-byte lines of the decoded layout"},
    CounterInfo{"texture.bytes_decoded", "64 times that"},
    CounterInfo{"texture.lines_stored_64", "distinct 64-byte lines of the blocks as files store them"},
    CounterInfo{"texture.bytes_stored", "64 times that"},
    CounterInfo{"texture.overfetch", "bytes_decoded over the bytes of the unique texels"},
    CounterInfo{"texture.cache.l1_hits", "texel reads that the first cache level answers; with l1_misses all of texels_requested"},
    CounterInfo{"texture.cache.l1_misses", "texel reads that go on to the second level"},
    CounterInfo{"texture.cache.l2_hits", "of those, answered by the second level"},
    CounterInfo{"texture.cache.l2_misses", "of those, going on to memory"},
    CounterInfo{"texture.cache.compulsory", "misses of lines never read before"},
    CounterInfo{"texture.cache.capacity", "misses that a fully associative cache of the same size has too"},
    CounterInfo{"texture.cache.conflict", "the other misses: lines that crowd in one set"},
    CounterInfo{"texture.performed.blocks_decoded", "4x4 blocks read from files or generators"},
    CounterInfo{"texture.performed.blocks_decoded_mips", "4x4 blocks of levels made from finer ones"},
    CounterInfo{"texture.performed.lookups_skipped", "lookups that no shading needed"},
    CounterInfo{"textures[].blocks_total", "4x4 blocks of all levels of one texture; the keys of texture follow"},
};

}  // namespace

std::span<const CounterInfo> all_counters() { return kCounters; }

}  // namespace rawtexel::cli
