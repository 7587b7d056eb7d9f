// Texels of compressed blocks: BC1 to BC7 (D3D11.3 19.5; BC6H and BC7 as ARB_texture_compression_bptc has them, bit for bit). BC1 to BC5 are
// interpolated as exact fractions of their codes.
const FORMAT_BC1_RGB: u32 = 18u;
const FORMAT_BC1_RGBA: u32 = 20u;
const FORMAT_BC2: u32 = 22u;
const FORMAT_BC3: u32 = 24u;
const FORMAT_BC4: u32 = 26u;
const FORMAT_BC4_SNORM: u32 = 27u;
const FORMAT_BC5: u32 = 28u;
const FORMAT_BC5_SNORM: u32 = 29u;
const FORMAT_BC6H_UFLOAT: u32 = 30u;
const FORMAT_BC6H_SFLOAT: u32 = 31u;
const FORMAT_BC7: u32 = 32u;

// 32-bit words of a block.
fn block_words(format: u32) -> u32 {
    return select(4u, 2u, (((format == FORMAT_BC1_RGB) || (format == FORMAT_BC1_RGBA)) || (format == FORMAT_BC4)) || (format == FORMAT_BC4_SNORM));
}

// `count` bits of a block from bit `first`, at most 32.
fn block_bits(block: vec4u, first: u32, count: u32) -> u32 {
    if (count == 0u) {
        return 0u;
    }
    let word: u32 = first / 32u;
    let shift: u32 = first % 32u;
    var low: u32 = block[word] >> u32(shift);
    if ((shift + count) > 32u) {
        low |= block[word + 1u] << u32(32u - shift);
    }
    return select(low & ((1u << u32(count)) - 1u), low, count == 32u);
}

fn colour_565(code: u32) -> vec3f {
    return vec3f(f32(code >> 11) / 31.0, f32((code >> 5) & 63u) / 63.0, f32(code & 31u) / 31.0);
}

// BC2 and BC3 take four colours whatever the order of their end points.
fn decode_colour(block: vec2u, texel: u32, always_four: bool, has_alpha: bool) -> vec4f {
    let a: u32 = block.x & 0xFFFFu;
    let b: u32 = block.x >> 16;
    let index: u32 = (block.y >> u32(2u * texel)) & 3u;
    let first: vec3f = colour_565(a);
    let second: vec3f = colour_565(b);
    if (index == 0u) {
        return vec4f(first, 1.0);
    }
    if (index == 1u) {
        return vec4f(second, 1.0);
    }
    if (always_four || (a > b)) {
        return vec4f(select((first + (2.0 * second)) / 3.0, ((2.0 * first) + second) / 3.0, index == 2u), 1.0);
    }
    return select(vec4f(0.0, 0.0, 0.0, select(1.0, 0.0, has_alpha)), vec4f(0.5 * (first + second), 1.0), index == 2u);
}

// One value of 8 bytes. The order of signed end points is that of the raw codes; -128 then means -127.
fn decode_ramp(block: vec2u, texel: u32, is_signed: bool) -> f32 {
    var a: i32 = i32(block.x & 255u);
    var b: i32 = i32((block.x >> 8) & 255u);
    if (is_signed) {
        a = (a << 24) >> 24;
        b = (b << 24) >> 24;
    }
    let index: u32 = block_bits(vec4u(block, 0u, 0u), 16u + (3u * texel), 3u);
    let eight: bool = a > b;
    let scale: f32 = select(255.0, 127.0, is_signed);
    let first: f32 = f32(select(a, max(a, -127), is_signed)) / scale;
    let second: f32 = f32(select(b, max(b, -127), is_signed)) / scale;
    if (index == 0u) {
        return first;
    }
    if (index == 1u) {
        return second;
    }
    let k: f32 = f32(index - 1u);
    if (eight) {
        return (((7.0 - k) * first) + (k * second)) / 7.0;
    }
    if (index == 6u) {
        return select(0.0, -1.0, is_signed);
    }
    if (index == 7u) {
        return 1.0;
    }
    return (((5.0 - k) * first) + (k * second)) / 5.0;
}

// Which of two subsets a texel belongs to, bit by bit; of three, two bits a texel.
const PARTITIONS_2: array<u32, 64> = array<u32, 64>(0xCCCCu, 0x8888u, 0xEEEEu, 0xECC8u, 0xC880u, 0xFEECu, 0xFEC8u, 0xEC80u, 0xC800u, 0xFFECu, 0xFE80u, 0xE800u, 0xFFE8u, 0xFF00u, 0xFFF0u, 0xF000u, 0xF710u, 0x008Eu, 0x7100u, 0x08CEu, 0x008Cu, 0x7310u, 0x3100u, 0x8CCEu, 0x088Cu, 0x3110u, 0x6666u, 0x366Cu, 0x17E8u, 0x0FF0u, 0x718Eu, 0x399Cu, 0xAAAAu, 0xF0F0u, 0x5A5Au, 0x33CCu, 0x3C3Cu, 0x55AAu, 0x9696u, 0xA55Au, 0x73CEu, 0x13C8u, 0x324Cu, 0x3BDCu, 0x6996u, 0xC33Cu, 0x9966u, 0x0660u, 0x0272u, 0x04E4u, 0x4E40u, 0x2720u, 0xC936u, 0x936Cu, 0x39C6u, 0x639Cu, 0x9336u, 0x9CC6u, 0x817Eu, 0xE718u, 0xCCF0u, 0x0FCCu, 0x7744u, 0xEE22u);
const PARTITIONS_3: array<u32, 64> = array<u32, 64>(0xAA685050u, 0x6A5A5040u, 0x5A5A4200u, 0x5450A0A8u, 0xA5A50000u, 0xA0A05050u, 0x5555A0A0u, 0x5A5A5050u, 0xAA550000u, 0xAA555500u, 0xAAAA5500u, 0x90909090u, 0x94949494u, 0xA4A4A4A4u, 0xA9A59450u, 0x2A0A4250u, 0xA5945040u, 0x0A425054u, 0xA5A5A500u, 0x55A0A0A0u, 0xA8A85454u, 0x6A6A4040u, 0xA4A45000u, 0x1A1A0500u, 0x0050A4A4u, 0xAAA59090u, 0x14696914u, 0x69691400u, 0xA08585A0u, 0xAA821414u, 0x50A4A450u, 0x6A5A0200u, 0xA9A58000u, 0x5090A0A8u, 0xA8A09050u, 0x24242424u, 0x00AA5500u, 0x24924924u, 0x24499224u, 0x50A50A50u, 0x500AA550u, 0xAAAA4444u, 0x66660000u, 0xA5A0A5A0u, 0x50A050A0u, 0x69286928u, 0x44AAAA44u, 0x66666600u, 0xAA444444u, 0x54A854A8u, 0x95809580u, 0x96969600u, 0xA85454A8u, 0x80959580u, 0xAA141414u, 0x96960000u, 0xAAAA1414u, 0xA05050A0u, 0xA0A5A5A0u, 0x96000000u, 0x40804080u, 0xA9A8A9A8u, 0xAAAAAA44u, 0x2A4A5254u);

// Texels whose index lacks its highest bit, beside texel 0: four bits each, of the second of two subsets, the second and the third of three.
const ANCHORS_2: array<u32, 8> = array<u32, 8>(0xFFFFFFFFu, 0xFFFFFFFFu, 0xF882282Fu, 0x22882282u, 0xFF8286FFu, 0x6FF22282u, 0x22FF8626u, 0xF22FFFFFu);
const ANCHORS_3A: array<u32, 8> = array<u32, 8>(0xFF38FF33u, 0x33566688u, 0xA633F833u, 0xFF586885u, 0xF8A653F8u, 0xFFFF5F3Fu, 0xA58555F3u, 0x33CFD8A5u);
const ANCHORS_3B: array<u32, 8> = array<u32, 8>(0x83FF388Fu, 0x8FFFFFFFu, 0x8F8F3F8Fu, 0x8AFFA6F3u, 0xA98AAF3Fu, 0x8663F8F6u, 0xFFFFFF3Fu, 0x8FF3FFFFu);

fn nibble(words: array<u32, 8>, i: u32) -> u32 {
    return (words[i / 8u] >> u32(4u * (i % 8u))) & 15u;
}
const WEIGHTS_2: array<i32, 4> = array<i32, 4>(0, 21, 43, 64);
const WEIGHTS_3: array<i32, 8> = array<i32, 8>(0, 9, 18, 27, 37, 46, 55, 64);
const WEIGHTS_4: array<i32, 16> = array<i32, 16>(0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64);

fn interpolate(first: i32, second: i32, index: u32, bits: u32) -> i32 {
    let w: i32 = select(select(WEIGHTS_4[index], WEIGHTS_3[index], bits == 3u), WEIGHTS_2[index], bits == 2u);
    return ((((64 - w) * first) + (w * second)) + 32) >> 6;
}

// The index of a texel: anchors, whose highest bit is 0, take one bit less.
fn texel_index(block: vec4u, first: u32, bits: u32, texel: u32, anchors: vec3u, subsets: u32) -> u32 {
    var at: u32 = first + (bits * texel);
    var wide: u32 = bits;
    for (var s: u32 = 0u; s < subsets; s++) {
        if (texel > anchors[s]) {
            at--;
        }
        if (texel == anchors[s]) {
            wide--;
        }
    }
    return block_bits(block, at, wide);
}

fn texel_subset(subsets: u32, parting: u32, texel: u32) -> u32 {
    if (subsets == 1u) {
        return 0u;
    }
    return select((PARTITIONS_3[parting] >> u32(2u * texel)) & 3u, (PARTITIONS_2[parting] >> u32(texel)) & 1u, subsets == 2u);
}

fn anchors_of(subsets: u32, parting: u32) -> vec3u {
    if (subsets == 2u) {
        return vec3u(0u, nibble(ANCHORS_2, parting), 16u);
    }
    if (subsets == 3u) {
        return vec3u(0u, nibble(ANCHORS_3A, parting), nibble(ANCHORS_3B, parting));
    }
    return vec3u(0u, 16u, 16u);
}

// Widths of a BC7 mode's fields: subsets, partition, rotation, selection; colour, alpha, p-bits an end point, p-bits a subset; indices.
const BC7_SHAPE: array<vec4u, 8> = array<vec4u, 8>(vec4u(3, 4, 0, 0), vec4u(2, 6, 0, 0), vec4u(3, 6, 0, 0), vec4u(2, 6, 0, 0), vec4u(1, 0, 2, 1), vec4u(1, 0, 2, 0), vec4u(1, 0, 0, 0), vec4u(2, 6, 0, 0));
const BC7_CODES: array<vec4u, 8> = array<vec4u, 8>(vec4u(4, 0, 1, 0), vec4u(6, 0, 0, 1), vec4u(5, 0, 0, 0), vec4u(7, 0, 1, 0), vec4u(5, 6, 0, 0), vec4u(7, 8, 0, 0), vec4u(7, 7, 1, 0), vec4u(5, 5, 1, 0));
const BC7_INDICES: array<vec2u, 8> = array<vec2u, 8>(vec2u(3, 0), vec2u(3, 0), vec2u(2, 0), vec2u(2, 0), vec2u(2, 3), vec2u(2, 2), vec2u(4, 0), vec2u(2, 0));

// A code of `bits` bits to 8: its highest bits are repeated below.
fn widen(code: u32, bits: u32) -> i32 {
    let high: u32 = code << u32(8u - bits);
    return i32(high | (high >> u32(bits)));
}

fn decode_bc7(block: vec4u, texel: u32) -> vec4f {
    if ((block.x & 255u) == 0u) {
        return vec4f(0.0);
    }
    let mode: u32 = u32(firstTrailingBit(block.x));
    let shape: vec4u = BC7_SHAPE[mode];
    let codes: vec4u = BC7_CODES[mode];
    let index_bits: vec2u = BC7_INDICES[mode];
    var at: u32 = mode + 1u;
    let parting: u32 = block_bits(block, at, shape.y);
    at += shape.y;
    let rotation: u32 = block_bits(block, at, shape.z);
    at += shape.z;
    let selection: u32 = block_bits(block, at, shape.w);
    at += shape.w;
    let ends: u32 = 2u * shape.x;
    let colours: u32 = at;
    let alphas: u32 = colours + ((3u * ends) * codes.x);
    let p_bits: u32 = alphas + (ends * codes.y);
    let indices: u32 = (p_bits + (ends * codes.z)) + (shape.x * codes.w);
    let second_indices: u32 = (indices + (16u * index_bits.x)) - shape.x;
    let subset: u32 = texel_subset(shape.x, parting, texel);
    var end_point: array<vec4i, 2>;
    for (var side: u32 = 0u; side < 2u; side++) {
        let e: u32 = (2u * subset) + side;
        let has_p: u32 = codes.z + codes.w;
        let p: u32 = block_bits(block, p_bits + (select(e, subset, codes.w > 0u)), has_p);
        for (var c: u32 = 0u; c < 4u; c++) {
            var bits: u32 = select(codes.y, codes.x, c < 3u);
            let code: u32 = block_bits(block, select(alphas + (e * bits), colours + (((c * ends) + e) * bits), c < 3u), bits);
            end_point[side][c] = select(widen((code << u32(has_p)) | p, bits + has_p), 255, bits == 0u);
        }
    }
    let anchors: vec3u = anchors_of(shape.x, parting);
    var first: u32 = texel_index(block, indices, index_bits.x, texel, anchors, shape.x);
    var second: u32 = first;
    var bits: vec2u = vec2u(index_bits.x);
    if (index_bits.y > 0u) {
        second = texel_index(block, second_indices, index_bits.y, texel, vec3u(0u, 16u, 16u), 1u);
        bits.y = index_bits.y;
    }
    if (selection == 1u) {
        var kept: u32 = first;
        first = second;
        second = kept;
        bits = bits.yx;
    }
    var colour: vec4i;
    for (var c: i32 = 0; c < 4; c++) {
        colour[c] = interpolate(end_point[0][c], end_point[1][c], select(second, first, c < 3), select(bits.y, bits.x, c < 3));
    }
    if (rotation > 0u) {
        let channel: i32 = i32(rotation) - 1;
        var kept: i32 = colour.a;
        colour.a = colour[channel];
        colour[channel] = kept;
    }
    return vec4f(colour) / 255.0;
}

// Where the bits of a BC6H block go, mode by mode in 84 bytes: variable << 4 | bit. Variables are 3*end point + channel, 12 is the partition.
const BC6H_BITS: array<u32, 294> = array<u32, 294>(0x8474D1D0u, 0x020100B4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xA475D1D0u, 0x020100A5u, 0x06050403u, 0x1084B1B0u, 0x14131211u, 0xB2851615u, 0x22212074u, 0x26252423u, 0x30B4B5B3u, 0x34333231u, 0x72717035u, 0x42414073u, 0xA0454443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90656463u, 0x94939291u, 0xC2C1C095u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u, 0x7271700Au, 0x42414073u, 0xA0B01A43u, 0x50A3A2A1u, 0x2A535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x0A333231u, 0x727170A4u, 0x42414073u, 0xA01A4443u, 0x50A3A2A1u, 0x2A535251u, 0x828180B1u, 0x62616083u, 0x90B2B063u, 0x74939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x0A333231u, 0x72717084u, 0x42414073u, 0xA0B01A43u, 0x50A3A2A1u, 0x54535251u, 0x8281802Au, 0x62616083u, 0x90B2B163u, 0xB4939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10840807u, 0x14131211u, 0x18171615u, 0x22212074u, 0x26252423u, 0x30B42827u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x1084A407u, 0x14131211u, 0xB2171615u, 0x22212074u, 0x26252423u, 0x30B4B327u, 0x34333231u, 0x72717035u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90656463u, 0x94939291u, 0xC2C1C095u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x1084B007u, 0x14131211u, 0x75171615u, 0x22212074u, 0x26252423u, 0x30B4A527u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0454443u, 0x50A3A2A1u, 0x54535251u, 0x828180B1u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x1084B107u, 0x14131211u, 0x85171615u, 0x22212074u, 0x26252423u, 0x30B4B527u, 0x34333231u, 0x727170A4u, 0x42414073u, 0xA0B04443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90B26463u, 0x94939291u, 0xC2C1C0B3u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0xA4050403u, 0x1084B1B0u, 0x14131211u, 0xB2857515u, 0x22212074u, 0xA5252423u, 0x30B4B5B3u, 0x34333231u, 0x72717035u, 0x42414073u, 0xA0454443u, 0x50A3A2A1u, 0x54535251u, 0x82818055u, 0x62616083u, 0x90656463u, 0x94939291u, 0xC2C1C095u, 0xD0D0C4C3u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u, 0x38373635u, 0x42414039u, 0x46454443u, 0x50494847u, 0x54535251u, 0x58575655u, 0xD0D0D059u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u, 0x38373635u, 0x4241400Au, 0x46454443u, 0x501A4847u, 0x54535251u, 0x58575655u, 0xD0D0D02Au, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x34333231u, 0x0B373635u, 0x4241400Au, 0x46454443u, 0x501A1B47u, 0x54535251u, 0x2B575655u, 0xD0D0D02Au, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD3D2D1D0u, 0x020100D4u, 0x06050403u, 0x10090807u, 0x14131211u, 0x18171615u, 0x22212019u, 0x26252423u, 0x30292827u, 0x0F333231u, 0x0B0C0D0Eu, 0x4241400Au, 0x1D1E1F43u, 0x501A1B1Cu, 0x2F535251u, 0x2B2C2D2Eu, 0xD0D0D02Au, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u, 0xD0D0D0D0u);

// Mode by code; codes 0 and 1 are two bits long. Mode: transformed | subsets << 1 | bits << 3 | delta bits << 8, 13, 18.
const BC6H_MODE: array<i32, 32> = array<i32, 32>(0, 1, 2, 10, -1, -1, 3, 11, -1, -1, 4, 12, -1, -1, 5, 13, -1, -1, 6, -1, -1, -1, 7, -1, -1, -1, 8, -1, -1, -1, 9, -1);
const BC6H_SHAPE: array<u32, 14> = array<u32, 14>(0x14A555u, 0x18C63Du, 0x10855Du, 0x10A45Du, 0x14845Du, 0x14A54Du, 0x14A645u, 0x14C545u, 0x18A545u, 0x18C634u, 0x294A52u, 0x25295Bu, 0x210863u, 0x108483u);

fn sign_extend(value: i32, bits: i32) -> i32 {
    return (value << u32(32 - bits)) >> u32(32 - bits);
}

fn unquantize(code: i32, bits: i32, is_signed: bool) -> i32 {
    if (!is_signed) {
        if ((bits >= 15) || (code == 0)) {
            return code;
        }
        return select(((code << 16) + 0x8000) >> u32(bits), 0xFFFF, code == ((1 << u32(bits)) - 1));
    }
    if ((bits >= 16) || (code == 0)) {
        return code;
    }
    let magnitude: i32 = abs(code);
    let value: i32 = select(((magnitude << 15) + 0x4000) >> u32(bits - 1), 0x7FFF, magnitude >= ((1 << u32(bits - 1)) - 1));
    return select(value, -value, code < 0);
}

// The float of a half's bits; small ones are not flushed.
fn half_value(bits: u32) -> f32 {
    let exponent: u32 = (bits >> 10) & 31u;
    let mantissa: u32 = bits & 1023u;
    let magnitude: f32 = select(bitcast<f32>(select(((exponent + 112u) << 23) | (mantissa << 13), 0x7F800000u | (mantissa << 13), exponent == 31u)), f32(mantissa) / 16777216.0, exponent == 0u);
    return select(magnitude, -magnitude, (bits & 0x8000u) != 0u);
}

fn decode_bc6h(block: vec4u, texel: u32, is_signed: bool) -> vec4f {
    let mode: i32 = select(BC6H_MODE[block.x & 31u], i32(block.x & 1u), (block.x & 2u) == 0u);
    if (mode < 0) {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    let shape: u32 = BC6H_SHAPE[mode];
    let subsets: u32 = (shape >> 1) & 3u;
    let bits: i32 = i32((shape >> 3) & 31u);
    var code: array<i32, 14>;
    let transformed: bool = (shape & 1u) != 0u;
    for (var i: i32 = 0; i < 14; i++) {
        code[i] = 0;
    }
    let count: u32 = select(65u, 82u, subsets == 2u);
    for (var i: u32 = 0u; i < count; i++) {
        let to: u32 = (BC6H_BITS[((u32(mode) * 84u) + i) / 4u] >> u32(8u * (i % 4u))) & 255u;
        code[to >> 4] |= i32(block_bits(block, i, 1u) << u32(to & 15u));
    }
    let parting: u32 = u32(code[12]);
    let subset: u32 = texel_subset(subsets, parting, texel);
    let index_bits: u32 = select(4u, 3u, subsets == 2u);
    let index: u32 = texel_index(block, count, index_bits, texel, anchors_of(subsets, parting), subsets);
    var colour: vec4f = vec4f(1.0);
    for (var c: u32 = 0u; c < 3u; c++) {
        let delta_bits: i32 = i32((shape >> u32(8u + (5u * c))) & 31u);
        var base: i32 = code[c];
        var end_point: array<i32, 2>;
        if (is_signed) {
            base = sign_extend(base, bits);
        }
        for (var side: u32 = 0u; side < 2u; side++) {
            let e: u32 = (2u * subset) + side;
            var value: i32 = base;
            if (e > 0u) {
                value = code[(3u * e) + c];
                if (is_signed || transformed) {
                    value = sign_extend(value, delta_bits);
                }
                if (transformed) {
                    value = (base + value) & ((1 << u32(bits)) - 1);
                    if (is_signed) {
                        value = sign_extend(value, bits);
                    }
                }
            }
            end_point[side] = unquantize(value, bits, is_signed);
        }
        var value: i32 = interpolate(end_point[0], end_point[1], index, index_bits);
        var half_bits: u32 = u32((value * 31) >> 6);
        if (is_signed) {
            let magnitude: u32 = u32((abs(value) * 31) >> 5);
            half_bits = select(magnitude, 0x8000u | magnitude, (value < 0) && (magnitude > 0u));
        }
        colour[c] = half_value(half_bits);
    }
    return colour;
}

// Linear RGBA of texel 0..15 of a block, row by row. Missing channels are 0, a missing alpha is 1.
fn decode_texel(format: u32, block: vec4u, texel: u32) -> vec4f {
    if ((format == FORMAT_BC1_RGB) || (format == FORMAT_BC1_RGBA)) {
        return decode_colour(block.xy, texel, false, format == FORMAT_BC1_RGBA);
    }
    if (format == FORMAT_BC2) {
        return vec4f(decode_colour(block.zw, texel, true, false).rgb, f32(block_bits(block, 4u * texel, 4u)) / 15.0);
    }
    if (format == FORMAT_BC3) {
        return vec4f(decode_colour(block.zw, texel, true, false).rgb, decode_ramp(block.xy, texel, false));
    }
    if ((format == FORMAT_BC4) || (format == FORMAT_BC4_SNORM)) {
        return vec4f(decode_ramp(block.xy, texel, format == FORMAT_BC4_SNORM), 0.0, 0.0, 1.0);
    }
    if ((format == FORMAT_BC5) || (format == FORMAT_BC5_SNORM)) {
        let is_signed: bool = format == FORMAT_BC5_SNORM;
        return vec4f(decode_ramp(block.xy, texel, is_signed), decode_ramp(block.zw, texel, is_signed), 0.0, 1.0);
    }
    if (format == FORMAT_BC7) {
        return decode_bc7(block, texel);
    }
    return decode_bc6h(block, texel, format == FORMAT_BC6H_SFLOAT);
}
