// Interpolated colours of BC1 to BC3 as hardware rounds them to 8 bits, from the published formulas.
#pragma once

namespace rawtexel::reference {

enum class Rounding { Ideal8, Nvidia, Amd };

/// The 8-bit code of colour `index` (0 … 3) between endpoint codes `first` and `second` of `bits` bits (5: red and blue, 6: green), of the
/// four colours or of the three and black.
int rounded_colour(Rounding rounding, int bits, int first, int second, bool four_colours, int index);

}  // namespace rawtexel::reference
