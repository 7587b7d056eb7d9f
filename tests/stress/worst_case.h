// What a stress test found and how much it looked at, on the screen and in its report; tests/stress/report.awk adds up all of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>

namespace rawtexel {

template <class T>
void tell_worst_case(const std::string& name, const T& value) {
    std::cout << "[    WORST ] " << name << ": " << ::testing::PrintToString(value) << '\n';
    ::testing::Test::RecordProperty(name, ::testing::PrintToString(value));
}

/// `count` cases of the running test were each held against its oracle. `what` is a plural noun: "samples" are sample points whose coverage
/// or winner was judged, the unit in which ./dev stress has a goal. Once a test and unit.
inline void tell_tested(uint64_t count, const std::string& what = "samples") {
    std::cout << "[   TESTED ] " << count << ' ' << what << '\n';
    ::testing::Test::RecordProperty("tested_" + what, std::to_string(count));
}

}  // namespace rawtexel
