// What a stress test found, on the screen and in its report.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace rawtexel {

template <class T>
void tell_worst_case(const std::string& name, const T& value) {
    std::cout << "[    WORST ] " << name << ": " << ::testing::PrintToString(value) << '\n';
    ::testing::Test::RecordProperty(name, ::testing::PrintToString(value));
}

}  // namespace rawtexel
