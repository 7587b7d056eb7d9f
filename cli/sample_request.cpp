#include "cli/sample_request.h"

#include "cli/filtering_options.h"
#include "cli/footprint_options.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/word_list.h"
#include "scenes/load.h"
#include "shading/draw_state.h"

#include <algorithm>

namespace rawtexel::cli {
namespace {

using texunit::Wrap;

constexpr NumberRange kLod{-1000.0f, 1000.0f};  ///< levels

void declare_coordinates(CommandLine& line, SampleRequest& request, CoordinateKind kind, const std::string& help) {
    const std::string option(option_of(kind));
    line.option(option, std::string(form_of(kind)) + "|@FILE", help, [&request, kind, option](const std::string& text) {
        if (request.coordinates)
            throw UsageError(std::string(option_of(request.coordinates->kind)) + " and " + option + " exclude each other");
        if (text == "@") throw UsageError(option + ": '@' names no file");
        SampleRequest::Coordinates& coordinates = request.coordinates.emplace();
        coordinates.kind = kind;
        if (text.starts_with('@'))
            coordinates.file = text.substr(1);
        else
            coordinates.place.at = parse_coordinates(option, text, kind);
    });
}

void declare_place(CommandLine& line, SampleRequest& request) {
    line.group("Where");
    declare_coordinates(line, request, CoordinateKind::Uv,
                        "coordinates in a flat texture or an array; @FILE holds one lookup a line, \"u v [dudx dvdx dudy dvdy]\"");
    declare_coordinates(line, request, CoordinateKind::Uvw, "the same in a volume, \"u v w [dudx dvdx dwdx dudy dvdy dwdy]\"");
    declare_coordinates(line, request, CoordinateKind::Direction, "the same into a cube map, a direction of any length");
    line.option("--ddx", "A,B[,C]", "change of the coordinates over one pixel to the right (default 0)",
                [&](const std::string& text) { request.ddx = text; });
    line.option("--ddy", "A,B[,C]", "change over one pixel down", [&](const std::string& text) { request.ddy = text; });
    line.option("--lod", "L", "this level of detail, without derivatives, " + print(kLod),
                [&](const std::string& text) { request.lod = parse_number("--lod", text, kLod); });
    line.option("--layer", "N", "of an array, or cube of an array of cubes (default 0)",
                [&](const std::string& text) { request.layer = int(parse_integer("--layer", text, 0, kMaxLayer)); });
}

void declare_sampler(CommandLine& line, SampleRequest& request) {
    line.group("Sampler");
    declare_lookup_options(line, request.lookup);
    line.option("--wrap", "S[,T[,R]]",
                "beyond the edges: repeat (the default), mirror, clamp, border or mirror-once; an axis without one takes that before it",
                [&](const std::string& text) {
                    request.wraps = parse_wraps(text);
                    request.wraps_given = split(text, ',').size();
                });
    line.option("--border", "R,G,B,A", "the linear colour of --wrap border (default 0,0,0,0)", [&](const std::string& text) {
        const std::vector<float> colour = parse_numbers("--border", text, "R,G,B,A", 4, 4);
        std::ranges::copy(colour, request.border.emplace().begin());
    });
    declare_color_space(line, request.color_space);
    line.group("Footprint");
    declare_lod_options(line, request.lookup.footprint, &request.lookup.names_lod_rule);
    line.option("--min-lod", "L", "no finer level of detail than this, " + print(kLod) + " (default 0)",
                [&](const std::string& text) { request.min_lod = parse_number("--min-lod", text, kLod); });
    line.option("--max-lod", "L", "no coarser one, --min-lod wins (default 1000)",
                [&](const std::string& text) { request.max_lod = parse_number("--max-lod", text, kLod); });
}

void declare_draws(CommandLine& line, SampleRequest& request) {
    SampleRequest::Draws& draws = request.draws;
    line.group("Draws");
    line.option("--estimator", "all|reservoir|jitter|abs-weight",
                "every tap weighed (the default), or one drawn: from the weights, two where a kernel has negative lobes; by jittering the "
                "coordinate; by the magnitude of its weight, for comparison",
                [&](const std::string& text) { request.lookup.filtering.estimator = read_estimator(text); });
    line.option("--taps", "K", "draws, averaged, 1 to " + std::to_string(shading::kMostTaps) + " (default 1)",
                [&](const std::string& text) { draws.taps = read_taps(text); });
    line.option("--noise", "white|sobol|r2|blue|stbn", "their numbers: one of `rawtexel list noises` (default white)",
                [&](const std::string& text) { draws.noise = read_noise(text); });
    line.option("--seed", "S", "of all numbers, 0 to " + std::to_string(UINT32_MAX) + " (default 0)",
                [&](const std::string& text) { draws.seed = uint32_t(parse_integer("--seed", text, 0, UINT32_MAX)); });
    line.option("--pixel", "X,Y", "whose numbers they are, as `rawtexel explain` names it (default 0,0)", [&](const std::string& text) {
        const std::vector<int64_t> values = parse_integers("--pixel", text, "X,Y", 2, 0, kMaxImageExtent - 1);
        draws.pixel = {uint32_t(values[0]), uint32_t(values[1])};
    });
    line.option("--sample", "N",
                "of the pixel, 0 to " + std::to_string(kMaxSamples - 1) + " (default 0); lines of @FILE are that sample and those after it",
                [&](const std::string& text) { draws.sample = uint32_t(parse_integer("--sample", text, 0, kMaxSamples - 1)); });
    line.option("--signed-numbers", "independent|common",
                "numbers of the draws from positive and from negative weights: their own (the default), or the same",
                [&](const std::string& text) { draws.common_numbers = read_common_numbers(text); });
}

/// Refuses draws where none are made, and those that the kernel does not have.
void check_draws(const SampleRequest& request) {
    const SampleRequest::Draws& draws = request.draws;
    const std::pair<const char*, bool> given[] = {
        {"--taps", draws.taps.has_value()},     {"--noise", draws.noise.has_value()},
        {"--seed", draws.seed.has_value()},     {"--pixel", draws.pixel.has_value()},
        {"--sample", draws.sample.has_value()}, {"--signed-numbers", draws.common_numbers.has_value()}};
    if (!request.is_drawn()) {
        for (const auto& [option, is_given] : given)
            if (is_given) throw UsageError(std::string(option) + ": --estimator all weighs every tap and draws no numbers");
        return;
    }
    const texunit::SamplerState sampler = make_sampler(request);
    const std::string estimator(to_string(sampler.estimator));
    if (sampler.ellipse > 0) {
        if (sampler.estimator == texunit::Estimator::AbsWeight)
            throw UsageError("--estimator abs-weight: the ellipse of --ewa has no negative weights; reservoir and jitter draw it");
        if (draws.common_numbers.has_value()) throw UsageError("--signed-numbers: the ellipse of --ewa has no negative weights");
        return;
    }
    const std::string kernel = to_string(sampler.minify);
    const std::string_view reason = texunit::refusal(sampler.estimator, sampler.minify);
    if (!reason.empty()) throw UsageError("--estimator: " + estimator + " cannot draw " + kernel + ", " + std::string(reason));
    const bool is_signed = !texunit::weighs_as_probability(sampler.minify);
    if (draws.common_numbers.has_value() && (!is_signed || sampler.estimator == texunit::Estimator::AbsWeight))
        throw UsageError("--signed-numbers: " + estimator + " draws one texel of " + kernel + ", not one of either sign");
}

/// Without levels there is no choice of one.
void check_levels(const SampleRequest& request) {
    if (request.lookup.mip != texunit::MipMode::None || request.lookup.footprint.ellipse > 0) return;
    const std::pair<const char*, bool> given[] = {{"--lod", request.lod.has_value()},
                                                  {"--lod-bias", request.lookup.footprint.lod_bias != 0},
                                                  {"--min-lod", request.min_lod.has_value()},
                                                  {"--max-lod", request.max_lod.has_value()}};
    for (const auto& [option, is_given] : given)
        if (is_given) throw UsageError(std::string(option) + ": --mip none reads level 0 whatever the level of detail");
}

void check_exclusions(const SampleRequest& request) {
    if (request.ddx.empty() != request.ddy.empty())
        throw UsageError(request.ddx.empty() ? "--ddy without --ddx (both, or neither)" : "--ddx without --ddy (both, or neither)");
    check_levels(request);
    if (request.lookup.footprint.ellipse > 0 && request.max_lod) throw UsageError("--max-lod: --ewa reads level 0, or that of --min-lod");
    if (!request.lod) return;
    if (request.lookup.names_lod_rule) throw UsageError("--lod and --lod-rule exclude each other: the rule is for derivatives");
    if (!request.ddx.empty()) throw UsageError("--lod and --ddx exclude each other");
    if (request.lookup.footprint.probes)
        throw UsageError("--lod and --aniso exclude each other: probes lie along the longer of the derivatives");
    if (request.lookup.footprint.ellipse > 0)
        throw UsageError("--lod and --ewa exclude each other: the ellipse is that of the derivatives");
}

}  // namespace

std::array<Wrap, 3> parse_wraps(std::string_view text) {
    const std::vector<std::string> words = split(text, ',');
    std::array<Wrap, 3> wraps{};
    if (words.size() > wraps.size()) throw UsageError("--wrap: '" + std::string(text) + "' is not S[,T[,R]]");
    for (size_t axis = 0; axis < wraps.size(); ++axis)
        wraps[axis] = axis >= words.size()
                          ? wraps[axis - 1]
                          : parse_choice("--wrap", words[axis],
                                         {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce});
    return wraps;
}

void declare_sample_request(CommandLine& line, SampleRequest& request) {
    declare_place(line, request);
    declare_sampler(line, request);
    declare_draws(line, request);
}

std::vector<LookupPlace> settle_places(const SampleRequest& request, std::string_view usage) {
    check_exclusions(request);
    check_draws(request);
    check_lookup(request.lookup);
    if (!request.coordinates) throw UsageError("--uv U,V is missing (usage: rawtexel " + std::string(usage) + ")");
    const auto& [kind, place, file] = *request.coordinates;
    std::vector<LookupPlace> places = file.empty() ? std::vector{place} : read_places(file, kind);
    const auto has_derivatives = [](const LookupPlace& each) { return each.derivatives.has_value(); };
    if (request.lod && std::ranges::any_of(places, has_derivatives))
        throw scenes::InputError(file + ": some lines hold derivatives, which --lod takes the place of");
    if (request.ddx.empty()) return places;
    const Derivatives derivatives{parse_components("--ddx", request.ddx, kind), parse_components("--ddy", request.ddy, kind)};
    for (LookupPlace& each : places)
        if (!each.derivatives) each.derivatives = derivatives;
    return places;
}

texunit::DrawSource make_draw_source(const SampleRequest& request, size_t n) {
    const SampleRequest::Draws& draws = request.draws;
    const auto [x, y] = draws.pixel.value_or(std::array<uint32_t, 2>{});
    texunit::DrawSource source;
    source.draws = draws.taps.value_or(1);
    source.noise = draws.noise.value_or(texunit::Noise::White);
    source.common_numbers = draws.common_numbers.value_or(false);
    const uint32_t sample = draws.sample.value_or(0) + uint32_t(n);
    // As renders count them: each sample has as many numbers as it has draws.
    source.address = {.x = x, .y = y, .sample = sample * uint32_t(source.draws), .seed = draws.seed.value_or(0)};
    return source;
}

texunit::SamplerState make_sampler(const SampleRequest& request) {
    texunit::SamplerState sampler;
    const LookupOptions& lookup = request.lookup;
    shading::LookupOverrides overrides;
    overrides.filter = lookup.filter;
    overrides.mip = lookup.mip;
    overrides.footprint = lookup.footprint;
    overrides.filtering = lookup.filtering;
    overrides.precision = lookup.precision;
    shading::override_sampler(overrides, sampler);
    const std::array<Wrap, 3> wraps = request.wraps.value_or(std::array{sampler.wrap_s, sampler.wrap_t, sampler.wrap_r});
    sampler.wrap_s = wraps[0], sampler.wrap_t = wraps[1], sampler.wrap_r = wraps[2];
    sampler.border = request.border.value_or(sampler.border);
    sampler.min_lod = request.min_lod.value_or(sampler.min_lod);
    sampler.max_lod = request.max_lod.value_or(sampler.max_lod);
    if (!request.lod) return sampler;
    const float biased = *request.lod + sampler.lod_bias;
    sampler.min_lod = sampler.max_lod = std::max(std::min(biased, sampler.max_lod), sampler.min_lod);
    sampler.lod_bias = 0;
    return sampler;
}

}  // namespace rawtexel::cli
