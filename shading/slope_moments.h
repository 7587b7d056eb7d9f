// Moments of the slopes that a normal map encodes, as textures that are filtered like the map (Olano and Baker 2010, "LEAN Mapping").
#pragma once

#include "texunit/texture.h"

#include <cstdint>
#include <memory>

namespace rawtexel::shading {

/// Slopes (x/z, y/z) of the map's level 0. Texels are made when first asked for, and levels are their means.
struct SlopeMoments {
    std::unique_ptr<texunit::Texture> powers;   ///< means of the slopes a and b, of a^2 and of b^2
    std::unique_ptr<texunit::Texture> product;  ///< mean of a*b; null where nobody asks
};

/// `normals` outlives the moments.
SlopeMoments make_slope_moments(texunit::Texture& normals, bool with_product);

/// What they take at most once every texel was touched.
uint64_t slope_moment_bytes(const texunit::Shape& normals, bool with_product);

/// More is refused.
inline constexpr uint64_t kMostMomentBytes = uint64_t{4} << 30;

}  // namespace rawtexel::shading
