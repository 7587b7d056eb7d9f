#include "cli/counters.h"
#include "cli/metadata.h"
#include "cli/stats.h"
#include "cli/version.h"
#include "texunit/memory_source.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <set>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::json;

shading::SceneTexture sample_texture(const std::string& name, int extent) {
    std::vector<std::byte> texels(size_t(extent) * size_t(extent) * 4, std::byte{7});
    auto source = texunit::make_memory_source(texunit::Format::RGBA8Srgb, extent, extent, std::move(texels));
    shading::SceneTexture texture;
    texture.texture = std::make_shared<texunit::Texture>(name, std::move(source));
    return texture;
}

/// Two textures, the first used by two entries, and numbers that differ from each other.
struct Sample {
    shading::Scene scene;
    RunRecord record;

    explicit Sample(bool counted) {
        scene.textures = {sample_texture("a.png", 16), sample_texture("b.png", 8)};
        scene.textures.push_back(scene.textures[0]);
        scene.textures[0].texture->texel(0, 0, 3, 3);
        scene.textures[1].texture->texel(0, 0, 0, 0);
        record.scene = "plane";
        record.command = "rawtexel render plane -o 'a b.png'";
        record.view = "--eye 1,2,3 --target 0,0,0 --fov 45";
        record.request.samples.spp = 4;
        record.request.samples.seed = 9;
        record.request.lookup.filter = texunit::Kernel::Nearest;
        record.result.radiance = shading::Image(20, 10, 3);
        record.result.samples_shaded = 100;
        record.result.geometry.triangles = 12;
        record.result.geometry.clipped = 3;
        record.work = texture_work(scene);
        record.times = {{0.3, 0.1, 0.2, 0.4}, 1.5, 0.25, 3.0};
        if (!counted) return;
        record.result.fetches = std::make_unique<shading::FrameFetches>(shading::TextureSet(scene));
        record.result.fetches->counts = {{11, 42, 43, {40, 3}}, {20, 60, 60, {60}}};
        for (const int32_t texel : {0, 1, 17}) record.result.fetches->touched.bits(0).mark(texel);
        record.result.fetches->touched.bits(1).mark(5);
    }
};

std::set<std::string> keys_of(const Json& json) {
    std::set<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.insert(key);
    return keys;
}

TEST(Stats, HasTheKeysOfTheContract) {
    const Sample sample(true);
    const Json json = Json::parse(stats_json(sample.record, sample.scene));
    using Keys = std::set<std::string>;
    EXPECT_EQ(keys_of(json), (Keys{"rawtexel", "scene", "command", "lookup", "image", "frame_s", "time_s", "memory_bytes", "geometry",
                                   "fetches", "texture", "textures"}));
    EXPECT_EQ(keys_of(json["image"]), (Keys{"width", "height", "spp", "samples_shaded"}));
    EXPECT_EQ(keys_of(json["frame_s"]), (Keys{"min", "median", "n"}));
    EXPECT_EQ(keys_of(json["time_s"]), (Keys{"load", "geometry", "raster", "shade", "write", "total"}));
    EXPECT_EQ(keys_of(json["memory_bytes"]), (Keys{"peak_rss", "textures_stored", "textures_decoded"}));
    for (const char* key : {"triangles", "culled_frustum", "culled_backface", "culled_degenerate", "culled_small", "clipped", "binned",
                            "tiles", "tiles_empty", "hiz_rejected"})
        EXPECT_TRUE(json["geometry"].contains(key)) << key;
    EXPECT_EQ(keys_of(json["texture"]), (Keys{"lookups", "taps", "texels_requested", "texels_per_sample", "texels_unique", "blocks_touched",
                                              "lines_32", "lines_64", "lines_128", "lines_stored_32", "lines_stored_64", "lines_stored_128",
                                              "bytes_decoded", "bytes_stored", "overfetch", "layouts", "performed"}));
    EXPECT_EQ(keys_of(json["texture"]["layouts"]), (Keys{"linear", "morton", "tiled-4k", "tiled-64k"}));
    ASSERT_EQ(json["textures"].size(), 2u) << "two of three entries share a texture";
    EXPECT_EQ(json["textures"][0]["per_level"].size(), 5u);
    for (const char* key :
         {"name", "format", "width", "height", "levels", "blocks_total", "lookups", "taps", "texels_requested", "performed"})
        EXPECT_TRUE(json["textures"][0].contains(key)) << key;
}

TEST(Stats, WhatWasNotCountedIsLeftOut) {
    const Sample sample(false);
    const Json json = Json::parse(stats_json(sample.record, sample.scene));
    EXPECT_EQ(keys_of(json["texture"]), std::set<std::string>{"performed"});
    for (const Json& texture : json["textures"]) EXPECT_FALSE(texture.contains("taps"));
    Sample empty(true);
    empty.record.result.samples_shaded = 0;
    EXPECT_FALSE(Json::parse(stats_json(empty.record, empty.scene))["texture"].contains("texels_per_sample"));
}

TEST(Stats, HoldsTheNumbersOfTheRun) {
    const Sample sample(true);
    const Json json = Json::parse(stats_json(sample.record, sample.scene));
    EXPECT_EQ(json["rawtexel"], std::string(version()));
    EXPECT_EQ(json["scene"], "plane");
    EXPECT_EQ(json["command"], sample.record.command);
    EXPECT_EQ(json["image"], Json::parse(R"({"width": 20, "height": 10, "spp": 4, "samples_shaded": 100})"));
    EXPECT_EQ(json["lookup"]["filter"], "nearest");
    EXPECT_EQ(json["lookup"]["mip"], "scene");
    EXPECT_EQ(json["lookup"]["lod_rule"], "d3d");
    EXPECT_EQ(json["lookup"]["precision"], "exact");
    EXPECT_EQ(json["frame_s"]["min"], 0.1);
    EXPECT_EQ(json["frame_s"]["median"], 0.25);
    EXPECT_EQ(json["frame_s"]["n"], 4);
    EXPECT_EQ(json["time_s"]["load"], 1.5);
    EXPECT_EQ(json["geometry"]["triangles"], 12);
    EXPECT_EQ(json["geometry"]["clipped"], 3);
    EXPECT_EQ(json["texture"]["lookups"], 31);
    EXPECT_EQ(json["texture"]["taps"], 102);
    EXPECT_EQ(json["texture"]["texels_requested"], 103);
    EXPECT_EQ(json["texture"]["texels_unique"], 4);
    EXPECT_EQ(json["texture"]["blocks_touched"], 3);
    EXPECT_EQ(json["texture"]["bytes_decoded"], 3 * 64);
    EXPECT_EQ(json["texture"]["overfetch"], 12.0);
    EXPECT_EQ(json["textures"][0]["per_level"][0]["texels_requested"], 40);
    EXPECT_EQ(json["textures"][0]["per_level"][0]["texels_unique"], 3);
    EXPECT_EQ(json["textures"][0]["per_level"][1]["texels_unique"], 0);
    EXPECT_EQ(json["textures"][0]["lookups"], 11);
    EXPECT_EQ(json["texture"]["texels_per_sample"], 1.03);
    EXPECT_EQ(json["textures"][1]["width"], 8);
    EXPECT_EQ(json["textures"][1]["format"], "rgba8-srgb");
    EXPECT_EQ(json["textures"][1]["texels_requested"], 60);
    EXPECT_GT(json["memory_bytes"]["peak_rss"], 1000000);
}

TEST(Stats, SharedTexturesCountOnce) {
    const Sample sample(true);
    const Json json = Json::parse(stats_json(sample.record, sample.scene));
    EXPECT_EQ(json["memory_bytes"]["textures_stored"], 16 * 16 * 4 + 8 * 8 * 4);
    EXPECT_EQ(json["texture"]["performed"]["blocks_decoded"], 2);  // one block of each
    EXPECT_EQ(json["memory_bytes"]["textures_decoded"], 2 * 64);
}

TEST(Stats, NamesThatAreNoUtf8AreStillJson) {
    Sample sample(true);
    sample.record.scene = "caf\xe9.glb";
    EXPECT_TRUE(Json::accept(stats_json(sample.record, sample.scene)));
}

TEST(Stats, EveryKeyIsAListedCounter) {
    const Sample sample(true);
    const Json json = Json::parse(stats_json(sample.record, sample.scene));
    std::set<std::string> listed;
    for (const CounterInfo& counter : all_counters()) {
        EXPECT_TRUE(listed.emplace(counter.name).second) << counter.name;
        EXPECT_FALSE(counter.description.empty());
    }
    for (const char* group : {"image", "frame_s", "time_s", "memory_bytes", "geometry", "texture"})
        for (const auto& [key, value] : json[group].items())
            EXPECT_TRUE(value.is_object() || listed.contains(std::string(group) + "." + key)) << group << "." << key;
}

TEST(Counters, ListEveryKeyOfTheTextureObject) {
    std::set<std::string> listed;
    for (const CounterInfo& counter : all_counters()) listed.emplace(counter.name);
    for (const char* key : {"lookups",
                            "taps",
                            "texels_requested",
                            "texels_unique",
                            "texels_per_sample",
                            "blocks_touched",
                            "lines_64",
                            "bytes_decoded",
                            "lines_stored_64",
                            "bytes_stored",
                            "overfetch",
                            "cache.l1_hits",
                            "cache.l1_misses",
                            "cache.l2_hits",
                            "cache.l2_misses",
                            "cache.compulsory",
                            "cache.capacity",
                            "cache.conflict",
                            "performed.blocks_decoded",
                            "performed.blocks_decoded_mips"})
        EXPECT_TRUE(listed.contains(std::string("texture.") + key)) << key;
}

TEST(Metadata, HoldsWhatMadeTheImage) {
    const Sample sample(true);
    const scenes::Metadata metadata = image_metadata(sample.record, true);
    const auto value = [&](const std::string& key) {
        const auto found = std::ranges::find(metadata, key, &scenes::Metadata::value_type::first);
        return found == metadata.end() ? "missing" : found->second;
    };
    EXPECT_EQ(value("rawtexel:command"), sample.record.command);
    EXPECT_EQ(value("rawtexel:version"), version());
    EXPECT_EQ(value("rawtexel:seed"), "9");
    EXPECT_EQ(value("rawtexel:spp"), "4");
    EXPECT_EQ(value("rawtexel:camera"), sample.record.view);
    EXPECT_EQ(value("rawtexel:filter"), "nearest");
    EXPECT_EQ(value("rawtexel:precision"), "exact");
    EXPECT_EQ(value("rawtexel:lod-rule"), "d3d");
    EXPECT_EQ(value("rawtexel:lookups"), "31");
    EXPECT_EQ(value("rawtexel:taps"), "102");
    EXPECT_EQ(value("rawtexel:texels_requested"), "103");
    const Sample uncounted(false);
    for (const auto& [key, text] : image_metadata(uncounted.record, false)) EXPECT_NE(key, "rawtexel:taps");
}

TEST(ShellQuoting, IsReadBackByAShell) {
    EXPECT_EQ(shell_quoted({"rawtexel", "--size=1x1", "a b", "it's", "", "$HOME"}), "rawtexel --size=1x1 'a b' 'it'\\''s' '' '$HOME'");
}

}  // namespace
}  // namespace rawtexel::cli
