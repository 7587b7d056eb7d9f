// How many times their usual size the randomised tests take: RAWTEXEL_STRESS, which ./dev stress sets; 1 where it is unset.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace rawtexel {

inline int stress_scale() {
    const char* const text = std::getenv("RAWTEXEL_STRESS");
    return text == nullptr ? 1 : std::clamp(std::atoi(text), 1, 1000000);
}

}  // namespace rawtexel
