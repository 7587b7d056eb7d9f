// Everything behind one pixel, as data: of each sample the surfaces, their lookups, the light and the radiance.
#pragma once

#include "raster/sample_grid.h"
#include "shading/light_terms.h"
#include "shading/pixel_sampling.h"
#include "shading/scene.h"
#include "texunit/lookup_trace.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// Where a map of a material was looked up. texunit::trace_lookup tells the taps and the value.
struct ExplainedLookup {
    shading::MapSlot slot{};
    texunit::Texture* texture = nullptr;
    texunit::SamplerState sampler;
    texunit::LaneCoordinates at;
    bool drawn = false;  ///< texels are drawn from its taps, or shaded one by one
};

struct ExplainedTriangle {
    uint32_t id = 0;         ///< in scene order
    uint32_t instance = 0;   ///< in Scene::instances
    uint32_t primitive = 0;  ///< triangle of the instance's mesh
    const shading::Mesh* mesh = nullptr;
    uint32_t material_index = 0;
    const shading::Material* material = nullptr;
    bool front = true;  ///< whether the front face is seen
};

/// Whether a MASK or BLEND surface covers a sample: alpha at least the cutoff, or above a random number. Where raw texels decide, of MASK
/// surfaces too it is the share of them that covers, held against a number.
struct AlphaVerdict {
    float alpha = 0;
    float threshold = 0;          ///< cutoff, or the number
    uint32_t random_surface = 0;  ///< the surface in the number's address (texunit/random.h); 0: a cutoff
    bool covers = false;
};

/// A MASK or BLEND surface before what is seen, which lets it through.
struct ExplainedCandidate {
    ExplainedTriangle triangle;
    float depth = 0;  ///< raster::TileVisibility: 1 near .. 0 far
    AlphaVerdict verdict;
    std::optional<ExplainedLookup> lookup;  ///< of the base colour
};

/// A texel drawn, or listed, for one map.
struct ExplainedTexel {
    shading::MapSlot slot{};
    int level = 0, x = 0, y = 0;
    bool border = false;
    glm::vec4 value{0.0f};  ///< linear
    float weight = 1;       ///< in the map's value, where it is averaged with others before shading
};

/// What a tap was drawn with; without numbers where all taps are listed.
struct ExplainedNumbers {
    float x = 0, y = 0, level = 0, probe = 0, sign = 0;
};

/// Of a lit material; an unlit one has a base colour and no more.
struct ExplainedReflection {
    float metallic = 0, roughness = 0, occlusion = 1;
    glm::vec3 emission{0.0f};
    std::vector<shading::LightTerm> light;  ///< adds up to the radiance
};

/// One of several taps whose light is added up.
struct ExplainedTap {
    float weight = 1;
    std::optional<float> alpha;  ///< where the texel decides what it covers
    std::vector<ExplainedTexel> texels;
    std::optional<ExplainedNumbers> numbers;
    glm::vec3 base_color{0.0f}, normal{0.0f};
    std::optional<ExplainedReflection> reflection;
    glm::vec3 radiance{0.0f};
};

/// A number that something was drawn with at a surface, other than its taps.
struct ExplainedNumber {
    std::string_view dimension;  ///< the role in its address: "plane", "layer", "light", …
    float number = 0;
};

/// What is seen. Where raw texels are shaded `taps` tell what its surface is made of and its radiance: the sum of weight*radiance over taps
/// of positive weight, divided by the part of those weights that covers, plus that over the others (shading/tap_sum-inl.h).
struct ExplainedSurface {
    ExplainedTriangle triangle;
    std::optional<AlphaVerdict> verdict;  ///< of MASK and BLEND
    glm::vec3 barycentrics{0.0f};
    glm::vec3 position{0.0f};  ///< world, metres
    float distance = 0;        ///< along the view axis, metres
    glm::vec3 normal{0.0f}, geometric_normal{0.0f};
    std::optional<glm::vec4> vertex_color;
    glm::vec3 base_color{0.0f};
    std::vector<ExplainedNumber> numbers;
    std::vector<ExplainedLookup> lookups;  ///< in the order of the maps
    std::vector<ExplainedTexel> averaged;  ///< drawn for some of them, averaged before shading
    std::vector<ExplainedTap> taps;
    /// Planes or layers that are blended. Where they are blended before they are lit the surface itself tells of the blend and its light;
    /// else its radiance is the sum of weight*radiance over them.
    std::vector<ExplainedSurface> branches;
    float weight = 1;                   ///< of a branch
    std::optional<glm::vec3> radiance;  ///< of a branch that is lit
    std::optional<ExplainedReflection> reflection;
};

struct ExplainedSample {
    uint32_t sample = 0;
    raster::SampleOffset offset;
    shading::SequenceShift shift;                 ///< the random part of the offset, the same for all samples
    std::vector<ExplainedCandidate> let_through;  ///< the nearest first
    std::optional<ExplainedSurface> surface;      ///< nullopt: the background
    glm::vec3 radiance{0.0f};
};

/// What is asked about.
struct ExplainedPixel {
    std::string scene, camera;  ///< as given; options that choose the same camera
    int width = 0, height = 0;  ///< of the frame
    int x = 0, y = 0;
    int spp = 1;
    shading::PixelFilter pixel_filter = shading::PixelFilter::Box;
    shading::PixelJitter pixel_jitter = shading::PixelJitter::Frame;
    uint32_t seed = 0;
};

/// Where all samples lead.
struct ExplainedMean {
    glm::vec3 mean{0.0f};            ///< of the samples' radiance, as shading::SampleTree adds them
    glm::vec3 rendered{0.0f};        ///< the pixel of a plain render
    std::array<uint8_t, 3> codes{};  ///< that files of 8 bits hold
    std::string display;             ///< the options that made them
};

/// Whether both have the same bits.
bool same_bits(const glm::vec3& a, const glm::vec3& b);

/// "base colour", "metallic and roughness", "normal", "occlusion", "emission"; "mask of layers".
std::string_view name_of(shading::MapSlot slot);

}  // namespace rawtexel::cli
