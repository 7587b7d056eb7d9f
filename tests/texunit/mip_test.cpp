// Levels that a source lacks: the mean over each texel's area, in linear light, rounded last.
#include "texunit/memory_source.h"
#include "texunit/mip_block.h"
#include "texunit/srgb.h"
#include "texunit/texture.h"

#include "tests/stress/worst_case.h"
#include "tests/reference/texunit/mip_reference.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr std::pair<int, int> kExtents[] = {{1, 1}, {1, 37}, {3, 5}, {17, 1}, {16, 16}, {64, 24}, {31, 33}, {100, 7}};

std::unique_ptr<TexelSource> float_image(int width, int height, const std::function<float(int x, int y)>& value) {
    std::vector<float> texels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) texels.push_back(value(x, y));
    }
    std::vector<std::byte> bytes(texels.size() * sizeof(float));
    std::memcpy(bytes.data(), texels.data(), bytes.size());
    return make_memory_source(Format::R32Float, width, height, std::move(bytes));
}

std::array<double, 4> mean_below(Texture& texture, int level, int slice, int x, int y) {
    const Shape& shape = texture.shape();
    const bool volume = shape.depth > 1;
    const auto texel = [&](int i, int j, int k) {
        const std::array<float, 4> value = texture.texel(level - 1, volume ? k : slice, i, j);
        return std::array<double, 4>{value[0], value[1], value[2], value[3]};
    };
    return reference::area_mean(level_extent(shape.width, level - 1), level_extent(shape.height, level - 1),
                                level_extent(shape.depth, level - 1), texel, x, y, volume ? slice : 0);
}

template <class Check>
void for_each_generated_texel(Texture& texture, const Check& check) {
    const Shape& shape = texture.shape();
    for (int level = texture.source_levels(); level < shape.levels; ++level) {
        for (int slice = 0; slice < shape.layers * level_extent(shape.depth, level); ++slice) {
            for (int y = 0; y < level_extent(shape.height, level); ++y) {
                for (int x = 0; x < level_extent(shape.width, level); ++x) check(level, slice, x, y);
            }
        }
    }
}

TEST(AreaWeights, CoverTheFinerLevelExactlyOnce) {
    double worst = 0;
    for (const int finer : {1, 2, 3, 4, 5, 7, 16, 17, 999, 16383}) {
        const int extent = std::max(1, finer / 2);
        std::vector<double> covered(size_t(finer), 0.0);
        for (int i = 0; i < extent; ++i) {
            const AreaWeights weights = area_weights(finer, i);
            double sum = 0;
            for (int k = 0; k < weights.count; ++k) {
                sum += weights.weight[size_t(k)];
                covered.at(size_t(weights.first + k)) += weights.weight[size_t(k)];
            }
            worst = std::max(worst, std::abs(sum - 1));
            ASSERT_NEAR(sum, 1, 1e-15) << "texel " << i << " over " << finer;
        }
        for (const double share : covered) ASSERT_NEAR(share, double(extent) / finer, 1e-15) << "extent " << finer;
    }
    tell_worst_case("weights_off_one_by", worst);
}

TEST(Mips, AreTheAreaMeanRoundedToTheImagesOwnFormat) {
    uint64_t texels = 0;
    double worst_codes = 0;
    for (const FormatInfo& about : all_formats()) {
        const TexelLayout& stored = layout(about.format);
        for (const auto& [width, height] : {std::pair{12, 7}, {33, 18}}) {
            Texture texture("hashed", std::make_unique<HashedSource>(about.format, Shape{.width = width, .height = height}));
            EXPECT_EQ(texture.texel_layout().storage, stored.storage);
            for_each_generated_texel(texture, [&](int level, int slice, int x, int y) {
                const std::array<float, 4> found = texture.texel(level, slice, x, y);
                const std::array<double, 4> exact = mean_below(texture, level, slice, x, y);
                ++texels;
                for (size_t c = 0; c < 4; ++c) {
                    const bool srgb = stored.table[c] != nullptr;
                    const double scale = stored.denominator[c];
                    if (stored.storage == StorageClass::Float4) {
                        ASSERT_NEAR(found[c], exact[c], std::abs(exact[c]) * 0x1p-24 + 1e-12 * 0x1p20) << about.name;
                    } else if (stored.storage == StorageClass::Half4) {
                        ASSERT_NEAR(found[c], exact[c], std::max(std::abs(exact[c]) * 0x1.001p-11, 0x1p-25)) << about.name;
                    } else if (scale > 0) {
                        const double codes = (srgb ? linear_to_srgb(found[c]) : double(found[c])) * scale,
                                     exact_codes = (srgb ? linear_to_srgb(exact[c]) : exact[c]) * scale;
                        worst_codes = std::max(worst_codes, std::abs(codes - exact_codes));
                        ASSERT_NEAR(codes, exact_codes, 0.5 + 1e-3)
                            << about.name << " level " << level << " texel " << x << ',' << y << " channel " << c;
                    }
                }
            });
            if (HasFatalFailure()) return;
        }
    }
    tell_tested(texels, "texels");
    tell_worst_case("off_in_codes", worst_codes);
}

TEST(Mips, InFloatStorageKeepTheMeanWhateverTheFormat) {
    double worst = 0;
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA8Srgb, Format::RGBA16Half, Format::BC1RgbaSrgb, Format::RGBA32Float}) {
        for (const auto& [width, height] : kExtents) {
            Texture texture("hashed", std::make_unique<HashedSource>(format, Shape{.width = width, .height = height}),
                            {.mip_storage = MipStorage::Float});
            ASSERT_EQ(texture.texel_layout().storage, StorageClass::Float4);
            for (int level = 0; level < texture.shape().levels; ++level) {
                double base = 0, mean = 0, largest = 0;
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) {
                        base += texture.texel(0, 0, x, y)[1] / double(width * height);
                        largest = std::max(largest, double(std::abs(texture.texel(0, 0, x, y)[1])));
                    }
                }
                const int w = level_extent(width, level), h = level_extent(height, level);
                for (int y = 0; y < h; ++y) {
                    for (int x = 0; x < w; ++x) mean += texture.texel(level, 0, x, y)[1] / double(w * h);
                }
                if (largest > 0) worst = std::max(worst, std::abs(mean - base) / largest);
                ASSERT_NEAR(mean, base, largest * level * 0x1p-24)
                    << info(format).name << ' ' << width << 'x' << height << " level " << level;
            }
        }
    }
    tell_worst_case("mean_off_by_of_the_largest_texel", worst);
}

TEST(Mips, OfA3dTextureAverageItsDepthToo) {
    Texture texture("volume", std::make_unique<HashedSource>(Format::RGBA32Float, Shape{.width = 9, .height = 6, .depth = 5}));
    EXPECT_EQ(texture.shape().levels, 4);
    for_each_generated_texel(texture, [&](int level, int slice, int x, int y) {
        const std::array<double, 4> exact = mean_below(texture, level, slice, x, y);
        ASSERT_NEAR(texture.texel(level, slice, x, y)[2], exact[2], std::abs(exact[2]) * 0x1p-24 + 1e-6);
    });
}

TEST(Mips, OfAnArrayStayWithinTheirLayer) {
    Texture texture("array", std::make_unique<HashedSource>(Format::RGBA8Unorm, Shape{.width = 8, .height = 8, .layers = 3}));
    for_each_generated_texel(texture, [&](int level, int slice, int x, int y) {
        ASSERT_NEAR(texture.texel(level, slice, x, y)[0], mean_below(texture, level, slice, x, y)[0], 0.501 / 255) << "layer " << slice;
    });
}

TEST(Mips, ContinueWhereTheFileStops) {
    Texture texture("partial", std::make_unique<HashedSource>(Format::RGBA8Unorm, Shape{.width = 32, .height = 32, .levels = 3}));
    EXPECT_EQ(texture.source_levels(), 3);
    EXPECT_EQ(texture.shape().levels, 6);
    texture.texel(2, 0, 0, 0);
    EXPECT_EQ(texture.work().blocks_decoded_mips, 0u);
    for_each_generated_texel(texture, [&](int level, int slice, int x, int y) {
        ASSERT_NEAR(texture.texel(level, slice, x, y)[0], mean_below(texture, level, slice, x, y)[0], 0.501 / 255);
    });
}

TEST(Mips, KeepConstantsAndLinearRamps) {
    for (const auto& [width, height] : kExtents) {
        Texture constant("constant", float_image(width, height, [](int, int) { return 0.3f; }));
        for_each_generated_texel(constant,
                                 [&](int level, int slice, int x, int y) { ASSERT_EQ(constant.texel(level, slice, x, y)[0], 0.3f); });

        // A ramp stays one: exactly that ramp at the wider texels' centres when the extents are even; when one is odd, texels share a
        // column and the ends move inwards by at most 1/(2N) of a texel, but steps stay equal.
        Texture ramp("ramp", float_image(width, height, [](int x, int y) { return 2 * (float(x) + 0.5f) + 3 * (float(y) + 0.5f); }));
        const int w = level_extent(width, 1), h = level_extent(height, 1);
        const double moved = (width % 2) * 2 * 0.5 / width + (height % 2) * 3 * 0.5 / height;
        const auto value = [&](int x, int y) { return double(ramp.texel(ramp.shape().levels > 1 ? 1 : 0, 0, x, y)[0]); };
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                const double exact = 2 * (x + 0.5) * width / w + 3 * (y + 0.5) * height / h;
                ASSERT_NEAR(value(x, y), exact, exact * 0x1p-23 + moved) << width << 'x' << height << " texel " << x << ',' << y;
                if (x > 1) {
                    ASSERT_NEAR(value(x, y) - value(x - 1, y), value(x - 1, y) - value(x - 2, y), exact * 0x1p-21);
                }
                if (y > 1) {
                    ASSERT_NEAR(value(x, y) - value(x, y - 1), value(x, y - 1) - value(x, y - 2), exact * 0x1p-21);
                }
            }
        }
    }
}

TEST(Mips, OfAnEvenSrgbCheckerAre188) {
    std::vector<std::byte> texels;
    for (int i = 0; i < 64; ++i) {
        for (int c = 0; c < 4; ++c) texels.push_back((i / 8 + i % 8) % 2 == 0 ? std::byte(0) : std::byte(255));
    }
    Texture texture("checker", make_memory_source(Format::RGBA8Srgb, 8, 8, texels));
    for (int level = 1; level < 4; ++level) {
        const std::array<float, 4> value = texture.texel(level, 0, 0, 0);
        EXPECT_EQ(value[0], srgb8_table()[188]) << "level " << level;
        EXPECT_NEAR(value[3], 0.5, 0.51 / 255) << "alpha is linear";
    }
    tell_worst_case("code_of_an_even_checker", int(encode_srgb8(texture.texel(3, 0, 0, 0)[0])));
}

}  // namespace
}  // namespace rawtexel::texunit
