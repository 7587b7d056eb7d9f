#include "cli/vectors/expectation.h"
#include "cli/vectors/suspect.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace rawtexel::cli {
namespace {

using texunit::Shape;
using texunit::Wrap;

/// What faulty code makes of index i in an axis of n texels.
struct WrappedIndex {
    const char* fault;
    int texel;
};
std::vector<WrappedIndex> faulty_wraps(int i, int n) {
    const int period = 2 * n, place = (i % period + period) % period;
    return {{"the remainder of a negative index is negative", i % n},
            {"wrap off by one for negative indices", i < 0 ? (-i) % n : i % n},
            {"wrap off by one for negative indices", i < 0 ? n - 1 - (-i) % n : i % n},
            {"wrap off by one for negative indices", (i % n + n - (i < 0 ? 1 : 0)) % n},
            {"wrap off by one for negative indices", i < 0 ? std::min(-i, n - 1) : std::min(i, n - 1)},
            {"mirror off by one: the edge texel is not repeated", place < n ? place : period - place},
            {"mirror off by one: the edge texel is not repeated", place < n ? place : std::min(period - place, n - 1)},
            {"mirror without its second half turned round", place % n},
            {"texel 0 out of reach", std::clamp(i, std::min(1, n - 1), n - 1)},
            {"the last texel out of reach", std::clamp(i, 0, std::max(n - 2, 0))},
            {"one texel beyond the end", std::clamp(i, 0, n)},
            {"the border clamped to the edge", std::clamp(i, 0, n - 1)}};
}

void try_wrapped_indices(const Suspect& s, Detective& detective) {
    for (const WrappedIndex& wrapped : faulty_wraps(s.record.index, s.record.extent)) {
        PortResult result;
        result.x = wrapped.texel;
        detective.try_answer(wrapped.fault, result);
    }
    for (uint32_t wrap = 0; wrap < 5; ++wrap)
        detective.try_change("wrapped as " + std::string(to_string(Wrap(wrap))), [=](CaseRecord& c) { c.wrap_s = wrap; });
}

/// Of lookups of one texel: whether their indices were wrapped by faulty code. The texel may lie outside of the texture then, so that only
/// its place tells.
void try_wrapped_texels(const Suspect& s, Detective& detective) {
    const Shape& shape = s.shape();
    const PortResult& right = s.expectation.expected;
    const bool nearest = s.record.magnify == 0 && s.record.minify == 0;
    if ((s.expectation.judged & kJudgesTexel) == 0 || !nearest || shape.cube || shape.depth > 1 || right.x < 0) return;
    if (s.came.x == right.x && s.came.y == right.y) return;
    const auto wraps = [&](size_t axis) {
        const int extent = texunit::level_extent(axis == 0 ? shape.width : shape.height, right.level);
        const float u = std::isfinite(s.record.at[axis]) ? std::clamp(s.record.at[axis], -80.0f, 80.0f) : 0.0f;
        return faulty_wraps(int(std::floor(u * float(extent))), extent);
    };
    const std::vector<WrappedIndex> x = wraps(0), y = wraps(1);
    for (size_t n = 0; n < x.size(); ++n) {
        if ((s.came.x == x[n].texel || s.came.x == right.x) && (s.came.y == y[n].texel || s.came.y == right.y)) detective.keep(x[n].fault);
    }
}

/// Of bilinear lookups in one level. Indices outside of the texture read what lies there in the buffer of texels.
void try_wrapped_taps(const Suspect& s, Detective& detective) {
    const CaseRecord& record = s.record;
    const Shape& shape = s.shape();
    const bool bilinear = record.magnify == 1 && record.minify == 1 && record.mip == 0 && record.probes == 1 && record.ellipse <= 0;
    const SuiteTexture& texture = s.suite.textures[record.texture];
    if (record.op != PortOp::Sample || !bilinear || shape.cube || shape.depth > 1 || shape.layers > 1) return;
    if (texture.format() != texunit::Format::RGBA32Float) return;

    struct Axis {
        double fraction;
        std::array<int, 2> right;
        std::array<std::vector<WrappedIndex>, 2> faulty;
    };
    const auto axis_of = [&](float u, int extent, uint32_t wrap) {
        const double at = double(std::clamp(u, -5000.0f, 5000.0f)) * extent - 0.5;
        Axis axis{.fraction = at - std::floor(at), .right = {}, .faulty = {}};
        for (int tap = 0; tap < 2; ++tap) {
            CaseRecord index;
            index.op = PortOp::WrapIndex;
            index.wrap_s = wrap, index.extent = extent, index.index = int(std::floor(at)) + tap;
            axis.right[size_t(tap)] = evaluate(s.suite, index).x;
            axis.faulty[size_t(tap)] = faulty_wraps(index.index, extent);
        }
        return axis;
    };
    const Axis x = axis_of(record.at[0], shape.width, record.wrap_s), y = axis_of(record.at[1], shape.height, record.wrap_t);
    const auto texel = [&](int column, int row) {
        std::array<float, 4> value{};
        const int64_t place = int64_t{row} * shape.width + column;
        if (column == -1 || row == -1) return record.border;
        if (place >= 0 && size_t(place) * 16 + 16 <= texture.bytes().size())
            std::memcpy(value.data(), texture.bytes().data() + 16 * place, 16);
        return value;
    };
    for (size_t fault = 0; fault < x.faulty[0].size(); ++fault) {
        for (const auto& [in_x, in_y] : {std::pair{true, true}, {true, false}, {false, true}}) {
            PortResult answer = s.expectation.expected;
            answer.value = {};
            for (size_t tap = 0; tap < 4; ++tap) {
                const size_t i = tap % 2, j = tap / 2;
                const double weight = (i == 1 ? x.fraction : 1 - x.fraction) * (j == 1 ? y.fraction : 1 - y.fraction);
                const auto value = texel(in_x ? x.faulty[i][fault].texel : x.right[i], in_y ? y.faulty[j][fault].texel : y.right[j]);
                for (size_t c = 0; c < 4; ++c) answer.value[c] += float(weight * double(value[c]));
            }
            detective.try_answer(x.faulty[0][fault].fault, answer);
        }
    }
}

}  // namespace

void try_wraps(const Suspect& suspect, Detective& detective) {
    if (suspect.record.op == PortOp::WrapIndex) return try_wrapped_indices(suspect, detective);
    try_wrapped_texels(suspect, detective);
    try_wrapped_taps(suspect, detective);
}

}  // namespace rawtexel::cli
