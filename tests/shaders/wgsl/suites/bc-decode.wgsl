// The port of suite bc-decode: texels of compressed blocks.
// include "each_case.wgsl"
// include "blocks.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_BLOCK_TEXEL) {
        let number: u32 = case_uint(index, CASE_TEXTURE);
        let t: TextureShape = texture_shape(number);
        let texel: vec2u = vec2u(case_uint(index, CASE_INDEX), case_uint(index, CASE_EXTENT));
        let format: u32 = texture_format(number);
        let columns: u32 = (u32(t.extent.x) + 3u) / 4u;
        let at: u32 = texture_first_word(number) + (block_words(format) * ((texel.x / 4u) + (columns * (texel.y / 4u))));
        var block: vec4u = vec4u(stored_words[at], stored_words[at + 1u], 0u, 0u);
        if (block_words(format) == 4u) {
            block = vec4u(block.xy, stored_words[at + 2u], stored_words[at + 3u]);
        }
        r.value = decode_texel(format, block, (texel.x % 4u) + (4u * (texel.y % 4u)));
    }
    return r;
}
