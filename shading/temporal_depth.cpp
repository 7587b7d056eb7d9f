#include "shading/temporal_depth.h"

#include "shading/camera.h"
#include "shading/depth_tiles.h"
#include "shading/draw_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::shading {
namespace {

constexpr int kDepthTile = 64;  // pixels

/// The inverse of clip_from_world's third row, for what is not at infinity.
float view_distance(const Camera& camera, float depth) {
    const float near = camera.znear, far = camera.zfar;
    if (camera.type == Camera::Type::Orthographic) return far - depth * (far - near);
    if (far <= 0.0f) return near / depth;
    return near * far / (depth * (far - near) + near);
}

void put_distances(const raster::TileVisibility& tile, const Camera& camera, int tile_x, int tile_y, Image& image) {
    const int x0 = tile_x * tile.tile_size, y0 = tile_y * tile.tile_size;
    const int columns = std::min(tile.tile_size, image.width - x0), rows = std::min(tile.tile_size, image.height - y0);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const size_t i = size_t(y) * size_t(tile.tile_size) + size_t(x);
            if (tile.triangle[i] != raster::kNoTriangle) *image.pixel(x0 + x, y0 + y) = view_distance(camera, tile.depth[i]);
        }
}

}  // namespace

Image center_depth(const Scene& scene, const Camera& camera, int width, int height, Executor& executor) {
    const DrawStates states = make_draw_states(scene, {});
    const float aspect = float(width) / float(height);
    const std::vector<raster::Draw> draws = make_raster_draws(states, clip_from_world(camera, aspect), DrawPurpose::Camera);
    const raster::FrameOptions options{.width = width, .height = height, .tile_size = kDepthTile};
    const raster::Frame frame(options, draws, parallel_for_of(executor));

    Image image(width, height, 1);
    std::ranges::fill(image.values, std::numeric_limits<float>::infinity());
    draw_depth_tiles(frame, states.draws, executor, [&](int tile_x, int tile_y, const raster::TileVisibility& tile) {
        put_distances(tile, camera, tile_x, tile_y, image);
    });
    return image;
}

FrameProjection::FrameProjection(const Camera& camera, int width, int height)
    : perspective_(camera.type == Camera::Type::Perspective),
      half_pixels_(0.5 * width, 0.5 * height),
      half_extent_(camera.xmag, camera.ymag),
      world_from_camera_(camera.world_from_camera),
      camera_from_world_(glm::inverse(world_from_camera_)) {
    if (!perspective_) return;
    const double half_height = std::tan(0.5 * double(camera.vertical_fov));
    half_extent_ = {half_height * width / height, half_height};
}

/// Position at distance 1 along the view axis, in the camera's space.
glm::dvec3 FrameProjection::camera_ray(const glm::dvec2& pixel) const {
    const glm::dvec2 at = (pixel / half_pixels_ - 1.0) * half_extent_;
    return {at.x, -at.y, -1.0};
}

FrameProjection::Point FrameProjection::project_camera(const glm::dvec3& position) const {
    const double depth = -position.z;
    const glm::dvec2 at = glm::dvec2(position.x, -position.y) / (perspective_ ? depth : 1.0);
    return {(at / half_extent_ + 1.0) * half_pixels_, depth};
}

glm::dvec3 FrameProjection::world(const glm::dvec2& pixel, double depth) const {
    const glm::dvec3 ray = camera_ray(pixel);
    const glm::dvec3 position = perspective_ ? ray * depth : glm::dvec3(ray.x, ray.y, -depth);
    return glm::dvec3(world_from_camera_ * glm::dvec4(position, 1.0));
}

FrameProjection::Point FrameProjection::project(const glm::dvec3& world) const {
    return project_camera(glm::dvec3(camera_from_world_ * glm::dvec4(world, 1.0)));
}

glm::dvec3 FrameProjection::direction(const glm::dvec2& pixel) const {
    return glm::dvec3(world_from_camera_ * glm::dvec4(perspective_ ? camera_ray(pixel) : glm::dvec3(0.0, 0.0, -1.0), 0.0));
}

FrameProjection::Point FrameProjection::project_direction(const glm::dvec3& direction) const {
    const glm::dvec3 in_camera(camera_from_world_ * glm::dvec4(direction, 0.0));
    // Parallel rays see one point of what is infinitely far, in every pixel.
    if (!perspective_) return {half_pixels_, 1.0};
    return {project_camera(in_camera).pixel, in_camera.z < 0.0 ? 1.0 : 0.0};
}

}  // namespace rawtexel::shading
