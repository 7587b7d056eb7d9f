// Where a lookup may read, within an implementation's precision: faces, layers, coordinates and derivatives as ranges.
#pragma once

#include "texunit/colour_search.h"
#include "texunit/legal_interval.h"

#include <array>
#include <vector>

namespace rawtexel::texunit {

/// A coordinate of one axis, 1 the whole extent, and how far it may be off.
struct LegalCoordinate {
    double value = 0, error = 0;
};

/// One face and slice with coordinates on it.
struct LegalPlace {
    int slice = 0;  ///< array layer, or 6*cube + face
    std::array<LegalCoordinate, 3> at{};
    /// d(at)/dx and d(at)/dy in texels of level 0; of cube maps of the face's own coordinates.
    std::array<Range, 3> dx{}, dy{};
    bool finite_derivatives = true;
};

/// Every face and layer that the precision reaches; one place mostly.
std::vector<LegalPlace> legal_places(const Shape& shape, const JudgedLookup& lookup, const LegalPrecision& precision);

/// One step of a mantissa of `bits` bits at `value`.
double float_error(double value, int bits);

}  // namespace rawtexel::texunit
