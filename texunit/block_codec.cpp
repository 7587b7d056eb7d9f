#include "texunit/block_codec.h"

#include "texunit/bc6h.h"
#include "texunit/bc7.h"
#include "texunit/bc_colour.h"
#include "texunit/bc_ramp.h"
#include "texunit/bc_rounded.h"

#include <cassert>

namespace rawtexel::texunit {
namespace {

BlockDecoder rounded_decoder(Format format, const RoundedDecoders& decoders) {
    switch (format) {
        using enum Format;
        case BC1RgbUnorm:
        case BC1RgbSrgb: return decoders.bc1_rgb;
        case BC1RgbaUnorm:
        case BC1RgbaSrgb: return decoders.bc1_rgba;
        case BC2Unorm:
        case BC2Srgb: return decoders.bc2;
        case BC3Unorm:
        case BC3Srgb: return decoders.bc3;
        default: return block_decoder(format);
    }
}

}  // namespace

BlockDecoder block_decoder(Format format, BcRounding rounding) {
    if (rounding != BcRounding::Exact) return rounded_decoder(format, rounded_decoders(rounding));
    switch (format) {
        using enum Format;
        case BC1RgbUnorm:
        case BC1RgbSrgb: return decode_bc1_rgb;
        case BC1RgbaUnorm:
        case BC1RgbaSrgb: return decode_bc1_rgba;
        case BC2Unorm:
        case BC2Srgb: return decode_bc2;
        case BC3Unorm:
        case BC3Srgb: return decode_bc3;
        case BC4Unorm: return decode_bc4_unorm;
        case BC4Snorm: return decode_bc4_snorm;
        case BC5Unorm: return decode_bc5_unorm;
        case BC5Snorm: return decode_bc5_snorm;
        case BC6HUfloat: return decode_bc6h_ufloat;
        case BC6HSfloat: return decode_bc6h_sfloat;
        case BC7Unorm:
        case BC7Srgb: return decode_bc7;
        default: return nullptr;
    }
}

void decode_block(Format format, const std::byte* block, std::byte* texels, BcRounding rounding) {
    const BlockDecoder decode = block_decoder(format, rounding);
    assert(decode && "not a block-compressed format");
    decode(block, texels);
}

}  // namespace rawtexel::texunit
