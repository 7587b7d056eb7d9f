// What a user can ask of one lookup: which place, through which sampler.
#pragma once

#include "cli/command_line.h"
#include "cli/lookup_options.h"
#include "cli/lookup_places.h"
#include "cli/texture_file.h"
#include "texunit/draw_trace.h"
#include "texunit/sampler.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

struct SampleRequest {
    struct Coordinates {
        CoordinateKind kind = CoordinateKind::Uv;
        LookupPlace place;  ///< where `file` is empty
        std::string file;   ///< of many places
    };
    std::optional<Coordinates> coordinates;
    std::string ddx, ddy;      ///< as given, since their length depends on the coordinates; empty: none
    std::optional<float> lod;  ///< instead of derivatives
    int layer = 0;             ///< of an array, or cube of an array of cubes
    LookupOptions lookup;
    std::optional<std::array<texunit::Wrap, 3>> wraps;  ///< unset: repeat; cube maps have none
    size_t wraps_given = 0;                             ///< axes that --wrap names, 1..3
    std::optional<std::array<float, 4>> border;         ///< unset: 0
    std::optional<float> min_lod, max_lod;
    std::optional<ColorSpace> color_space;
    /// Of an estimator that draws; unset: not asked for.
    struct Draws {
        std::optional<int> taps;
        std::optional<texunit::Noise> noise;
        std::optional<bool> common_numbers;
        std::optional<std::array<uint32_t, 2>> pixel;
        std::optional<uint32_t> sample, seed;
    } draws;

    bool is_drawn() const { return lookup.filtering.draws(); }
};

/// `text` S[,T[,R]]; an axis without one wraps as the axis before it.
std::array<texunit::Wrap, 3> parse_wraps(std::string_view text);

void declare_sample_request(CommandLine& line, SampleRequest& request);

/// Checks what single options cannot, and gives the places that are to be looked up; reads their file. `usage` is for the message.
/// Throws UsageError and scenes::InputError.
std::vector<LookupPlace> settle_places(const SampleRequest& request, std::string_view usage);

/// The numbers that lookup `n` of the places draws with: that many samples further.
texunit::DrawSource make_draw_source(const SampleRequest& request, size_t n);

/// The sampler of the lookups. --lod takes no part in the search for a level: both bounds are that level, its bias added.
texunit::SamplerState make_sampler(const SampleRequest& request);

}  // namespace rawtexel::cli
