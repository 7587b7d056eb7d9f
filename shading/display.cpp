#include "shading/display.h"

#include "shading/tone_map.h"
#include "shading/transfer.h"

#include <cassert>
#include <cmath>

namespace rawtexel::shading {
namespace {

struct ToneMapName {
    ToneMap tone_map;
    std::string_view name;
};
constexpr ToneMapName kToneMaps[] = {{ToneMap::Aces, "aces"}, {ToneMap::Reinhard, "reinhard"}, {ToneMap::None, "none"}};

struct TransferName {
    Transfer transfer;
    std::string_view name;
};
constexpr TransferName kTransfers[] = {{Transfer::Srgb, "srgb"}, {Transfer::Sqrt, "sqrt"}, {Transfer::Linear, "linear"}};

const CodeTable& code_table(Transfer transfer) {
    static const CodeTable tables[] = {CodeTable(Transfer::Srgb), CodeTable(Transfer::Sqrt), CodeTable(Transfer::Linear)};
    return tables[size_t(transfer)];
}

}  // namespace

std::string_view to_string(ToneMap tone_map) {
    for (const ToneMapName& entry : kToneMaps)
        if (entry.tone_map == tone_map) return entry.name;
    return {};
}

std::string_view to_string(Transfer transfer) {
    for (const TransferName& entry : kTransfers)
        if (entry.transfer == transfer) return entry.name;
    return {};
}

std::optional<ToneMap> parse_tone_map(std::string_view text) {
    for (const ToneMapName& entry : kToneMaps)
        if (entry.name == text) return entry.tone_map;
    return std::nullopt;
}

std::optional<Transfer> parse_transfer(std::string_view text) {
    for (const TransferName& entry : kTransfers)
        if (entry.name == text) return entry.transfer;
    return std::nullopt;
}

Image tone_mapped(const Image& radiance, const DisplayOptions& options) {
    assert(radiance.channels >= 3);
    Image display = radiance;
    const size_t pixels = size_t(display.width) * size_t(display.height);
    tone_map_pixels(display.values.data(), pixels, display.channels, std::exp2(options.exposure), options.tone_map);
    return display;
}

std::vector<uint8_t> encode_8bit_over_white(const Image& radiance, const Image& coverage, const DisplayOptions& options) {
    assert(coverage.channels == 1 && coverage.width == radiance.width && coverage.height == radiance.height);
    Image whole = radiance;
    const auto covered = [&](size_t value) { return coverage.values[value / size_t(radiance.channels)]; };
    for (size_t i = 0; i < whole.values.size(); ++i)
        if (covered(i) > 0.0f) whole.values[i] /= covered(i);
    const Image display = tone_mapped(whole, options);
    std::vector<uint8_t> codes = encode_8bit(display, options.transfer);
    for (size_t i = 0; i < codes.size(); ++i) {
        const double share = double(covered(i));
        if (share == 1.0) continue;
        const double shown = share > 0.0 ? encoded(double(display.values[i]), options.transfer) : 0.0;
        codes[i] = uint8_t(std::lround(255.0 * (shown * share + (1.0 - share))));
    }
    return codes;
}

std::vector<uint8_t> encode_8bit(const Image& display_linear, Transfer transfer) {
    const CodeTable& table = code_table(transfer);
    std::vector<uint8_t> codes(display_linear.values.size());
    for (size_t i = 0; i < codes.size(); ++i) codes[i] = table.code(display_linear.values[i]);
    return codes;
}

}  // namespace rawtexel::shading
