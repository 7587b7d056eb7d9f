#include "cli/skip_options.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

namespace rawtexel::cli {
namespace {

using test::complaint_of;

SkipRequest parse(const std::vector<std::string>& words) { return test::parsed_options<SkipRequest>(declare_skip_options, words); }

std::string names_of(const shading::Skips& skips) {
    std::string names;
    for (const shading::SkipInfo& skip : shading::kSkips)
        if (skips.*skip.on) names += std::string(skip.name) + " ";
    return names;
}

TEST(SkipOptions, AllAreOnUnlessSaid) {
    for (const shading::SkipInfo& skip : shading::kSkips) EXPECT_TRUE(parse({}).skips.*skip.on) << skip.name;
}

TEST(SkipOptions, EachIsTurnedOffAndOnByItsName) {
    for (const shading::SkipInfo& one : shading::kSkips) {
        const shading::Skips without = parse({"--no-skip", std::string(one.name)}).skips,
                             alone = parse({"--skip", std::string(one.name)}).skips;
        for (const shading::SkipInfo& other : shading::kSkips) {
            EXPECT_EQ(without.*other.on, other.name != one.name) << other.name;
            EXPECT_EQ(alone.*other.on, other.name == one.name) << other.name;
        }
    }
}

TEST(SkipOptions, TakeListsAndAll) {
    EXPECT_EQ(names_of(parse({"--skip", "hiz,frustum"}).skips), "frustum hiz ");
    EXPECT_EQ(names_of(parse({"--no-skip", "all"}).skips), "");
    EXPECT_EQ(names_of(parse({"--skip", "all"}).skips), names_of({}));
}

TEST(SkipOptions, WhatMakesNoSenseIsRefused) {
    EXPECT_NE(complaint_of(parse, {"--no-skip", "hi-z"}).find("the nearest is 'hiz'"), std::string::npos)
        << complaint_of(parse, {"--no-skip", "hi-z"});
    EXPECT_EQ(complaint_of(parse, {"--skip", "hiz,hiz"}), "--skip: 'hiz' is named twice");
    EXPECT_EQ(complaint_of(parse, {"--skip", "all,hiz"}), "--skip: all leaves nothing else to name");
    EXPECT_EQ(complaint_of(parse, {"--skip", "hiz", "--no-skip", "frustum"}), "--skip and --no-skip exclude each other");
}

}  // namespace
}  // namespace rawtexel::cli
