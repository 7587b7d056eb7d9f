// Texels of compressed blocks: BC1 to BC7 (D3D11.3 19.5; BC6H and BC7 as ARB_texture_compression_bptc has them, bit for bit). BC1 to BC5 are
// interpolated as exact fractions of their codes.
#ifndef BLOCKS_GLSL
#define BLOCKS_GLSL

const uint FORMAT_BC1_RGB = 18u, FORMAT_BC1_RGBA = 20u, FORMAT_BC2 = 22u, FORMAT_BC3 = 24u, FORMAT_BC4 = 26u, FORMAT_BC4_SNORM = 27u,
           FORMAT_BC5 = 28u, FORMAT_BC5_SNORM = 29u, FORMAT_BC6H_UFLOAT = 30u, FORMAT_BC6H_SFLOAT = 31u, FORMAT_BC7 = 32u;

// 32-bit words of a block.
uint block_words(uint format) {
    return format == FORMAT_BC1_RGB || format == FORMAT_BC1_RGBA || format == FORMAT_BC4 || format == FORMAT_BC4_SNORM ? 2u : 4u;
}

// `count` bits of a block from bit `first`, at most 32.
uint block_bits(uvec4 block, uint first, uint count) {
    if (count == 0u) return 0u;
    uint word = first / 32u, shift = first % 32u, low = block[word] >> shift;
    if (shift + count > 32u) low |= block[word + 1u] << (32u - shift);
    return count == 32u ? low : low & ((1u << count) - 1u);
}

vec3 colour_565(uint code) { return vec3(float(code >> 11) / 31.0, float(code >> 5 & 63u) / 63.0, float(code & 31u) / 31.0); }

// BC2 and BC3 take four colours whatever the order of their end points.
vec4 decode_colour(uvec2 block, uint texel, bool always_four, bool has_alpha) {
    uint a = block.x & 0xFFFFu, b = block.x >> 16, index = block.y >> 2u * texel & 3u;
    vec3 first = colour_565(a), second = colour_565(b);
    if (index == 0u) return vec4(first, 1.0);
    if (index == 1u) return vec4(second, 1.0);
    if (always_four || a > b) return vec4(index == 2u ? (2.0 * first + second) / 3.0 : (first + 2.0 * second) / 3.0, 1.0);
    return index == 2u ? vec4(0.5 * (first + second), 1.0) : vec4(0.0, 0.0, 0.0, has_alpha ? 0.0 : 1.0);
}

// One value of 8 bytes. The order of signed end points is that of the raw codes; -128 then means -127.
float decode_ramp(uvec2 block, uint texel, bool is_signed) {
    int a = int(block.x & 255u), b = int(block.x >> 8 & 255u);
    if (is_signed) {
        a = a << 24 >> 24;
        b = b << 24 >> 24;
    }
    uint index = block_bits(uvec4(block, 0u, 0u), 16u + 3u * texel, 3u);
    bool eight = a > b;
    float scale = is_signed ? 127.0 : 255.0, first = float(is_signed ? max(a, -127) : a) / scale, second = float(is_signed ? max(b, -127) : b) / scale;
    if (index == 0u) return first;
    if (index == 1u) return second;
    float k = float(index - 1u);
    if (eight) return ((7.0 - k) * first + k * second) / 7.0;
    if (index == 6u) return is_signed ? -1.0 : 0.0;
    if (index == 7u) return 1.0;
    return ((5.0 - k) * first + k * second) / 5.0;
}

// Which of two subsets a texel belongs to, bit by bit; of three, two bits a texel.
const uint PARTITIONS_2[64] = uint[64](
    0xCCCCu, 0x8888u, 0xEEEEu, 0xECC8u, 0xC880u, 0xFEECu, 0xFEC8u, 0xEC80u, 0xC800u, 0xFFECu, 0xFE80u, 0xE800u, 0xFFE8u, 0xFF00u, 0xFFF0u, 0xF000u,
    0xF710u, 0x008Eu, 0x7100u, 0x08CEu, 0x008Cu, 0x7310u, 0x3100u, 0x8CCEu, 0x088Cu, 0x3110u, 0x6666u, 0x366Cu, 0x17E8u, 0x0FF0u, 0x718Eu, 0x399Cu,
    0xAAAAu, 0xF0F0u, 0x5A5Au, 0x33CCu, 0x3C3Cu, 0x55AAu, 0x9696u, 0xA55Au, 0x73CEu, 0x13C8u, 0x324Cu, 0x3BDCu, 0x6996u, 0xC33Cu, 0x9966u, 0x0660u,
    0x0272u, 0x04E4u, 0x4E40u, 0x2720u, 0xC936u, 0x936Cu, 0x39C6u, 0x639Cu, 0x9336u, 0x9CC6u, 0x817Eu, 0xE718u, 0xCCF0u, 0x0FCCu, 0x7744u, 0xEE22u);
const uint PARTITIONS_3[64] = uint[64](
    0xAA685050u, 0x6A5A5040u, 0x5A5A4200u, 0x5450A0A8u, 0xA5A50000u, 0xA0A05050u, 0x5555A0A0u, 0x5A5A5050u,
    0xAA550000u, 0xAA555500u, 0xAAAA5500u, 0x90909090u, 0x94949494u, 0xA4A4A4A4u, 0xA9A59450u, 0x2A0A4250u,
    0xA5945040u, 0x0A425054u, 0xA5A5A500u, 0x55A0A0A0u, 0xA8A85454u, 0x6A6A4040u, 0xA4A45000u, 0x1A1A0500u,
    0x0050A4A4u, 0xAAA59090u, 0x14696914u, 0x69691400u, 0xA08585A0u, 0xAA821414u, 0x50A4A450u, 0x6A5A0200u,
    0xA9A58000u, 0x5090A0A8u, 0xA8A09050u, 0x24242424u, 0x00AA5500u, 0x24924924u, 0x24499224u, 0x50A50A50u,
    0x500AA550u, 0xAAAA4444u, 0x66660000u, 0xA5A0A5A0u, 0x50A050A0u, 0x69286928u, 0x44AAAA44u, 0x66666600u,
    0xAA444444u, 0x54A854A8u, 0x95809580u, 0x96969600u, 0xA85454A8u, 0x80959580u, 0xAA141414u, 0x96960000u,
    0xAAAA1414u, 0xA05050A0u, 0xA0A5A5A0u, 0x96000000u, 0x40804080u, 0xA9A8A9A8u, 0xAAAAAA44u, 0x2A4A5254u);
// Texels whose index lacks its highest bit, beside texel 0: four bits each, of the second of two subsets, the second and the third of three.
const uint ANCHORS_2[8] = uint[8](0xFFFFFFFFu, 0xFFFFFFFFu, 0xF882282Fu, 0x22882282u, 0xFF8286FFu, 0x6FF22282u, 0x22FF8626u, 0xF22FFFFFu);
const uint ANCHORS_3A[8] = uint[8](0xFF38FF33u, 0x33566688u, 0xA633F833u, 0xFF586885u, 0xF8A653F8u, 0xFFFF5F3Fu, 0xA58555F3u, 0x33CFD8A5u);
const uint ANCHORS_3B[8] = uint[8](0x83FF388Fu, 0x8FFFFFFFu, 0x8F8F3F8Fu, 0x8AFFA6F3u, 0xA98AAF3Fu, 0x8663F8F6u, 0xFFFFFF3Fu, 0x8FF3FFFFu);

uint nibble(uint words[8], uint i) { return words[i / 8u] >> 4u * (i % 8u) & 15u; }

const int WEIGHTS_2[4] = int[4](0, 21, 43, 64);
const int WEIGHTS_3[8] = int[8](0, 9, 18, 27, 37, 46, 55, 64);
const int WEIGHTS_4[16] = int[16](0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64);

int interpolate(int first, int second, uint index, uint bits) {
    int w = bits == 2u ? WEIGHTS_2[index] : bits == 3u ? WEIGHTS_3[index] : WEIGHTS_4[index];
    return ((64 - w) * first + w * second + 32) >> 6;
}

// The index of a texel: anchors, whose highest bit is 0, take one bit less.
uint texel_index(uvec4 block, uint first, uint bits, uint texel, uvec3 anchors, uint subsets) {
    uint at = first + bits * texel, wide = bits;
    for (uint s = 0u; s < subsets; ++s) {
        if (texel > anchors[s]) --at;
        if (texel == anchors[s]) --wide;
    }
    return block_bits(block, at, wide);
}

uint texel_subset(uint subsets, uint parting, uint texel) {
    if (subsets == 1u) return 0u;
    return subsets == 2u ? PARTITIONS_2[parting] >> texel & 1u : PARTITIONS_3[parting] >> 2u * texel & 3u;
}

uvec3 anchors_of(uint subsets, uint parting) {
    if (subsets == 2u) return uvec3(0u, nibble(ANCHORS_2, parting), 16u);
    if (subsets == 3u) return uvec3(0u, nibble(ANCHORS_3A, parting), nibble(ANCHORS_3B, parting));
    return uvec3(0u, 16u, 16u);
}

// Widths of a BC7 mode's fields: subsets, partition, rotation, selection; colour, alpha, p-bits an end point, p-bits a subset; indices.
const uvec4 BC7_SHAPE[8] = uvec4[8](uvec4(3, 4, 0, 0), uvec4(2, 6, 0, 0), uvec4(3, 6, 0, 0), uvec4(2, 6, 0, 0), uvec4(1, 0, 2, 1), uvec4(1, 0, 2, 0),
                                    uvec4(1, 0, 0, 0), uvec4(2, 6, 0, 0));
const uvec4 BC7_CODES[8] = uvec4[8](uvec4(4, 0, 1, 0), uvec4(6, 0, 0, 1), uvec4(5, 0, 0, 0), uvec4(7, 0, 1, 0), uvec4(5, 6, 0, 0), uvec4(7, 8, 0, 0),
                                    uvec4(7, 7, 1, 0), uvec4(5, 5, 1, 0));
const uvec2 BC7_INDICES[8] = uvec2[8](uvec2(3, 0), uvec2(3, 0), uvec2(2, 0), uvec2(2, 0), uvec2(2, 3), uvec2(2, 2), uvec2(4, 0), uvec2(2, 0));

// A code of `bits` bits to 8: its highest bits are repeated below.
int widen(uint code, uint bits) {
    uint high = code << (8u - bits);
    return int(high | high >> bits);
}

vec4 decode_bc7(uvec4 block, uint texel) {
    if ((block.x & 255u) == 0u) return vec4(0.0);
    uint mode = uint(findLSB(block.x));
    uvec4 shape = BC7_SHAPE[mode], codes = BC7_CODES[mode];
    uvec2 index_bits = BC7_INDICES[mode];
    uint at = mode + 1u, parting = block_bits(block, at, shape.y);
    at += shape.y;
    uint rotation = block_bits(block, at, shape.z);
    at += shape.z;
    uint selection = block_bits(block, at, shape.w);
    at += shape.w;
    uint ends = 2u * shape.x, colours = at, alphas = colours + 3u * ends * codes.x, p_bits = alphas + ends * codes.y;
    uint indices = p_bits + ends * codes.z + shape.x * codes.w, second_indices = indices + 16u * index_bits.x - shape.x;
    uint subset = texel_subset(shape.x, parting, texel);
    ivec4 end_point[2];
    for (uint side = 0u; side < 2u; ++side) {
        uint e = 2u * subset + side, has_p = codes.z + codes.w;
        uint p = block_bits(block, p_bits + (codes.w > 0u ? subset : e), has_p);
        for (uint c = 0u; c < 4u; ++c) {
            uint bits = c < 3u ? codes.x : codes.y;
            uint code = block_bits(block, c < 3u ? colours + (c * ends + e) * bits : alphas + e * bits, bits);
            end_point[side][c] = bits == 0u ? 255 : widen(code << has_p | p, bits + has_p);
        }
    }
    uvec3 anchors = anchors_of(shape.x, parting);
    uint first = texel_index(block, indices, index_bits.x, texel, anchors, shape.x), second = first;
    uvec2 bits = uvec2(index_bits.x);
    if (index_bits.y > 0u) {
        second = texel_index(block, second_indices, index_bits.y, texel, uvec3(0u, 16u, 16u), 1u);
        bits.y = index_bits.y;
    }
    if (selection == 1u) {
        uint kept = first;
        first = second;
        second = kept;
        bits = bits.yx;
    }
    ivec4 colour;
    for (int c = 0; c < 4; ++c) colour[c] = interpolate(end_point[0][c], end_point[1][c], c < 3 ? first : second, c < 3 ? bits.x : bits.y);
    if (rotation > 0u) {
        int channel = int(rotation) - 1, kept = colour.a;
        colour.a = colour[channel];
        colour[channel] = kept;
    }
    return vec4(colour) / 255.0;
}

// Where the bits of a BC6H block go, mode by mode in 84 bytes: variable << 4 | bit. Variables are 3*end point + channel, 12 is the partition.
const uint BC6H_BITS[294] = uint[294](
    0x8474D1D0u, 0x020100B4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u,
    0x727170A4u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u,
    0xD0D0C4C3u, 0xA475D1D0u, 0x020100A5u, 0x06050403u, 0x1084B1B0u, 0x14131211u, 0xB2851615u, 0x22212074u, 0x26252423u, 0x30B4B5B3u,
    0x34333231u, 0x72717035u, 0x42414073u, 0xA0454443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90656463u, 0x94939291u,
    0xC2C1C095u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u,
    0x30292827u, 0x34333231u, 0x7271700Au, 0x42414073u, 0xA0B01A43u, 0x50A3A2A1u, 0x2A535251u, 0x828180B1u, 0x62616083u, 0x90B26463u,
    0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u,
    0x26252423u, 0x30292827u, 0x0A333231u, 0x727170A4u, 0x42414073u, 0xA01A4443u, 0x50A3A2A1u, 0x2A535251u, 0x828180B1u, 0x62616083u,
    0x90B2B063u, 0x74939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u,
    0x22212019u, 0x26252423u, 0x30292827u, 0x0A333231u, 0x72717084u, 0x42414073u, 0xA0B01A43u, 0x50A3A2A1u, 0x54535251u, 0x8281802Au,
    0x62616083u, 0x90B2B163u, 0xB4939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10840807u, 0x14131211u,
    0x18171615u, 0x22212074u, 0x26252423u, 0x30B42827u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u,
    0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x1084A407u,
    0x14131211u, 0xB2171615u, 0x22212074u, 0x26252423u, 0x30B4B327u, 0x34333231u, 0x72717035u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u,
    0x54535251u, 0x828180B1u, 0x62616083u, 0x90656463u, 0x94939291u, 0xC2C1C095u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u,
    0x1084B007u, 0x14131211u, 0x75171615u, 0x22212074u, 0x26252423u, 0x30B4A527u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0454443u,
    0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u,
    0x06050403u, 0x1084B107u, 0x14131211u, 0x85171615u, 0x22212074u, 0x26252423u, 0x30B4B527u, 0x34333231u, 0x727170A4u, 0x42414073u,
    0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u,
    0x020100D4u, 0xA4050403u, 0x1084B1B0u, 0x14131211u, 0xB2857515u, 0x22212074u, 0xA5252423u, 0x30B4B5B3u, 0x34333231u, 0x72717035u,
    0x42414073u, 0xA0454443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90656463u, 0x94939291u, 0xC2C1C095u, 0xD0D0C4C3u,
    0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u,
    0x38373635u, 0x42414039u, 0x46454443u, 0x50494847u, 0x54535251u, 0x58575655u, 0xD0D0D059u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u,
    0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u,
    0x34333231u, 0x38373635u, 0x4241400Au, 0x46454443u, 0x501A4847u, 0x54535251u, 0x58575655u, 0xD0D0D02Au, 0xD0D0D0D0u, 0xD0D0D0D0u,
    0xD0D0D0D0u, 0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u,
    0x30292827u, 0x34333231u, 0x0B373635u, 0x4241400Au, 0x46454443u, 0x501A1B47u, 0x54535251u, 0x2B575655u, 0xD0D0D02Au, 0xD0D0D0D0u,
    0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u,
    0x26252423u, 0x30292827u, 0x0F333231u, 0x0B0C0D0Eu, 0x4241400Au, 0x1D1E1F43u, 0x501A1B1Cu, 0x2F535251u, 0x2B2C2D2Eu, 0xD0D0D02Au,
    0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u);
// Mode by code; codes 0 and 1 are two bits long. Mode: transformed | subsets << 1 | bits << 3 | delta bits << 8, 13, 18.
const int BC6H_MODE[32] = int[32](0, 1, 2, 10, -1, -1, 3, 11, -1, -1, 4, 12, -1, -1, 5, 13, -1, -1, 6, -1, -1, -1, 7, -1, -1, -1, 8, -1, -1, -1, 9, -1);
const uint BC6H_SHAPE[14] = uint[14](0x14A555u, 0x18C63Du, 0x10855Du, 0x10A45Du, 0x14845Du, 0x14A54Du, 0x14A645u, 0x14C545u, 0x18A545u, 0x18C634u, 0x294A52u, 0x25295Bu, 0x210863u, 0x108483u);

int sign_extend(int value, int bits) { return value << (32 - bits) >> (32 - bits); }

int unquantize(int code, int bits, bool is_signed) {
    if (!is_signed) {
        if (bits >= 15 || code == 0) return code;
        return code == (1 << bits) - 1 ? 0xFFFF : ((code << 16) + 0x8000) >> bits;
    }
    if (bits >= 16 || code == 0) return code;
    int magnitude = abs(code), value = magnitude >= (1 << (bits - 1)) - 1 ? 0x7FFF : ((magnitude << 15) + 0x4000) >> (bits - 1);
    return code < 0 ? -value : value;
}

// The float of a half's bits; small ones are not flushed.
float half_value(uint bits) {
    uint exponent = bits >> 10 & 31u, mantissa = bits & 1023u;
    float magnitude = exponent == 0u ? float(mantissa) / 16777216.0
                                     : uintBitsToFloat(exponent == 31u ? 0x7F800000u | mantissa << 13 : (exponent + 112u) << 23 | mantissa << 13);
    return (bits & 0x8000u) != 0u ? -magnitude : magnitude;
}

vec4 decode_bc6h(uvec4 block, uint texel, bool is_signed) {
    int mode = (block.x & 2u) == 0u ? int(block.x & 1u) : BC6H_MODE[block.x & 31u];
    if (mode < 0) return vec4(0.0, 0.0, 0.0, 1.0);
    uint shape = BC6H_SHAPE[mode], subsets = shape >> 1 & 3u;
    int bits = int(shape >> 3 & 31u), code[14];
    bool transformed = (shape & 1u) != 0u;
    for (int i = 0; i < 14; ++i) code[i] = 0;
    uint count = subsets == 2u ? 82u : 65u;
    for (uint i = 0u; i < count; ++i) {
        uint to = BC6H_BITS[(uint(mode) * 84u + i) / 4u] >> 8u * (i % 4u) & 255u;
        code[to >> 4] |= int(block_bits(block, i, 1u) << (to & 15u));
    }
    uint parting = uint(code[12]), subset = texel_subset(subsets, parting, texel), index_bits = subsets == 2u ? 3u : 4u;
    uint index = texel_index(block, count, index_bits, texel, anchors_of(subsets, parting), subsets);
    vec4 colour = vec4(1.0);
    for (uint c = 0u; c < 3u; ++c) {
        int delta_bits = int(shape >> (8u + 5u * c) & 31u), base = code[c], end_point[2];
        if (is_signed) base = sign_extend(base, bits);
        for (uint side = 0u; side < 2u; ++side) {
            uint e = 2u * subset + side;
            int value = base;
            if (e > 0u) {
                value = code[3u * e + c];
                if (is_signed || transformed) value = sign_extend(value, delta_bits);
                if (transformed) {
                    value = base + value & (1 << bits) - 1;
                    if (is_signed) value = sign_extend(value, bits);
                }
            }
            end_point[side] = unquantize(value, bits, is_signed);
        }
        int value = interpolate(end_point[0], end_point[1], index, index_bits);
        uint half_bits = uint(value * 31 >> 6);
        if (is_signed) {
            uint magnitude = uint(abs(value) * 31 >> 5);
            half_bits = value < 0 && magnitude > 0u ? 0x8000u | magnitude : magnitude;
        }
        colour[c] = half_value(half_bits);
    }
    return colour;
}

// Linear RGBA of texel 0..15 of a block, row by row. Missing channels are 0, a missing alpha is 1.
vec4 decode_texel(uint format, uvec4 block, uint texel) {
    if (format == FORMAT_BC1_RGB || format == FORMAT_BC1_RGBA) return decode_colour(block.xy, texel, false, format == FORMAT_BC1_RGBA);
    if (format == FORMAT_BC2) return vec4(decode_colour(block.zw, texel, true, false).rgb, float(block_bits(block, 4u * texel, 4u)) / 15.0);
    if (format == FORMAT_BC3) return vec4(decode_colour(block.zw, texel, true, false).rgb, decode_ramp(block.xy, texel, false));
    if (format == FORMAT_BC4 || format == FORMAT_BC4_SNORM) return vec4(decode_ramp(block.xy, texel, format == FORMAT_BC4_SNORM), 0.0, 0.0, 1.0);
    if (format == FORMAT_BC5 || format == FORMAT_BC5_SNORM) {
        bool is_signed = format == FORMAT_BC5_SNORM;
        return vec4(decode_ramp(block.xy, texel, is_signed), decode_ramp(block.zw, texel, is_signed), 0.0, 1.0);
    }
    if (format == FORMAT_BC7) return decode_bc7(block, texel);
    return decode_bc6h(block, texel, format == FORMAT_BC6H_SFLOAT);
}

#endif
