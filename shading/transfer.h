// Transfer functions of displays: from display-linear light to the codes of a file.
#pragma once

#include "shading/display.h"

#include <array>
#include <cstdint>

namespace rawtexel::shading {

/// Encoded value in [0, 1] of display-linear `linear` in [0, 1]. sRGB: IEC 61966-2-1.
double encoded(double linear, Transfer transfer);
/// Its inverse.
double decoded(double code, Transfer transfer);

/// Exactly rounded 8-bit codes: the greatest k with encoded(linear) >= (k - 0.5)/255. NaN and negative values give 0, values above 1 give
/// 255. A float's upper bits choose a bucket that holds at most one threshold between codes; one comparison settles the code.
class CodeTable {
  public:
    explicit CodeTable(Transfer transfer);
    uint8_t code(float linear) const;

    /// The least float that gets code `k` (1..255).
    float threshold(int k) const { return threshold_[size_t(k)]; }

  private:
    static constexpr int kBucketBits = 15;                          ///< low bits of a float that a bucket spans: 256 buckets an octave
    static constexpr uint32_t kFirst = 0x36000000u >> kBucketBits;  ///< bucket of 2^-19: below every threshold
    static constexpr uint32_t kBuckets = (0x3F800000u >> kBucketBits) - kFirst + 1;

    std::array<float, 257> threshold_;
    std::array<uint8_t, kBuckets> code_at_start_;
};

}  // namespace rawtexel::shading
