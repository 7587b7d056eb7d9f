// One lookup, told: as JSON for scripts, as tables for people.
#pragma once

#include "cli/lookup_places.h"
#include "texunit/draw_trace.h"
#include "texunit/lookup_trace.h"
#include "texunit/texture.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::cli {

/// What is told of.
struct ReportedLookup {
    const texunit::Texture& texture;
    const texunit::SamplerState& sampler;
    const LookupPlace& place;
    const texunit::LookupTrace& trace;
    const texunit::DrawTrace* drawn = nullptr;  ///< where texels were drawn: told of instead of the trace's taps and result
};

/// {"lod", "anisotropy", "precision", "taps": [{"level", "x", "y", "weight", "value"}], "result"}. Taps of arrays have "layer"
/// too, those of cube maps "face" (and "layer" in an array of cubes), those of volumes "z"; taps that take the border colour have
/// "border": true and null for the texel. Numbers that are not finite are null. Drawn lookups have "estimator", and their taps "draw" and
/// "random", the numbers by role: {"x", "y", "z", "level", "probe", "sign"}, those left out that decide nothing.
nlohmann::ordered_json lookup_object(const ReportedLookup& lookup);
/// The same on one line.
std::string lookup_json(const ReportedLookup& lookup);

/// Texture, sampler and precision, level of detail and each level's share, every tap, their sum and the result; of drawn ones the numbers.
std::string lookup_table(const ReportedLookup& lookup);

}  // namespace rawtexel::cli
