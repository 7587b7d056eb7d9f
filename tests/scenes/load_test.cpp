// Names of scenes: built-in ones, files, and what is neither.
#include "scenes/load.h"

#include "scenes/builtin.h"
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace rawtexel::scenes {
namespace {

std::string scene_error(const std::string& name) {
    try {
        load(name);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(Load, FindsFilesAndBuiltInScenes) {
    TemporaryFolder folder;
    EXPECT_EQ(load(folder.write("quad.glb", quad_fixture().glb())).meshes.size(), 1u);
    EXPECT_FALSE(load("magnify").meshes.empty());
}

TEST(Load, NamesTheNearestBuiltInScene) {
    EXPECT_TRUE(says(scene_error("magnfy"), "magnfy: no such scene"));
    EXPECT_TRUE(says(scene_error("magnfy"), "the nearest is \"magnify\""));
    EXPECT_TRUE(says(scene_error("plan"), "\"plane\""));
    EXPECT_EQ(scene_error("bad\nname").find('\n'), std::string::npos);
}

TEST(Load, WhatLooksLikeAFileIsReportedAsOne) {
    EXPECT_TRUE(says(scene_error("none.glb"), "none.glb: "));
    EXPECT_EQ(scene_error("none.glb").find("built-in"), std::string::npos);
    EXPECT_TRUE(says(scene_error("some/folder/plane"), "some/folder/plane"));
}

TEST(Load, AFileWithoutAnExtensionIsReadWhenItExists) {
    TemporaryFolder folder;
    EXPECT_EQ(load(folder.write("quad", quad_fixture().glb())).meshes.size(), 1u);
}

TEST(Load, TheNameOfTheSceneIsThatOfItsFile) {
    TemporaryFolder folder;
    EXPECT_EQ(load_gltf(folder.write("some name.glb", quad_fixture().glb())).name, "some name");
}

}  // namespace
}  // namespace rawtexel::scenes
