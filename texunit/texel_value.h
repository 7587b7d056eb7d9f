// One decoded texel <-> linear RGBA: the scalar meaning of TexelLayout, and rounding to it.
#pragma once

#include "texunit/format.h"

#include <array>
#include <cstddef>
#include <vector>

namespace rawtexel::texunit {

/// The value of the texel at `texel` (bytes_per_texel(layout.storage) bytes). Bit-equal to what the vector code fetches.
std::array<float, 4> load_texel(const TexelLayout& layout, const std::byte* texel);

/// Writes the representable texel nearest to a linear colour: fields to the nearest numerator (for sRGB nearest in code space, decided by
/// thresholds in linear space), halves and floats to nearest even. Values outside a field's range are clamped to it, NaN becomes 0.
class TexelEncoder {
  public:
    explicit TexelEncoder(const TexelLayout& layout);
    void store(const std::array<double, 4>& linear, std::byte* texel) const;

  private:
    uint64_t field(int channel, double linear) const;

    TexelLayout layout_;
    std::array<std::vector<double>, 4> thresholds_;  ///< per sRGB channel: linear value half-way, in code space, from field i to i + 1
};

}  // namespace rawtexel::texunit
