#include "cli/vectors/port_record.h"

#include <array>

namespace rawtexel::cli {
namespace {

constexpr WordType I = WordType::Int, U = WordType::Uint, F = WordType::Float;

#define FIELD(type, record, member, count) \
    RecordField { #member, int(offsetof(record, member) / 4), type, count }
constexpr std::array kCaseFields = {FIELD(U, CaseRecord, op, 1),           FIELD(U, CaseRecord, texture, 1),
                                    FIELD(U, CaseRecord, wrap_s, 1),       FIELD(U, CaseRecord, wrap_t, 1),
                                    FIELD(U, CaseRecord, wrap_r, 1),       FIELD(U, CaseRecord, minify, 1),
                                    FIELD(F, CaseRecord, minify_b, 1),     FIELD(F, CaseRecord, minify_c, 1),
                                    FIELD(U, CaseRecord, magnify, 1),      FIELD(F, CaseRecord, magnify_b, 1),
                                    FIELD(F, CaseRecord, magnify_c, 1),    FIELD(U, CaseRecord, estimator, 1),
                                    FIELD(U, CaseRecord, mip, 1),          FIELD(U, CaseRecord, lod_rule, 1),
                                    FIELD(I, CaseRecord, probes, 1),       FIELD(F, CaseRecord, probe_variance, 1),
                                    FIELD(F, CaseRecord, ellipse, 1),      FIELD(F, CaseRecord, hybrid_bias, 1),
                                    FIELD(F, CaseRecord, lod_bias, 1),     FIELD(F, CaseRecord, min_lod, 1),
                                    FIELD(F, CaseRecord, max_lod, 1),      FIELD(F, CaseRecord, border, 4),
                                    FIELD(F, CaseRecord, at, 3),           FIELD(F, CaseRecord, dx, 3),
                                    FIELD(F, CaseRecord, dy, 3),           FIELD(F, CaseRecord, layer, 1),
                                    FIELD(F, CaseRecord, number_x, 1),     FIELD(F, CaseRecord, number_y, 1),
                                    FIELD(F, CaseRecord, number_z, 1),     FIELD(F, CaseRecord, number_level, 1),
                                    FIELD(F, CaseRecord, number_probe, 1), FIELD(F, CaseRecord, number_sign, 1),
                                    FIELD(F, CaseRecord, negative_x, 1),   FIELD(F, CaseRecord, negative_y, 1),
                                    FIELD(F, CaseRecord, negative_z, 1),   FIELD(F, CaseRecord, negative_sign, 1),
                                    FIELD(I, CaseRecord, index, 1),        FIELD(I, CaseRecord, extent, 1),
                                    FIELD(U, CaseRecord, pixel_x, 1),      FIELD(U, CaseRecord, pixel_y, 1),
                                    FIELD(U, CaseRecord, sample, 1),       FIELD(U, CaseRecord, surface, 1),
                                    FIELD(U, CaseRecord, dimension, 1),    FIELD(U, CaseRecord, seed, 1),
                                    FIELD(U, CaseRecord, noise, 1),        FIELD(U, CaseRecord, second_dimension, 1),
                                    FIELD(U, CaseRecord, count, 1),        FIELD(U, CaseRecord, order, 1),
                                    FIELD(U, CaseRecord, shader, 1)};

constexpr std::array kResultFields = {FIELD(I, PortResult, x, 1),
                                      FIELD(I, PortResult, y, 1),
                                      FIELD(I, PortResult, slice, 1),
                                      FIELD(I, PortResult, level, 1),
                                      FIELD(F, PortResult, weight, 1),
                                      FIELD(I, PortResult, negative_x, 1),
                                      FIELD(I, PortResult, negative_y, 1),
                                      FIELD(I, PortResult, negative_slice, 1),
                                      FIELD(F, PortResult, negative_weight, 1),
                                      FIELD(F, PortResult, lod, 1),
                                      FIELD(I, PortResult, probes, 1),
                                      FIELD(U, PortResult, bits, 1),
                                      FIELD(F, PortResult, value, 4)};

constexpr std::array kTextureFields = {
    FIELD(U, TextureRecord, width, 1),  FIELD(U, TextureRecord, height, 1),     FIELD(U, TextureRecord, depth, 1),
    FIELD(U, TextureRecord, layers, 1), FIELD(U, TextureRecord, levels, 1),     FIELD(U, TextureRecord, cube, 1),
    FIELD(U, TextureRecord, format, 1), FIELD(U, TextureRecord, first_word, 1), FIELD(U, TextureRecord, first_texel, 16)};
#undef FIELD

}  // namespace

std::span<const RecordField> case_fields() { return kCaseFields; }
std::span<const RecordField> result_fields() { return kResultFields; }
std::span<const RecordField> texture_fields() { return kTextureFields; }

std::string_view to_string(WordType type) {
    static constexpr std::string_view kNames[] = {"int", "uint", "float"};
    return kNames[size_t(type)];
}

std::string_view to_string(PortOp op) {
    static constexpr std::string_view kNames[kPortOps] = {"wrap-index",  "sample",      "draw",   "mean",       "shade", "srgb-decode",
                                                          "srgb-encode", "block-texel", "random", "noise-pair", "plane"};
    return size_t(op) < std::size(kNames) ? kNames[size_t(op)] : "unknown";
}

}  // namespace rawtexel::cli
