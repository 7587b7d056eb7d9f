// BC1, BC2 and BC3 with colours rounded to 8 bits (texunit/bc_rounding.h).
#pragma once

#include "texunit/bc_rounding.h"

#include <cstddef>

namespace rawtexel::texunit {

/// Decoders of one block to sixteen words, row by row (layout: texunit/format.h).
struct RoundedDecoders {
    using Decoder = void (*)(const std::byte* block, std::byte* texels);
    Decoder bc1_rgb, bc1_rgba, bc2, bc3;
};

/// For every rounding but Exact.
const RoundedDecoders& rounded_decoders(BcRounding rounding);

}  // namespace rawtexel::texunit
