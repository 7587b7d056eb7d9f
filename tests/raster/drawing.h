// Meshes, sample points and whole-frame drawing for the tests of raster.
#pragma once

#include "tests/raster/dispatch.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace rawtexel::raster::testing {

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;

    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    Draw draw(const glm::mat4& clip_from_object) const;
};

/// Object space is (pixel x, pixel y, depth); exact where the extents are powers of two.
glm::mat4 clip_from_pixels(int width, int height);
/// Camera at the origin looking along -z, y up; infinite reversed depth.
glm::mat4 perspective(float focal, float aspect, float near_plane);

/// Uniform in [low, high).
float uniform(std::mt19937& random, float low, float high);
/// A turn about the origin, every axis and angle within reach.
glm::mat4 random_rotation(std::mt19937& random);

/// The sample points of one pass over a frame.
struct SamplePattern {
    SampleOffset frame;
    bool per_pixel = false;
    int radius = 0;  ///< of per-pixel offsets: odd multiples of 1/512 pixel less than this from the centre
    uint32_t seed = 0;

    SampleOffset at(int x, int y) const;
};
/// Centre, frame offsets and per-pixel offsets that stay in the pixel, and some that leave it by up to a pixel.
std::vector<SamplePattern> sample_patterns();
/// Support of all patterns above, pixels.
inline constexpr float kPatternRadius = 1.5f;

/// Of a square frame of `extent` pixels for those patterns.
FrameOptions square_frame(int extent);

/// By pixel of the frame: the winner's scene-order id and its depth.
struct Picture {
    std::vector<uint32_t> id;
    std::vector<float> depth;
    bool operator==(const Picture&) const = default;
};
Picture draw_frame(const Frame& frame, const SamplePattern& pattern, const CoveragePolicy& coverage);
Picture draw_frame(const Frame& frame, const SamplePattern& pattern);

/// Draws the frame twice, the second time so that blocks may be left unwritten, and fails the test where anything differs. Returns how many
/// blocks were left that show a triangle.
uint64_t expect_left_blocks_agree(const Frame& frame, const SamplePattern& pattern, const CoveragePolicy& coverage);

/// By pixel: how many different triangles ask for coverage when none ever covers. All draws must be masked or blended.
std::vector<int> count_candidates(const Frame& frame, const SamplePattern& pattern);

/// Tasks in a scrambled order on several threads.
ParallelFor threaded_for(int threads);

}  // namespace rawtexel::raster::testing
