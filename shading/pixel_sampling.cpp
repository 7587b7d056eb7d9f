#include "shading/pixel_sampling.h"

#include "texunit/random.h"

#include <array>
#include <cmath>
#include <vector>

namespace rawtexel::shading {
namespace {

constexpr std::array kFilterNames = {std::string_view("box"), std::string_view("tent"), std::string_view("gaussian")};
constexpr std::array kJitterNames = {std::string_view("frame"), std::string_view("pixel")};

constexpr double kGaussianSigma = 0.5;  // pixels

/// Share of the filter's weight to the left of t, for t <= 0, pixels from the centre.
double left_weight(PixelFilter filter, double t) {
    switch (filter) {
        case PixelFilter::Box: return 0.5 + t;
        case PixelFilter::Tent: return 0.5 * (1.0 + t) * (1.0 + t);
        case PixelFilter::Gaussian: break;
    }
    const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
    const double cut = normal(-double(filter_radius(filter)) / kGaussianSigma);
    return (normal(t / kGaussianSigma) - cut) / (1.0 - 2.0 * cut);
}

/// Inverse of a filter's distribution over the grid of sample points: cell k of `cells` is the interval of width 1/256 pixel whose
/// middle lies (2k + 1 - cells)/512 from the pixel's centre.
class OffsetTable {
  public:
    explicit OffsetTable(PixelFilter filter) : cells_(int(2.0f * filter_radius(filter) * 256.0f)), upper_(size_t(cells_)) {
        // The right half mirrors the left one exactly, so that the mean is the centre.
        for (int k = 0; k < cells_ / 2; ++k) {
            const double t = double(2 * (k + 1) - cells_) / double(raster::kSampleOne);
            const auto weight = uint64_t(std::llround(left_weight(filter, t) * 0x1p32));
            upper_[size_t(k)] = weight;
            upper_[size_t(cells_ - 2 - k)] = (uint64_t(1) << 32) - weight;
        }
        upper_[size_t(cells_ - 1)] = uint64_t(1) << 32;
        for (size_t i = 0, k = 0; i < first_.size(); ++i) {
            while (upper_[k] <= uint64_t(i) << kGuideShift) ++k;
            first_[i] = uint16_t(k);
        }
    }

    /// 1/512 pixel from the pixel's corner, for a number uniform in [0, 2^32).
    int32_t offset(uint32_t number) const {
        size_t k = first_[number >> kGuideShift];
        while (upper_[k] <= number) ++k;
        return raster::kSampleOne / 2 + 2 * int32_t(k) + 1 - cells_;
    }

  private:
    static constexpr int kGuideShift = 22;
    int cells_;
    std::vector<uint64_t> upper_;                                    ///< cumulative weight in 2^-32 at each cell's right end
    std::array<uint16_t, size_t(1) << (32 - kGuideShift)> first_{};  ///< cell of the first number with these leading bits
};

const OffsetTable& offset_table(PixelFilter filter) {
    static const std::array<OffsetTable, 3> tables = {OffsetTable(PixelFilter::Box), OffsetTable(PixelFilter::Tent),
                                                      OffsetTable(PixelFilter::Gaussian)};
    return tables[size_t(filter)];
}

/// R2 of Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": 1/2 + n/g and 1/2 + n/g^2, g^3 = g + 1; in 2^-64.
constexpr uint64_t kR2X = uint64_t(0.754877666246692760049508896358528692L * 0x1p64L);
constexpr uint64_t kR2Y = uint64_t(0.569840290998053265911399958119574964L * 0x1p64L);

constexpr uint32_t r2(uint64_t step, uint32_t sample) { return uint32_t(((uint64_t(1) << 63) + step * sample) >> 32); }

}  // namespace

std::string_view to_string(PixelFilter filter) { return kFilterNames[size_t(filter)]; }
std::string_view to_string(PixelJitter jitter) { return kJitterNames[size_t(jitter)]; }

std::optional<PixelFilter> parse_pixel_filter(std::string_view text) {
    for (size_t i = 0; i < kFilterNames.size(); ++i)
        if (kFilterNames[i] == text) return PixelFilter(i);
    return std::nullopt;
}

std::optional<PixelJitter> parse_pixel_jitter(std::string_view text) {
    for (size_t i = 0; i < kJitterNames.size(); ++i)
        if (kJitterNames[i] == text) return PixelJitter(i);
    return std::nullopt;
}

float filter_radius(PixelFilter filter) {
    constexpr std::array kRadius = {0.5f, 1.0f, 1.5f};
    return kRadius[size_t(filter)];
}

SequenceShift sequence_shift(PixelJitter jitter, uint32_t x, uint32_t y, uint32_t seed) {
    // Odd multipliers: another seed is another shift, and seed 0 is the plain sequence about the centre.
    if (jitter == PixelJitter::Frame) return {seed * 0x9E3779B1u, seed * 0x85EBCA77u};
    using texunit::Dimension;
    return {texunit::random_bits({.x = x, .y = y, .dimension = Dimension::PixelX, .seed = seed}),
            texunit::random_bits({.x = x, .y = y, .dimension = Dimension::PixelY, .seed = seed})};
}

raster::SampleOffset filtered_offset(PixelFilter filter, float x, float y) {
    const OffsetTable& table = offset_table(filter);
    return {table.offset(uint32_t(x * 0x1p32f)), table.offset(uint32_t(y * 0x1p32f))};
}

raster::SampleOffset sample_offset(PixelFilter filter, PixelJitter jitter, uint32_t sample, const SequenceShift& shift) {
    if (jitter == PixelJitter::Frame && sample == 0) return {};
    const OffsetTable& table = offset_table(filter);
    return {table.offset(r2(kR2X, sample) + shift.x), table.offset(r2(kR2Y, sample) + shift.y)};
}

raster::SampleOffset sample_offset(PixelFilter filter, PixelJitter jitter, uint32_t sample, uint32_t x, uint32_t y, uint32_t seed) {
    return sample_offset(filter, jitter, sample, sequence_shift(jitter, x, y, seed));
}

}  // namespace rawtexel::shading
