// Which instruction set the vector code runs on.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace rawtexel::texunit {

enum class Simd { Auto, Scalar, Sse4, Avx2, Avx3 };

std::string_view to_string(Simd simd);  // auto scalar sse4 avx2 avx3
std::optional<Simd> parse_simd(std::string_view text);

/// The sets this machine runs and this build holds, slowest first; without Auto.
std::vector<Simd> available_simd();

/// Makes every later dispatch use `simd`. Returns false, and changes nothing, when it is not available. Not while threads sample.
bool choose_simd(Simd simd);

/// The set in use now, never Auto.
Simd chosen_simd();

}  // namespace rawtexel::texunit
