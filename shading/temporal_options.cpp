#include "shading/temporal_options.h"

#include <array>
#include <cstddef>

namespace rawtexel::shading {
namespace {

constexpr std::array kNames = {std::string_view("mean"), std::string_view("ema"), std::string_view("reproject")};

}  // namespace

std::string_view to_string(Accumulation accumulation) { return kNames[size_t(accumulation)]; }

std::optional<Accumulation> parse_accumulation(std::string_view text) {
    for (size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == text) return Accumulation(i);
    return std::nullopt;
}

}  // namespace rawtexel::shading
