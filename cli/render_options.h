// What a user can ask of a render: plain data with defaults, and the options of the command line that set it.
// Shared by every command that renders.
#pragma once

#include "cli/command_line.h"
#include "cli/fetch_options.h"
#include "cli/lookup_options.h"
#include "cli/progress.h"
#include "cli/sequence_options.h"
#include "cli/skip_options.h"
#include "shading/display.h"
#include "shading/render.h"
#include "texunit/simd.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

struct ImageSize {
    int width = 1280, height = 720;  ///< pixels, 1..kMaxImageExtent
    bool operator==(const ImageSize&) const = default;
};

struct Orbit {
    float yaw = 0.0f, pitch = 0.0f;  ///< degrees, within kMaxAngle
    float zoom = 1.0f;               ///< kMinZoom to kMaxZoom; 1: the scene just fits
    bool operator==(const Orbit&) const = default;
};

/// Unset members are what the scene says, or the default view.
struct ViewOptions {
    std::optional<std::string> camera;  ///< name or index
    std::optional<Orbit> orbit;
    std::optional<glm::vec3> eye, target;
    std::optional<float> fov;  ///< vertical, degrees, between 0 and 180
};

/// A directional light.
struct SunOption {
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< the way the light travels, any length but 0
    float intensity = 3.0f;                  ///< lux: 3 shows a white diffuse surface that faces it at 0.95
    bool operator==(const SunOption&) const = default;
};

enum class EnvironmentKind { Sky, None, File };

struct EnvironmentOption {
    EnvironmentKind kind = EnvironmentKind::None;
    std::string file;
    bool operator==(const EnvironmentOption&) const = default;
};

struct LightOptions {
    std::optional<SunOption> light;                ///< unset: the file's lights
    std::optional<float> ambient;                  ///< unset: 0
    std::optional<bool> shadows;                   ///< unset: on
    std::optional<EnvironmentOption> environment;  ///< unset: the sky where the file has no lights
    shading::EnvironmentReflections reflections = shading::EnvironmentReflections::Prefiltered;
    std::optional<glm::vec3> background;  ///< unset: the environment
    bool peer_shading = false;
};

struct SampleOptions {
    int spp = 1;
    shading::PixelFilter pixel_filter = shading::PixelFilter::Box;
    shading::PixelJitter pixel_jitter = shading::PixelJitter::Frame;
    uint32_t seed = 0;
    std::optional<float> adaptive;   ///< the standard error at which a block of pixels takes no more samples
    std::optional<float> reference;  ///< the standard error at which the truth is good enough
};

struct ToneOptions {
    std::optional<float> exposure;              ///< EV; unset: 0
    std::optional<shading::ToneMap> tone_map;   ///< unset: ACES
    std::optional<shading::Transfer> transfer;  ///< unset: sRGB
    /// White is what shows where nothing is, laid under the image after the tone map, which would dim it.
    bool white_backdrop = false;
};

struct MachineOptions {
    int threads = 0;  ///< 0: all cores
    int tile_size = 64;
    texunit::Simd simd = texunit::Simd::Auto;
    ProgressMode progress = ProgressMode::Auto;
    SkipRequest skips;
};

struct RenderRequest {
    std::optional<ImageSize> size;  ///< unset: 1280x720
    shading::Crop crop;
    ViewOptions view;
    LightOptions light;
    LookupOptions lookup;
    std::string policy;  ///< a file of policies; empty: none
    SampleOptions samples;
    SequenceOptions sequence;  ///< of `render` alone
    ToneOptions tone;
    FetchRequest fetches;
    MachineOptions machine;

    ImageSize image_size() const { return size.value_or(ImageSize{}); }
};

// The readers throw UsageError where the text is not of the form shown or leaves its range (cli/limits.h).
ImageSize parse_size(std::string_view text);  // 1280x720
std::string print(const ImageSize& size);
shading::Crop parse_crop(std::string_view text);  // X,Y,W,H
std::string print(const shading::Crop& crop);
Orbit parse_orbit(std::string_view text);  // YAW,PITCH[,ZOOM]
std::string print(const Orbit& orbit);
SunOption parse_light(std::string_view text);  // X,Y,Z[,I]
std::string print(const SunOption& light);
EnvironmentOption parse_environment(std::string_view text);  // sky none FILE
std::string print(const EnvironmentOption& environment);
std::optional<glm::vec3> parse_background(std::string_view text);  // environment R,G,B
std::vector<shading::Aov> parse_aovs(std::string_view text);       // depth,normal,…

/// Declares the options that say how textures are looked up and how often: filters, footprints, order, policies, samples.
void declare_setting_options(CommandLine& line, RenderRequest& request);
/// Declares all options that set a RenderRequest.
void declare_render_options(CommandLine& line, RenderRequest& request);

/// Checks what single options cannot: a crop inside the image, cameras that exclude each other. Fills in what --peer-shading presets,
/// where no option says otherwise. Throws UsageError.
void settle(RenderRequest& request);

}  // namespace rawtexel::cli
