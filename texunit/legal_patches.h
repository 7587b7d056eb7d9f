// The colours of one level that coordinates within an implementation's precision give.
#pragma once

#include "texunit/colour_search.h"
#include "texunit/legal_place.h"

#include <array>
#include <vector>

namespace rawtexel::texunit {

/// What is suspected of an implementation's addressing (likely_cause).
struct AddressSuspicion {
    std::array<double, 3> shift{};  ///< added to texel-space coordinates, texels
    bool seamless = true;           ///< false: the edges of a cube map's faces are clamped
};

class LegalPatches {
  public:
    LegalPatches(const JudgedTexture& texture, const SamplerState& sampler, const LegalPrecision& precision,
                 const AddressSuspicion& suspicion = {})
        : texture_(texture), sampler_(sampler), precision_(precision), suspicion_(suspicion) {}

    /// Whether coordinates at `place` may be off so far in `level` that nothing can be said.
    bool is_open(const LegalPlace& place, int level) const;

    /// Families of colours at `place` in `level`, which is not open; together they are all there are.
    std::vector<ColourPatch> at(const LegalPlace& place, const Kernel& kernel, int level) const;

  private:
    Range texel_space(Wrap wrap, const LegalCoordinate& coordinate, int extent, double shift) const;
    Colour texel_at(int level, const LegalPlace& place, const std::array<int64_t, 3>& index) const;

    const JudgedTexture& texture_;
    const SamplerState& sampler_;
    const LegalPrecision& precision_;
    AddressSuspicion suspicion_;
};

}  // namespace rawtexel::texunit
