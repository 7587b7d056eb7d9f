// What goes into a port of a sampler and what comes out: fixed records of 32-bit words, the same in files, in storage buffers and here.
// The layout is a contract (docs/porting.md); words may be added where there are none, and kVectorVersion counts what changes otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace rawtexel::cli {

inline constexpr int kVectorVersion = 1;

/// What a case asks for. Values are fixed.
enum class PortOp : uint32_t {
    WrapIndex = 0,   ///< the texel that `index` means in an axis of `extent` texels under wrap_s: x
    Sample = 1,      ///< every tap weighed: value, lod, probes
    Draw = 2,        ///< one draw with the numbers of the case: texel, level, weight, and of negative lobes the same; value
    Mean = 3,        ///< the mean of `count` draws with random numbers of samples 0, 1, … at the case's address: value
    Shade = 4,       ///< `shader` of every tap, averaged (order 1), or of the mean (order 0): value
    SrgbDecode = 5,  ///< linear value of the code `index`: value[0]
    SrgbEncode = 6,  ///< code of the linear value u: bits
    BlockTexel = 7,  ///< texel (index, extent) of a compressed texture, decoded: value
    Random = 8,      ///< bits of the address, and the number in [0, 1) they make: bits, value[0]
    NoisePair = 9,   ///< numbers of two dimensions at the address: value[0], value[1]
    Plane = 10,      ///< weights of the three planes of the normal (u, v, w), and the one that is drawn: value, x
};
inline constexpr int kPortOps = 11;

/// One case, 64 words. Enumerations are numbered as in texunit's headers; of fields that an op does not look at the value means nothing.
struct CaseRecord {
    PortOp op = PortOp::Sample;
    uint32_t texture = 0;                         ///< which one of the suite
    uint32_t wrap_s = 0, wrap_t = 0, wrap_r = 0;  ///< 0 repeat, 1 mirror, 2 clamp, 3 border, 4 mirror-once
    uint32_t minify = 1;                          ///< kernel: 0 nearest, 1 bilinear, … 9 gaussian-point
    float minify_b = 0, minify_c = 0;             ///< Mitchell's B and C; sigma
    uint32_t magnify = 1;                         ///< the kernel where lambda <= 0
    float magnify_b = 0, magnify_c = 0;
    uint32_t estimator = 0;  ///< 0 all, 1 reservoir, 2 jitter, 3 abs-weight
    uint32_t mip = 0;        ///< 0 none, 1 nearest, 2 linear
    uint32_t lod_rule = 0;   ///< 0 d3d, 1 exact
    int32_t probes = 1;
    float probe_variance = 0, ellipse = 0;
    float hybrid_bias = std::numeric_limits<float>::infinity();  ///< of drawn ellipses; infinite: level 0
    float lod_bias = 0, min_lod = 0, max_lod = 1000;
    std::array<float, 4> border{};
    std::array<float, 3> at{};        ///< u, v; u, v, w; or a direction
    std::array<float, 3> dx{}, dy{};  ///< change of it over one pixel
    float layer = 0;
    float number_x = 0, number_y = 0, number_z = 0, number_level = 0, number_probe = 0, number_sign = 0;
    float negative_x = 0, negative_y = 0, negative_z = 0, negative_sign = 0;  ///< of the texel of negative weights
    int32_t index = 0, extent = 0;
    uint32_t pixel_x = 0, pixel_y = 0, sample = 0, surface = 0, dimension = 0, seed = 0;  ///< a random number's address
    uint32_t noise = 0;                                                                   ///< 0 white, 1 sobol, 2 r2, 3 blue, 4 stbn
    uint32_t second_dimension = 0;
    uint32_t count = 0;              ///< of draws; of planes the sharpness
    uint32_t order = 0, shader = 0;  ///< shader: 0 the texel itself, 1 its square, 2 F0 of base colour and metalness
    std::array<uint32_t, 6> spare{};

    bool operator==(const CaseRecord&) const = default;
};
static_assert(sizeof(CaseRecord) == 64 * 4);

/// What a port answers, 16 words. What an op does not give is not looked at.
struct PortResult {
    int32_t x = 0, y = 0, slice = 0, level = 0;  ///< the texel; x and y are -1 for the border
    float weight = 0;
    int32_t negative_x = 0, negative_y = 0, negative_slice = 0;  ///< of `level`
    float negative_weight = 0;                                   ///< magnitude
    float lod = 0;                                               ///< clamped to the levels there are
    int32_t probes = 0;
    uint32_t bits = 0;
    std::array<float, 4> value{};
};
inline constexpr size_t kResultWords = 16;
static_assert(sizeof(PortResult) == kResultWords * 4);

/// What is legal: field by field the expected value and an interval around it, both ends legal; only fields with their bit in `judged`.
struct Expectation {
    PortResult expected, least, most;
    uint32_t judged = 0;
    std::array<uint32_t, 15> spare{};
};
static_assert(sizeof(Expectation) == 64 * 4);

/// A texture of a suite as ports see it, 32 words. Texels of level l begin at first_texel[l], slice by slice, row by row.
struct TextureRecord {
    uint32_t width = 1, height = 1, depth = 1, layers = 1, levels = 1;
    uint32_t cube = 0;
    uint32_t format = 0;      ///< a texunit::Format
    uint32_t first_word = 0;  ///< of the stored texels or blocks in blocks.bin, where the format is not 32-bit floats
    std::array<uint32_t, 16> first_texel{};
    std::array<uint32_t, 8> spare{};
};
static_assert(sizeof(TextureRecord) == 32 * 4);

enum class WordType : uint8_t { Int, Uint, Float };
struct RecordField {
    std::string_view name;
    int word;  ///< its place
    WordType type;
    int count = 1;  ///< words
};
std::span<const RecordField> case_fields();
std::span<const RecordField> result_fields();
std::span<const RecordField> texture_fields();

std::string_view to_string(WordType type);  // int uint float
std::string_view to_string(PortOp op);      // wrap-index sample draw mean shade srgb-decode srgb-encode block-texel random noise-pair plane

/// Bits of Expectation::judged.
constexpr uint32_t judges(size_t word) { return 1u << word; }
inline constexpr uint32_t kJudgesTexel = 0x3, kJudgesSlice = judges(2), kJudgesLevel = judges(3), kJudgesWeight = judges(4),
                          kJudgesNegativeTexel = judges(5) | judges(6), kJudgesNegativeSlice = judges(7), kJudgesNegativeWeight = judges(8),
                          kJudgesLod = judges(9), kJudgesProbes = judges(10), kJudgesBits = judges(11), kJudgesValue = 0xFu << 12;

}  // namespace rawtexel::cli
