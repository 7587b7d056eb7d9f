#include "cli/vectors/diagnosis.h"

#include "cli/vectors/expectation.h"
#include "cli/vectors/hardware_report.h"
#include "cli/vectors/legal_case.h"
#include "cli/vectors/suspect.h"
#include "texunit/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>

namespace rawtexel::cli {
namespace {

using texunit::Estimator;
using texunit::Kernel;
using texunit::KernelKind;
using texunit::Shape;
using texunit::Wrap;

using Change = std::function<void(CaseRecord&)>;

void try_addresses(const Suspect& s, Detective& detective) {
    const Shape& shape = s.shape();
    const std::array<int, 3> extent = {shape.width, shape.height, shape.depth};
    const size_t axes = shape.depth > 1 ? 3 : 2;
    if (!shape.cube) {
        detective.try_change("clamped to [1/N, 1 - 1/N] before floor: texel 0 out of reach", [=](CaseRecord& c) {
            for (size_t axis = 0; axis < 2; ++axis) {
                if ((axis == 0 ? c.wrap_s : c.wrap_t) >= uint32_t(Wrap::ClampToEdge))
                    c.at[axis] = std::clamp(c.at[axis], 1 / float(extent[axis]), 1 - 1 / float(extent[axis]));
            }
        });
        static constexpr const char* kShifts[3][2] = {{"half a texel left", "half a texel right"},
                                                      {"half a texel up", "half a texel down"},
                                                      {"half a slice before", "half a slice behind"}};
        const int level = std::clamp(s.expectation.expected.level, 0, shape.levels - 1);
        const auto half = [&](size_t axis) { return 0.5f / float(texunit::level_extent(extent[axis], level)); };
        for (const bool after : {false, true}) {
            const float sign = after ? 1.0f : -1.0f;
            detective.try_change(after ? "half a texel right and down" : "half a texel left and up", [=](CaseRecord& c) {
                for (size_t axis = 0; axis < 2; ++axis) c.at[axis] += sign * half(axis);
            });
            for (size_t axis = 0; axis < axes; ++axis)
                detective.try_change(kShifts[axis][after], [=](CaseRecord& c) { c.at[axis] += sign * half(axis); });
        }
        for (uint32_t wrap = 0; wrap < 5; ++wrap) {
            const std::string name = "wrapped as " + std::string(to_string(Wrap(wrap)));
            detective.try_change(name, [=](CaseRecord& c) { c.wrap_s = c.wrap_t = c.wrap_r = wrap; });
            detective.try_change(name, [=](CaseRecord& c) { c.wrap_s = wrap; });
            detective.try_change(name, [=](CaseRecord& c) { c.wrap_t = wrap; });
            detective.try_change(name, [=](CaseRecord& c) { c.wrap_r = wrap; });
        }
        detective.try_change("coordinates scaled before their whole repeats are taken away: the fraction is lost", [=](CaseRecord& c) {
            for (size_t axis = 0; axis < 2; ++axis) {
                const float scaled = c.at[axis] * float(extent[axis]);
                const double period = 2.0 * extent[axis];
                if (std::isfinite(scaled))
                    c.at[axis] = float((double(scaled) - period * std::floor(double(scaled) / period)) / extent[axis]);
            }
        });
        detective.try_change("the border colour left out", [](CaseRecord& c) { c.border = {}; });
        detective.try_change("the border has alpha 1 and no colour", [](CaseRecord& c) { c.border = {0, 0, 0, 1}; });
        detective.try_change("wraps of the two axes swapped", [](CaseRecord& c) { std::swap(c.wrap_s, c.wrap_t); });
        detective.try_change("u and v swapped", [](CaseRecord& c) { std::swap(c.at[0], c.at[1]); });
        detective.try_change("u flipped", [](CaseRecord& c) { c.at[0] = 1 - c.at[0]; });
        detective.try_change("v flipped", [](CaseRecord& c) { c.at[1] = 1 - c.at[1]; });
    }
    detective.try_change("layer 0", [](CaseRecord& c) { c.layer = 0; });
    for (const float step : {-1.0f, 1.0f})
        detective.try_change("layer off by one", [=](CaseRecord& c) { c.layer = std::round(c.layer) + step; });
}

void try_levels(const Suspect& s, Detective& detective) {
    if (s.record.mip == 0 && s.record.magnify == s.record.minify) return;
    const auto try_it = [&](const char* name, const Change& change) { detective.try_change(name, change); };
    try_it("bias of the level left out", [](CaseRecord& c) { c.lod_bias = 0; });
    try_it("derivatives left out where there is a bias", [](CaseRecord& c) {
        if (c.lod_bias != 0) c.dx = c.dy = {};
    });
    try_it("bias taken twice", [](CaseRecord& c) { c.lod_bias *= 2; });
    try_it("bias of the wrong sign", [](CaseRecord& c) { c.lod_bias = -c.lod_bias; });
    try_it("bounds of the level left out", [](CaseRecord& c) { c.min_lod = 0, c.max_lod = 1000; });
    try_it("the upper bound of the level wins", [](CaseRecord& c) { c.min_lod = std::min(c.min_lod, c.max_lod); });
    try_it("the longer axis and the shorter one swapped", [](CaseRecord& c) {
        const float x = std::hypot(c.dx[0], c.dx[1]), y = std::hypot(c.dy[0], c.dy[1]);
        (x < y ? c.dy : c.dx) = x < y ? c.dx : c.dy;
    });
    try_it("level of detail by the other rule", [](CaseRecord& c) { c.lod_rule = 1 - c.lod_rule; });
    try_it("derivatives not scaled by the texture's size: level 0", [](CaseRecord& c) { c.dx = c.dy = {}; });
    try_it("level 0 alone", [](CaseRecord& c) { c.mip = 0; });
    try_it("the nearest level alone", [](CaseRecord& c) { c.mip = 1; });
    try_it("two levels mixed", [](CaseRecord& c) { c.mip = 2; });
    try_it("level one too coarse", [](CaseRecord& c) { c.lod_bias += 1; });
    try_it("level one too fine", [](CaseRecord& c) { c.lod_bias -= 1; });
    try_it("half a level too coarse", [](CaseRecord& c) { c.lod_bias += 0.5f; });
    try_it("half a level too fine", [](CaseRecord& c) { c.lod_bias -= 0.5f; });
    // log2 of a square: the level that footprints have whose lengths are squared.
    try_it("log2 of the squared length", [&](CaseRecord& c) { c.lod_bias += s.expectation.expected.lod; });
}

void try_footprints(const Suspect& s, Detective& detective) {
    if (s.record.probes > 1) {
        detective.try_change("isotropic, at the level of the longer axis", [](CaseRecord& c) { c.probes = 1, c.probe_variance = 0; });
        detective.try_change("at most 16 probes whatever the sampler says", [](CaseRecord& c) { c.probes = std::min(c.probes, 16); });
        detective.try_change("half as many probes", [](CaseRecord& c) { c.probes = std::max(c.probes / 2, 1); });
        detective.try_change("equal probes in place of normal ones", [](CaseRecord& c) { c.probe_variance = 0; });
        detective.try_change("probes of the other rule", [](CaseRecord& c) { c.lod_rule = 1 - c.lod_rule; });
    }
    for (const float factor : {0.5f, 2.0f, 4.0f, 0.25f}) {
        detective.try_change("variance of the ellipse off by a factor", [=](CaseRecord& c) { c.ellipse *= factor; });
        detective.try_change("variance of the probes off by a factor", [=](CaseRecord& c) { c.probe_variance *= factor; });
    }
}

void try_kernels(const Suspect& s, Detective& detective) {
    detective.try_change("kernels of magnification and minification swapped", [](CaseRecord& c) {
        std::swap(c.magnify, c.minify), std::swap(c.magnify_b, c.minify_b), std::swap(c.magnify_c, c.minify_c);
    });
    for (const texunit::KernelInfo& kernel : texunit::all_kernels()) {
        const auto parsed = texunit::parse_kernel(kernel.name);
        detective.try_change("the kernel " + std::string(kernel.name), [&](CaseRecord& c) {
            c.minify = c.magnify = uint32_t(parsed->kind), c.minify_b = c.magnify_b = parsed->b, c.minify_c = c.magnify_c = parsed->c;
        });
    }
    detective.try_change("B and C swapped", [](CaseRecord& c) { std::swap(c.minify_b, c.minify_c), std::swap(c.magnify_b, c.magnify_c); });
    if (!s.draws()) return;
    detective.try_change("drawn by the magnitude of the weights, |w|", [](CaseRecord& c) { c.estimator = uint32_t(Estimator::AbsWeight); });
    detective.try_change("drawn by another estimator", [](CaseRecord& c) { c.estimator = uint32_t(Estimator::Reservoir); });
}

void try_numbers(const Suspect& s, Detective& detective) {
    if (s.record.op != PortOp::Draw) return;
    using Number = float CaseRecord::*;
    const auto same = [&](const char* name, Number to, Number from) {
        detective.try_change(name, [=](CaseRecord& c) { c.*to = c.*from; });
    };
    same("y is drawn with the number of x", &CaseRecord::number_y, &CaseRecord::number_x);
    same("x is drawn with the number of y", &CaseRecord::number_x, &CaseRecord::number_y);
    same("z is drawn with the number of x", &CaseRecord::number_z, &CaseRecord::number_x);
    same("z is drawn with the number of y", &CaseRecord::number_z, &CaseRecord::number_y);
    same("the level is drawn with the number of x", &CaseRecord::number_level, &CaseRecord::number_x);
    same("the probe is drawn with the number of the level", &CaseRecord::number_probe, &CaseRecord::number_level);
    same("the probe is drawn with the number of x", &CaseRecord::number_probe, &CaseRecord::number_x);
    same("signs are drawn with the number of x", &CaseRecord::number_sign, &CaseRecord::number_x);
    detective.try_change("numbers of x and y swapped", [](CaseRecord& c) { std::swap(c.number_x, c.number_y); });
    detective.try_change("the negative texel is drawn with the positive one's numbers", [](CaseRecord& c) {
        c.negative_x = c.number_x, c.negative_y = c.number_y, c.negative_z = c.number_z, c.negative_sign = c.number_sign;
    });
    detective.try_change("texels fall as their numbers rise", [](CaseRecord& c) {
        for (Number number : {&CaseRecord::number_x, &CaseRecord::number_y, &CaseRecord::number_z}) c.*number = 1 - 0x1p-24f - c.*number;
    });
    detective.try_change("the finer level is drawn where the number is below the coarser one's weight",
                         [](CaseRecord& c) { c.number_level = 1 - 0x1p-24f - c.number_level; });
    detective.try_change("the coarser level always", [](CaseRecord& c) { c.number_level = 0; });
    detective.try_change("the finer level always", [](CaseRecord& c) { c.number_level = 1 - 0x1p-24f; });
    detective.try_change("numbers of 8 bits", [](CaseRecord& c) {
        for (Number number : {&CaseRecord::number_x, &CaseRecord::number_y, &CaseRecord::number_z})
            c.*number = std::floor(c.*number * 256) / 256;
    });
}

void try_random(const Suspect& s, Detective& detective) {
    detective.try_change("x and y of the pixel swapped", [](CaseRecord& c) { std::swap(c.pixel_x, c.pixel_y); });
    detective.try_change("the sample left out", [](CaseRecord& c) { c.sample = 0; });
    detective.try_change("the surface left out", [](CaseRecord& c) { c.surface = 0; });
    detective.try_change("the seed left out", [](CaseRecord& c) { c.seed = 0; });
    detective.try_change("dimension off by one", [](CaseRecord& c) { ++c.dimension; });
    detective.try_change("every dimension has the same numbers", [](CaseRecord& c) { c.dimension = 0; });
    detective.try_change("both dimensions have the same numbers", [](CaseRecord& c) { c.second_dimension = c.dimension; });
    for (uint32_t noise = 0; noise < 5; ++noise)
        detective.try_change("the noise " + std::string(to_string(texunit::Noise(noise))), [=](CaseRecord& c) { c.noise = noise; });
    if (s.record.op != PortOp::Random) return;
    PortResult all = s.expectation.expected;
    all.value[0] = float(all.bits) * 0x1p-32f;
    detective.try_answer("all 32 bits as a float: rounds up to 1", all);
    all.value[0] = float(all.bits >> 8) / 0xFFFFFF;
    detective.try_answer("divided by 2^24 - 1: 1 is reached", all);
}

void try_values(const Suspect& s, Detective& detective) {
    const PortResult& right = s.expectation.expected;
    const auto with = [&](const char* name, const std::function<void(PortResult&)>& change) {
        PortResult changed = right;
        change(changed);
        detective.try_answer(name, changed);
    };
    with("red and blue swapped", [](PortResult& r) { std::swap(r.value[0], r.value[2]); });
    with("alpha 1", [](PortResult& r) { r.value[3] = 1; });
    with("sRGB not decoded", [](PortResult& r) {
        for (size_t c = 0; c < 3; ++c) r.value[c] = float(texunit::linear_to_srgb(double(r.value[c])));
    });
    if (s.record.op == PortOp::SrgbDecode)
        with("a power of 2.2 in place of sRGB", [&](PortResult& r) { r.value[0] = std::pow(float(s.record.index) / 255, 2.2f); });
    if (s.record.op == PortOp::SrgbEncode) {
        with("a power of 2.2 in place of sRGB",
             [&](PortResult& r) { r.bits = uint32_t(std::lround(255 * std::pow(std::clamp(s.record.at[0], 0.0f, 1.0f), 1 / 2.2f))); });
        with("truncated, not rounded", [&](PortResult& r) { r.bits = uint32_t(255 * texunit::linear_to_srgb(double(s.record.at[0]))); });
    }
    if (s.draws()) {
        with("the negative texel left out", [](PortResult& r) { r.negative_weight = 0; });
        for (const int step : {-1, 1}) {
            with("one texel beside, in x", [=](PortResult& r) { r.x += step, r.value = {}; });
            with("one texel beside, in y", [=](PortResult& r) { r.y += step, r.value = {}; });
        }
        detective.try_change("filtered in place of drawn", [](CaseRecord& c) { c.op = PortOp::Sample; });
    }
    detective.try_change("filtered before shading", [](CaseRecord& c) { c.order = 0; });
    detective.try_change("filtered after shading", [](CaseRecord& c) { c.order = 1; });
}

/// Some implementations of textureSize(image, level) answer a whole group of lanes with the size of its first lane's level.
void try_neighbours(const Suspect& s, Detective& detective) {
    const int level = s.expectation.expected.level;
    const Shape& shape = s.shape();
    if (shape.cube || shape.depth > 1 || (s.expectation.judged & kJudgesTexel) == 0) return;
    for (size_t back = 1; back < 32 && back <= s.index; ++back) {
        const Expectation& neighbour = s.suite.expected[s.index - back];
        if (s.suite.cases[s.index - back].texture != s.record.texture || neighbour.expected.level == level) continue;
        const auto texel = [&](float u, uint32_t wrap, int extent) {
            CaseRecord index;
            index.op = PortOp::WrapIndex;
            index.wrap_s = wrap;
            index.extent = texunit::level_extent(extent, neighbour.expected.level);
            const float reduced = wrap == uint32_t(Wrap::Repeat) ? u - std::trunc(u) : u;
            index.index = int(std::floor(std::clamp(reduced, -80.0f, 80.0f) * float(index.extent)));
            return evaluate(s.suite, index).x;
        };
        if (s.came.x == texel(s.record.at[0], s.record.wrap_s, shape.width) &&
            s.came.y == texel(s.record.at[1], s.record.wrap_t, shape.height)) {
            PortResult answer = s.came;
            detective.try_answer("sized by another lane's level: textureSize(image, level) is asked once for a group of lanes", answer);
            return;
        }
    }
}

/// Mistakes of whole lookups that cases cannot be changed to show, such as clamped edges of cube maps.
void try_mistakes(const Suspect& s, Detective& detective) {
    constexpr texunit::LegalPrecision kPorts{
        .coordinate_bits = 22, .subtexel_bits = 12, .lod_bits = 9, .approximate_scale = false, .colour_threshold = 1e-4};
    if (s.record.op != PortOp::Sample || s.record.ellipse > 0) return;
    const bool hardware = s.suite.name == kHardwareSuite;
    const std::string cause =
        likely_cause(judged_texture(s.suite, s.record), sampler_of(s.record), judged_lookup(s.record), judged_colour(s.came.value),
                     hardware ? legal_precision(s.suite, s.record, kLeastPrecision) : kPorts);
    if (!cause.empty()) detective.keep(cause);
}

/// What a port makes of numbers that are not finite is its device's affair: only that it is not right can be told. Null where all are.
const char* not_finite(const Suspect& s) {
    const auto finite = [](const std::array<float, 3>& v) { return std::ranges::all_of(v, [](float x) { return std::isfinite(x); }); };
    if (!s.looks_up()) return nullptr;
    if (!finite(s.record.at)) return "a coordinate that is not finite, not read as 0";
    if (!finite(s.record.dx) || !finite(s.record.dy)) return "a derivative that is not finite, not taken for the last level";
    return nullptr;
}

bool is_zero(const PortResult& result) { return std::memcmp(&result, std::array<char, sizeof(PortResult)>{}.data(), sizeof(result)) == 0; }

bool has_nan(const PortResult& result, uint32_t judged) {
    for (size_t c = 0; c < 4; ++c) {
        if ((judged & judges(12 + c)) != 0 && std::isnan(result.value[c])) return true;
    }
    return false;
}

}  // namespace

std::vector<std::string> possible_causes(const Suite& suite, size_t index, std::span<const PortResult> results) {
    const Suspect suspect{suite, index, suite.cases[index], suite.expected[index], results[index]};
    Detective detective(suspect);
    if (const char* const why = not_finite(suspect)) return {why};
    if (suspect.record.op == PortOp::WrapIndex) try_wraps(suspect, detective);
    if (suspect.looks_up()) {
        try_addresses(suspect, detective);
        try_levels(suspect, detective);
        try_footprints(suspect, detective);
        try_numbers(suspect, detective);
        try_neighbours(suspect, detective);
        try_wraps(suspect, detective);
        try_kernels(suspect, detective);
    }
    if (suspect.record.op == PortOp::Random || suspect.record.op == PortOp::NoisePair) try_random(suspect, detective);
    if (suspect.record.op == PortOp::Plane) {
        detective.try_change("planes weigh without a power", [](CaseRecord& c) { c.count = 1; });
        detective.try_change("x and y of the normal swapped", [](CaseRecord& c) { std::swap(c.at[0], c.at[1]); });
    }
    try_values(suspect, detective);
    if (is_zero(suspect.came)) detective.keep("nothing was written");
    if (has_nan(suspect.came, suspect.expectation.judged))
        detective.keep("not a number: 0/0, 0 times infinity or the logarithm of a negative number");
    if (detective.found().empty()) try_mistakes(suspect, detective);
    return detective.found();
}

}  // namespace rawtexel::cli
