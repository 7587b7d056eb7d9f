#include "cli/render_options.h"

#include "cli/baseline_options.h"
#include "cli/filtering_options.h"
#include "cli/footprint_options.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/word_list.h"
#include "shading/adaptive_blocks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>

namespace rawtexel::cli {
namespace {

using shading::Aov;

constexpr NumberRange kStandardError{1e-6f, 1e6f};
constexpr NumberRange kFov{kMinFov, kMaxFov}, kAngle{-kMaxAngle, kMaxAngle}, kZoom{kMinZoom, kMaxZoom}, kAmbient{0.0f, kMaxAmbient},
    kRadiance{0.0f, kMaxRadiance}, kLux{0.0f, kMaxLux}, kExposure{-kMaxExposure, kMaxExposure}, kLength{-kMaxLength, kMaxLength};

// A number of a value that holds several, in its own range.
float part_in(const NumberRange& range, const char* option, std::string_view text, const char* part, float value) {
    if (value >= range.lowest && value <= range.highest) return value;
    throw UsageError(std::string(option) + ": '" + std::string(text) + "' has " + part + " " + print_number(value) +
                     " (allowed: " + print(range) + ")");
}

void declare_image_options(CommandLine& line, RenderRequest& request) {
    line.group("Image");
    line.option("--size", "WxH", "extents in pixels, 1 to " + std::to_string(kMaxImageExtent) + " (default 1280x720)",
                [&](const std::string& text) { request.size = parse_size(text); });
    line.option("--crop", "X,Y,W,H", "only this part of the image, in its pixels; they are those of the whole",
                [&](const std::string& text) { request.crop = parse_crop(text); });
}

void declare_view_options(CommandLine& line, ViewOptions& view) {
    line.group("Camera (default: the scene's first, else 45 degrees along (-1, -0.6, -1), the whole scene in view)");
    line.option("--camera", "NAME|INDEX", "one of the scene's cameras", [&](const std::string& text) { view.camera = text; });
    line.option(
        "--orbit", "YAW,PITCH[,ZOOM]",
        "on a sphere about the scene's centre: degrees, " + print(kAngle) + "; at ZOOM 1 the scene just fits (" + print(kZoom) + ")",
        [&](const std::string& text) { view.orbit = parse_orbit(text); });
    line.option("--eye", "X,Y,Z", "where the camera is: metres, " + print(kLength),
                [&](const std::string& text) { view.eye = parse_vector("--eye", text); });
    line.option("--target", "X,Y,Z", "what it looks at: metres, " + print(kLength) + " (default: the scene's centre)",
                [&](const std::string& text) { view.target = parse_vector("--target", text); });
    line.option("--fov", "DEGREES", "vertical field of view, " + print(kFov),
                [&](const std::string& text) { view.fov = parse_number("--fov", text, kFov); });
}

void declare_light_options(CommandLine& line, LightOptions& light) {
    line.group("Light");
    line.option(
        "--light", "X,Y,Z[,I]",
        "one directional light instead of the scene's: the way it travels, and its intensity in lux, " + print(kLux) + " (default 3)",
        [&](const std::string& text) { light.light = parse_light(text); });
    line.option("--ambient", "A", "adds A x base colour x occlusion, " + print(kAmbient) + " (default 0)",
                [&](const std::string& text) { light.ambient = parse_number("--ambient", text, kAmbient); });
    line.option("--shadows", "on|off", "of the first directional light (default on)", [&](const std::string& text) {
        light.shadows = parse_word("--shadows", text, {"on", "off"}) == 0;
    });
    line.option("--environment", "sky|none|FILE",
                "light from all around; FILE is a lat-long image (default: sky where the scene has no lights, else none)",
                [&](const std::string& text) { light.environment = parse_environment(text); });
    line.option("--environment-reflections", "prefiltered|split-sum",
                "several prefiltered lobes a reflection, within 1 % of sampling (the default), or one, cheaper and some per cent off",
                [&](const std::string& text) {
                    using shading::EnvironmentReflections;
                    light.reflections = parse_choice("--environment-reflections", text,
                                                     {EnvironmentReflections::Prefiltered, EnvironmentReflections::SplitSum});
                });
    line.option("--background", "environment|R,G,B",
                "what shows where nothing is, in linear radiance, " + print(kRadiance) + " (default environment)",
                [&](const std::string& text) { light.background = parse_background(text); });
    line.flag("--peer-shading",
              "light as simple viewers draw it: the scene's directional light or --light -0.4,-1,-0.3,3, and --ambient 0.1 "
              "--shadows off --environment none --tonemap none; options beside it win",
              light.peer_shading);
}

void declare_sample_options(CommandLine& line, SampleOptions& samples) {
    line.group("Sampling");
    line.option("--spp", "N", "samples per pixel, 1 to " + std::to_string(kMaxSamples) + " (default 1); sample n is the same whatever N",
                [&](const std::string& text) { samples.spp = int(parse_integer("--spp", text, 1, kMaxSamples)); });
    line.option(
        "--pixel-filter", "box|tent|gaussian", "weight of a sample by its distance from the pixel's centre (default box)",
        [&](const std::string& text) {
            using shading::PixelFilter;
            samples.pixel_filter = parse_choice("--pixel-filter", text, {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian});
        });
    line.option("--pixel-jitter", "frame|pixel",
                "one offset per sample for all pixels, sample 0 at the centre (the default), or one per pixel",
                [&](const std::string& text) {
                    using shading::PixelJitter;
                    samples.pixel_jitter = parse_choice("--pixel-jitter", text, {PixelJitter::Frame, PixelJitter::Pixel});
                });
    line.option("--adaptive", "ERROR",
                "blocks of 16x16 pixels stop at 16, 32, 64 ... samples once their standard error of linear radiance is below ERROR, " +
                    print(kStandardError) + "; --spp is the most, --aov spp shows them",
                [&](const std::string& text) { samples.adaptive = parse_number("--adaptive", text, kStandardError); });
    line.option("--reference", "ERROR",
                "the truth instead: level 0, every texel shaded and then filtered, an offset per sample and pixel, samples until the "
                "image's standard error is below ERROR, " +
                    print(kStandardError),
                [&](const std::string& text) { samples.reference = parse_number("--reference", text, kStandardError); });
    line.option("--seed", "S", "of all random numbers, 0 to " + std::to_string(UINT32_MAX) + " (default 0)",
                [&](const std::string& text) { samples.seed = uint32_t(parse_integer("--seed", text, 0, UINT32_MAX)); });
}

void declare_tone_options(CommandLine& line, ToneOptions& tone) {
    line.group("Display (formats of 8 bits; float formats hold linear radiance)");
    line.option("--exposure", "EV", "radiance times 2^EV, " + print(kExposure) + " (default 0)",
                [&](const std::string& text) { tone.exposure = parse_number("--exposure", text, kExposure); });
    line.option("--tonemap", "aces|reinhard|none", "how radiance of any size is fitted into what a screen shows (default aces); none clips",
                [&](const std::string& text) {
                    using shading::ToneMap;
                    tone.tone_map = parse_choice("--tonemap", text, {ToneMap::Aces, ToneMap::Reinhard, ToneMap::None});
                });
    line.option("--transfer", "srgb|sqrt|linear", "how light becomes codes (default srgb)", [&](const std::string& text) {
        using shading::Transfer;
        tone.transfer = parse_choice("--transfer", text, {Transfer::Srgb, Transfer::Sqrt, Transfer::Linear});
    });
}

void declare_machine_options(CommandLine& line, MachineOptions& machine) {
    line.group("Machine (the image is the same whatever these say)");
    line.option("--threads", "N", "1 to " + std::to_string(kMaxThreads) + " (default: as many as there are cores)",
                [&](const std::string& text) { machine.threads = int(parse_integer("--threads", text, 1, kMaxThreads)); });
    line.option("--tile-size", "N", "32, 64 or 128 pixels (default 64)", [&](const std::string& text) {
        constexpr std::array kTileSizes{32, 64, 128};
        machine.tile_size = kTileSizes[parse_word("--tile-size", text, {"32", "64", "128"})];
    });
    line.option("--simd", "auto|scalar|sse4|avx2|avx3", "the instruction set (default auto: the best there is)",
                [&](const std::string& text) {
                    using texunit::Simd;
                    machine.simd = parse_choice("--simd", text, {Simd::Auto, Simd::Scalar, Simd::Sse4, Simd::Avx2, Simd::Avx3});
                });
    declare_skip_options(line, machine.skips);
    line.option("--progress", "auto|always|never",
                "a bar on a terminal, percent lines elsewhere; auto shows it only when it takes a while (default auto)",
                [&](const std::string& text) {
                    machine.progress = parse_choice("--progress", text, {ProgressMode::Auto, ProgressMode::Always, ProgressMode::Never});
                });
}

void check_crop(const shading::Crop& crop, const ImageSize& size) {
    if (crop.width == 0) return;
    if (crop.x + crop.width > size.width || crop.y + crop.height > size.height)
        throw UsageError("--crop: " + print(crop) + " reaches outside the image of " + print(size));
}

void check_view(const ViewOptions& view) {
    if (view.camera && view.orbit) throw UsageError("--camera and --orbit exclude each other");
    if (view.orbit && view.eye) throw UsageError("--orbit and --eye exclude each other");
}

void check_adaptive(const RenderRequest& request) {
    if (request.samples.spp <= shading::kFirstAdaptiveDecision)
        throw UsageError("--adaptive: blocks stop at 16 samples at the earliest, and --spp is " + std::to_string(request.samples.spp) +
                         " (allowed: with --spp 17 and more)");
    const ImageSize size = request.image_size();
    if (!shading::holds_whole_blocks(request.crop, size.width, size.height))
        throw UsageError("--adaptive: blocks of 16x16 pixels stop as a whole, and --crop " + print(request.crop) +
                         " cuts some (allowed: multiples of 16, or the image's edge)");
    if (request.sequence.is_sequence() && request.sequence.temporal().accumulation == shading::Accumulation::Mean)
        throw UsageError("--adaptive: the mean over frames keeps every sample (allowed: --accumulate ema or reproject)");
}

// The truth leaves no choice of levels, order, estimator and samples: options that make one are refused, and what it chooses is put down.
void preset_reference(RenderRequest& request) {
    LookupOptions& lookup = request.lookup;
    const std::pair<bool, const char*> taken[] = {
        {lookup.mip.has_value(), "--mip"},
        {!(lookup.footprint == shading::FootprintOptions{}) || lookup.names_lod_rule,
         "--aniso, --ewa, --lod-*, --hybrid-bias, --derivatives and --footprint"},
        {lookup.filtering.draws() || lookup.filtering.order, "--estimator and --order"},
        {lookup.filtering.baseline != shading::Baseline::None, "--baseline"},
        {lookup.filtering.blend || lookup.filtering.shadow_taps != shading::ShadowTaps::All, "--blend and --shadow-taps"},
        {lookup.filtering.texture_jitter != shading::TextureJitter::None, "--texture-jitter"},
        {lookup.precision != texunit::Precision::Exact, "--precision"},
        {request.samples.spp != 1, "--spp"},
        {request.samples.adaptive.has_value(), "--adaptive"},
        {request.sequence.is_sequence(), "--frames and --accumulate"},
    };
    for (const auto& [given, options] : taken)
        if (given) throw UsageError("--reference: the truth leaves no choice to " + std::string(options));
    lookup.mip = texunit::MipMode::None;
    lookup.footprint.probes = 1;
    lookup.filtering.order = shading::FilterOrder::After;
    request.samples.pixel_jitter = shading::PixelJitter::Pixel;
}

// What a plain viewer with one light and no tone map draws. The light itself depends on the scene: see make_lighting.
void preset_peer_shading(RenderRequest& request) {
    LightOptions& light = request.light;
    if (!light.ambient) light.ambient = 0.1f;
    if (!light.shadows) light.shadows = false;
    if (!light.environment) light.environment = EnvironmentOption{EnvironmentKind::None, {}};
    if (!request.tone.tone_map) request.tone.tone_map = shading::ToneMap::None;
}

}  // namespace

ImageSize parse_size(std::string_view text) {
    const size_t separator = text.find('x');
    if (separator == std::string_view::npos) throw UsageError("--size: '" + std::string(text) + "' is not WxH, such as 1280x720");
    const auto extent = [&](std::string_view part) { return int(parse_integer("--size", part, 1, kMaxImageExtent)); };
    return {extent(text.substr(0, separator)), extent(text.substr(separator + 1))};
}

std::string print(const ImageSize& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

shading::Crop parse_crop(std::string_view text) {
    const std::vector<int64_t> values = parse_integers("--crop", text, "X,Y,W,H", 4, 0, kMaxImageExtent);
    if (values[2] == 0 || values[3] == 0) throw UsageError("--crop: '" + std::string(text) + "' is empty");
    return {int(values[0]), int(values[1]), int(values[2]), int(values[3])};
}

std::string print(const shading::Crop& crop) {
    std::ostringstream text;
    text << crop.x << ',' << crop.y << ',' << crop.width << ',' << crop.height;
    return text.str();
}

Orbit parse_orbit(std::string_view text) {
    const std::vector<float> values = parse_numbers("--orbit", text, "YAW,PITCH[,ZOOM]", 2, 3);
    Orbit orbit;
    orbit.yaw = part_in(kAngle, "--orbit", text, "YAW", values[0]);
    orbit.pitch = part_in(kAngle, "--orbit", text, "PITCH", values[1]);
    if (values.size() == 3) orbit.zoom = part_in(kZoom, "--orbit", text, "ZOOM", values[2]);
    return orbit;
}

std::string print(const Orbit& orbit) { return print_vector({orbit.yaw, orbit.pitch, orbit.zoom}); }

SunOption parse_light(std::string_view text) {
    const std::vector<float> values = parse_numbers("--light", text, "X,Y,Z[,I]", 3, 4);
    SunOption light;
    light.direction = {values[0], values[1], values[2]};
    if (values.size() == 4) light.intensity = part_in(kLux, "--light", text, "I", values[3]);
    if (light.direction == glm::vec3(0.0f)) throw UsageError("--light: '" + std::string(text) + "' has no direction");
    return light;
}

std::string print(const SunOption& light) { return print_vector(light.direction) + "," + print_number(light.intensity); }

EnvironmentOption parse_environment(std::string_view text) {
    if (text == "sky") return {EnvironmentKind::Sky, {}};
    if (text == "none") return {EnvironmentKind::None, {}};
    // What looks like no file and is none was meant to be a word.
    if (text.find_first_of("/.") == text.npos && !std::filesystem::exists(text))
        throw UsageError(unknown_value("--environment", text, std::vector<std::string>{"sky", "none"}).what() +
                         std::string(", or the path of an image"));
    return {EnvironmentKind::File, std::string(text)};
}

std::string print(const EnvironmentOption& environment) {
    if (environment.kind == EnvironmentKind::File) return environment.file;
    return environment.kind == EnvironmentKind::Sky ? "sky" : "none";
}

std::optional<glm::vec3> parse_background(std::string_view text) {
    if (text == "environment") return std::nullopt;
    if (!text.empty() && std::isalpha(static_cast<unsigned char>(text[0]))) parse_word("--background", text, {"environment"});
    return parse_vector("--background", text, "environment or R,G,B", kRadiance);
}

std::vector<Aov> parse_aovs(std::string_view text) {
    std::vector<Aov> aovs;
    for (const std::string& word : split(text, ',')) {
        const Aov aov = parse_choice(
            "--aov", word, {Aov::Depth, Aov::Normal, Aov::Albedo, Aov::Uv, Aov::Lod, Aov::Material, Aov::Texels, Aov::Lines, Aov::Spp});
        if (std::ranges::find(aovs, aov) != aovs.end()) throw UsageError("--aov: '" + word + "' is named twice");
        aovs.push_back(aov);
    }
    return aovs;
}

void declare_setting_options(CommandLine& line, RenderRequest& request) {
    line.group("Texture unit");
    declare_lookup_options(line, request.lookup);
    line.group("Footprints");
    declare_footprint_options(line, request.lookup.footprint, &request.lookup.names_lod_rule);
    line.group("Filtering before or after shading");
    declare_filtering_options(line, request.lookup.filtering);
    line.option("--policy", "FILE.json", "order, estimator, filter and mip of single materials and textures (docs/filters.md)",
                [&](const std::string& text) { request.policy = text; });
    declare_baseline_option(line, request.lookup.filtering);
    declare_sample_options(line, request.samples);
}

void declare_render_options(CommandLine& line, RenderRequest& request) {
    declare_image_options(line, request);
    declare_view_options(line, request.view);
    declare_light_options(line, request.light);
    declare_setting_options(line, request);
    declare_tone_options(line, request.tone);
    declare_fetch_options(line, request.fetches);
    declare_machine_options(line, request.machine);
}

void settle(RenderRequest& request) {
    check_crop(request.crop, request.image_size());
    check_view(request.view);
    check_baseline(request.lookup);
    check_filtering(request.lookup.filtering, request.lookup.filter);
    check_texture_jitter(request.lookup);
    check_lookup(request.lookup);
    if (request.light.peer_shading) preset_peer_shading(request);
    if (request.samples.reference) preset_reference(request);
    if (request.samples.adaptive) check_adaptive(request);
    if (request.lookup.footprint.area == shading::FootprintArea::Sample && request.samples.spp == 1)
        throw UsageError("--footprint sample: one sample's share is the whole pixel (allowed: with --spp 2 and more)");
    if (request.lookup.filtering.shadow_taps == shading::ShadowTaps::One && request.light.shadows == false)
        throw UsageError("--shadow-taps one: there are no shadows to test (--shadows off, --peer-shading)");
}

}  // namespace rawtexel::cli
