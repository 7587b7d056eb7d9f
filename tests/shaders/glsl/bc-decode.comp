#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite bc-decode: texels of compressed blocks.
#include "each_case.glsl"
#include "blocks.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_BLOCK_TEXEL) {
        uint number = case_uint(index, CASE_TEXTURE);
        TextureShape t = texture_shape(number);
        uvec2 texel = uvec2(case_uint(index, CASE_INDEX), case_uint(index, CASE_EXTENT));
        uint format = texture_format(number), columns = (uint(t.extent.x) + 3u) / 4u;
        uint at = texture_first_word(number) + block_words(format) * (texel.x / 4u + columns * (texel.y / 4u));
        uvec4 block = uvec4(stored_words[at], stored_words[at + 1u], 0u, 0u);
        if (block_words(format) == 4u) block = uvec4(block.xy, stored_words[at + 2u], stored_words[at + 3u]);
        r.value = decode_texel(format, block, texel.x % 4u + 4u * (texel.y % 4u));
    }
    return r;
}
