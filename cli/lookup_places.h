// Where a texture is looked up: coordinates and derivatives from the command line or from a file of many.
#pragma once

#include "texunit/lookup_trace.h"
#include "texunit/texel_source.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// What names a place in a texture: u and v, u, v and w of a volume, or a direction into a cube map.
enum class CoordinateKind { Uv, Uvw, Direction };

CoordinateKind coordinate_kind(const texunit::Shape& shape);
std::string_view option_of(CoordinateKind kind);  // --uv --uvw --direction
std::string_view form_of(CoordinateKind kind);    // U,V U,V,W X,Y,Z
size_t components(CoordinateKind kind);           // 2 or 3

/// Third components of kinds that have two are 0.
struct Derivatives {
    std::array<float, 3> dx{}, dy{};  ///< change over one pixel to the right, one pixel down
};
struct LookupPlace {
    std::array<float, 3> at{};
    std::optional<Derivatives> derivatives;
};

/// Of a flat texture.
LookupPlace place_of(const texunit::LaneCoordinates& at);

/// "U,V" or however many components `kind` has; any finite numbers. Throws UsageError naming `option`.
std::array<float, 3> parse_components(std::string_view option, std::string_view text, CoordinateKind kind);

/// The same for a place itself: 0,0,0 is no direction.
std::array<float, 3> parse_coordinates(std::string_view option, std::string_view text, CoordinateKind kind);

/// One lookup a line: the coordinates, and optionally the derivatives to the right and down, separated by blanks; empty lines are left out.
/// Throws scenes::InputError "FILE: line N: …".
std::vector<LookupPlace> read_places(const std::string& path, CoordinateKind kind);

}  // namespace rawtexel::cli
