// Runs one computation on every instruction set that this machine has.
#pragma once

#include "texunit/simd.h"

#include <gtest/gtest.h>

namespace rawtexel::texunit {

/// Calls `body()` once for each set and goes back to the best. Ends at the first fatal failure, whose set it names.
template <class Body>
void on_every_simd(const Body& body) {
    for (const Simd simd : available_simd()) {
        choose_simd(simd);
        body();
        if (!::testing::Test::HasFatalFailure()) continue;
        ADD_FAILURE() << "on " << to_string(simd);
        break;
    }
    choose_simd(Simd::Auto);
}

}  // namespace rawtexel::texunit
