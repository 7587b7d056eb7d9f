#include "shading/depth_tiles.h"
#include "shading/draw_state.h"
#include "shading/render.h"

#include <algorithm>

namespace rawtexel::shading {
namespace {

constexpr int kShadowMapSize = 4096;  // texels; 64 MiB of depth
constexpr int kShadowTileSize = 128;

/// Clip coordinates of raster from the map's texels: x right, y down, depth kept.
glm::mat4 clip_from_map(int size) {
    glm::mat4 clip(1.0f);
    clip[0][0] = 2.0f / float(size);
    clip[3][0] = -1.0f;
    clip[1][1] = -2.0f / float(size);
    clip[3][1] = 1.0f;
    return clip;
}

void copy_tile(const raster::TileVisibility& tile, int tile_x, int tile_y, ShadowMap& map) {
    const int x0 = tile_x * tile.tile_size, y0 = tile_y * tile.tile_size;
    const int columns = std::min(tile.tile_size, map.size - x0), rows = std::min(tile.tile_size, map.size - y0);
    for (int y = 0; y < rows; ++y)
        std::copy_n(&tile.depth[size_t(y) * size_t(tile.tile_size)], columns, &map.depth[size_t(y0 + y) * size_t(map.size) + size_t(x0)]);
}

std::shared_ptr<const ShadowMap> draw_shadow_map(const Scene& scene, const Light& light, Executor& executor) {
    const Bounds bounds = scene.bounds();
    if (!(bounds.radius() > 0.0f)) return nullptr;
    auto map = std::make_shared<ShadowMap>(make_shadow_frame(light.direction, bounds.center(), bounds.radius(), kShadowMapSize));
    map->depth.assign(size_t(map->size) * size_t(map->size), 0.0f);

    const DrawStates states = make_draw_states(scene, {});
    const std::vector<raster::Draw> draws = make_raster_draws(states, clip_from_map(map->size) * map->map_from_world, DrawPurpose::Shadow);
    const raster::FrameOptions options{.width = map->size, .height = map->size, .tile_size = kShadowTileSize};
    const raster::Frame frame(options, draws, parallel_for_of(executor));

    draw_depth_tiles(frame, states.draws, executor,
                     [&](int tile_x, int tile_y, const raster::TileVisibility& tile) { copy_tile(tile, tile_x, tile_y, *map); });
    return map;
}

}  // namespace

Lighting resolve_lighting(const Scene& scene, std::vector<Light> lights, float ambient, std::shared_ptr<const Environment> environment,
                          bool shadows, Executor& executor) {
    Lighting lighting{.lights = std::move(lights), .ambient = ambient, .environment = std::move(environment), .shadow = nullptr};
    if (!shadows) return lighting;
    // The light that casts shadows comes first; the others keep their order.
    const auto sun = std::find_if(lighting.lights.begin(), lighting.lights.end(),
                                  [](const Light& light) { return light.type == Light::Type::Directional; });
    if (sun == lighting.lights.end()) return lighting;
    std::rotate(lighting.lights.begin(), sun, sun + 1);
    lighting.shadow = draw_shadow_map(scene, lighting.lights.front(), executor);
    return lighting;
}

}  // namespace rawtexel::shading
