#include "scenes/procedural_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

int wrapped(int i, int period) {
    if (i >= 0 && i < period) {
        return i;  // nearly always: a division costs more than the rest of a lattice look-up
    }
    const int r = i % period;
    return r < 0 ? r + period : r;
}

/// floor, as inlined conversions on every target.
int floor_int(float v) {
    const int i = int(v);
    return i - int(float(i) > v);
}

/// A lattice square, its corners wrapped to the period, and where in it the point lies.
struct Square {
    int x0, y0, x1, y1;
    glm::vec2 fraction;
};

Square square_of(glm::vec2 p, glm::ivec2 period) {
    const int x = floor_int(p.x), y = floor_int(p.y);
    return {wrapped(x, period.x), wrapped(y, period.y), wrapped(x + 1, period.x), wrapped(y + 1, period.y), p - glm::vec2(x, y)};
}

glm::vec2 quintic(glm::vec2 t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

float bilinear(glm::vec2 t, float v00, float v10, float v01, float v11) {
    return glm::mix(glm::mix(v00, v10, t.x), glm::mix(v01, v11, t.x), t.y);
}

/// The dot product of `offset` with one of eight unit gradients.
float gradient_ramp(uint32_t bits, glm::vec2 offset) {
    constexpr float kDiagonal = 0.70710678f;
    static constexpr std::array<glm::vec2, 8> kGradients{
        glm::vec2{1, 0},         {-1, 0}, {0, 1}, {0, -1}, {kDiagonal, kDiagonal}, {-kDiagonal, kDiagonal}, {kDiagonal, -kDiagonal},
        {-kDiagonal, -kDiagonal}};
    return glm::dot(kGradients[bits >> 29], offset);
}

}  // namespace

uint32_t lattice_bits(int x, int y, uint32_t seed) {
    // Two odd multipliers spread the coordinates; the finaliser is the one of MurmurHash3.
    uint32_t h = uint32_t(x) * 0x9E3779B1u + uint32_t(y) * 0x85EBCA77u + seed * 0xC2B2AE3Du;
    h = (h ^ (h >> 16)) * 0x85EBCA6Bu;
    h = (h ^ (h >> 13)) * 0xC2B2AE35u;
    return h ^ (h >> 16);
}

float lattice_float(int x, int y, uint32_t seed) { return float(lattice_bits(x, y, seed) >> 8) * 0x1p-24f; }

float value_noise(glm::vec2 p, glm::ivec2 period, uint32_t seed) {
    const Square s = square_of(p, period);
    return bilinear(quintic(s.fraction), lattice_float(s.x0, s.y0, seed), lattice_float(s.x1, s.y0, seed), lattice_float(s.x0, s.y1, seed),
                    lattice_float(s.x1, s.y1, seed));
}

float gradient_noise(glm::vec2 p, glm::ivec2 period, uint32_t seed) {
    const Square s = square_of(p, period);
    const glm::vec2 f = s.fraction;
    const float noise = bilinear(quintic(f), gradient_ramp(lattice_bits(s.x0, s.y0, seed), f),
                                 gradient_ramp(lattice_bits(s.x1, s.y0, seed), f - glm::vec2(1, 0)),
                                 gradient_ramp(lattice_bits(s.x0, s.y1, seed), f - glm::vec2(0, 1)),
                                 gradient_ramp(lattice_bits(s.x1, s.y1, seed), f - glm::vec2(1, 1)));
    constexpr float kToUnit = 1.41421356f;  // the largest value of unit gradients is sqrt(1/2)
    return noise * kToUnit;
}

float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, uint32_t seed) {
    float sum = 0.0f, weight = 1.0f, total = 0.0f;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * gradient_noise(p, period, seed + uint32_t(octave));
        total += weight;
        weight *= 0.5f;
        p *= 2.0f;
        period *= 2;
    }
    return sum / total;
}

float swatch_noise(glm::vec2 p, int frequency, int octaves, uint32_t seed) {
    return fractal_noise(p * float(frequency), glm::ivec2(frequency), octaves, seed);
}

float random_part(uint32_t id, int shift) { return float(id >> shift & 0xFFu) / 256.0f; }

CellPoint cells(glm::vec2 p, glm::ivec2 period, float jitter, uint32_t seed) {
    const glm::ivec2 base(floor_int(p.x), floor_int(p.y));
    const glm::vec2 fraction = p - glm::vec2(base);
    std::array<glm::vec2, 25> to_center;  // from the point to each candidate's centre
    std::array<float, 25> squared;
    size_t nearest = 0;
    uint32_t nearest_id = 0;
    for (int i = 0; i < 25; ++i) {
        const int dx = i % 5 - 2, dy = i / 5 - 2;
        const int x = wrapped(base.x + dx, period.x), y = wrapped(base.y + dy, period.y);
        const uint32_t id = lattice_bits(x, y, seed);
        const glm::vec2 random(float(id & 0xFFFFu) * 0x1p-16f, float(id >> 16) * 0x1p-16f);
        to_center[size_t(i)] = glm::vec2(dx, dy) + 0.5f + jitter * (random - 0.5f) - fraction;
        squared[size_t(i)] = glm::dot(to_center[size_t(i)], to_center[size_t(i)]);
        if (i == 0 || squared[size_t(i)] < squared[nearest]) {
            nearest = size_t(i);
            nearest_id = id;
        }
    }
    // The border with a neighbour is the bisector of the two centres.
    float edge = 1e9f;
    for (size_t i = 0; i < 25; ++i) {
        if (i != nearest) {
            const float separation = glm::length(to_center[i] - to_center[nearest]);
            edge = std::min(edge, (squared[i] - squared[nearest]) / (2.0f * separation));
        }
    }
    return {-to_center[nearest], edge, nearest_id};
}

float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

}  // namespace rawtexel::scenes
