// What DDS and KTX2 share: files on disk, paging, threads, transfer functions.
#include "tests/texunit/container_writer.h"

#include "texunit/containers.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

using test_files::Bytes;
using test_files::random_image;
using test_files::StoredImage;
using test_files::TemporaryFile;

std::string file_refusal(const std::string& path) {
    try {
        open_file(path);
    } catch (const TextureError& error) {
        return error.what();
    }
    return "";
}

TEST(FileBytes, ReadsWhatIsThereAndNothingBeyond) {
    Bytes content(1000);
    for (size_t i = 0; i < content.size(); ++i) content[i] = std::byte(i * 7);
    const TemporaryFile file(content);
    const auto bytes = open_file(file.path());
    ASSERT_EQ(bytes->size(), 1000u);
    EXPECT_EQ(bytes->name(), file.path());
    Bytes part(10);
    bytes->read(990, part);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), content.begin() + 990));
    for (const uint64_t offset : {uint64_t{991}, uint64_t{1000}, ~uint64_t{0}, ~uint64_t{0} - 9}) {
        EXPECT_THROW(bytes->read(offset, part), TextureError) << offset;
        EXPECT_THROW(open_memory("memory", content)->read(offset, part), TextureError) << offset;
    }
}

TEST(FileBytes, RefusesWhatIsNoRegularFileWithoutWaiting) {
    EXPECT_NE(file_refusal("/nonexistent/texture.dds").find("/nonexistent/texture.dds: cannot be opened"), std::string::npos);
    EXPECT_NE(file_refusal(::testing::TempDir()).find("not a regular file"), std::string::npos);
    EXPECT_NE(file_refusal("/dev/zero").find("not a regular file"), std::string::npos);
    const std::string pipe = ::testing::TempDir() + "rawtexel_pipe_" + std::to_string(getpid());
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(file_refusal(pipe).find("not a regular file"), std::string::npos);
    std::remove(pipe.c_str());
}

TEST(ContainerKind, IsToldByTheFirstBytes) {
    const StoredImage image = random_image({.width = 4, .height = 4}, 4, 16, 1);
    EXPECT_EQ(container_kind(*open_memory("a", write_dds(image, 98))), ContainerKind::Dds);
    EXPECT_EQ(container_kind(*open_memory("a", write_ktx2(image, 145))), ContainerKind::Ktx2);
    EXPECT_EQ(container_kind(*open_memory("a", Bytes(200))), ContainerKind::None);
    EXPECT_EQ(container_kind(*open_memory("a", {})), ContainerKind::None);
}

struct FileCase {
    const char* name;
    Bytes bytes;
    StoredImage image;
    Format format;
};

std::unique_ptr<TexelSource> open_case(std::shared_ptr<const ByteSource> bytes) {
    return container_kind(*bytes) == ContainerKind::Dds ? open_dds(std::move(bytes)) : open_ktx2(std::move(bytes));
}

/// Files of several pages, whose blocks and rows straddle page boundaries, at even and odd offsets.
std::vector<FileCase> files_of_many_pages() {
    const StoredImage blocks = random_image({.width = 300, .height = 520, .levels = 9}, 4, 16, 2);
    const StoredImage texels = random_image({.width = 211, .height = 129, .layers = 6, .levels = 3}, 1, 4, 3);
    const StoredImage bytes = random_image({.width = 333, .height = 777}, 1, 1, 5);
    std::vector<FileCase> cases;
    cases.push_back({"DDS BC7", write_dds(blocks, 98), blocks, Format::BC7Unorm});
    cases.push_back({"KTX2 BC7", write_ktx2(blocks, 145), blocks, Format::BC7Unorm});
    cases.push_back({"DDS RGBA8", write_dds(texels, 28), texels, Format::RGBA8Unorm});
    cases.push_back({"KTX2 RGBA8 zstd", write_ktx2(texels, 37, 2), texels, Format::RGBA8Unorm});
    cases.push_back({"DDS R8", write_dds(bytes, 61), bytes, Format::R8Unorm});
    return cases;
}

TEST(ContainerFiles, AreReadInPages) {
    for (const FileCase& c : files_of_many_pages()) {
        const TemporaryFile file(c.bytes);
        SCOPED_TRACE(c.name);
        test_files::expect_same_texels(*open_case(open_file(file.path())), c.image, c.format);
    }
}

/// A file that remembers what was read of it.
class WatchedBytes final : public ByteSource {
  public:
    explicit WatchedBytes(Bytes bytes) : bytes_(open_memory("watched", std::move(bytes))) {}
    uint64_t size() const override { return bytes_->size(); }
    const std::string& name() const override { return bytes_->name(); }
    void read(uint64_t offset, std::span<std::byte> out) const override {
        read_ += out.size();
        bytes_->read(offset, out);
    }
    uint64_t bytes_read() const { return read_; }

  private:
    std::shared_ptr<ByteSource> bytes_;
    mutable uint64_t read_ = 0;
};

TEST(ContainerFiles, AreReadNoFurtherThanTheirHeadersUntilATexelIsAskedFor) {
    for (const FileCase& c : files_of_many_pages()) {
        SCOPED_TRACE(c.name);
        const auto file = std::make_shared<WatchedBytes>(c.bytes);
        const auto source = open_case(file);
        const uint64_t header = file->bytes_read();
        EXPECT_LE(header, 1024u);
        Bytes texels(256);
        source->decode_block(0, 0, 1, 1, texels.data());
        const uint64_t first = file->bytes_read() - header;
        EXPECT_GT(first, 0u);
        // A page or two; of a level that is compressed as a whole, that level.
        EXPECT_LE(first, std::string_view(c.name).ends_with("zstd") ? c.bytes.size() : uint64_t{128} << 10);
        EXPECT_LT(first, c.bytes.size());
        source->decode_block(0, 0, 1, 1, texels.data());
        EXPECT_EQ(file->bytes_read(), header + first) << "what was read is kept";
    }
}

TEST(ContainerFiles, GiveTheSameTexelsToManyThreads) {
    for (const FileCase& c : files_of_many_pages()) {
        const TemporaryFile file(c.bytes);
        const auto source = open_case(open_file(file.path()));
        const int blocks_x = (c.image.shape.width + 3) / 4, blocks_y = (c.image.shape.height + 3) / 4;
        std::vector<Bytes> expected;
        for (int i = 0; i < blocks_x * blocks_y; ++i) {
            expected.push_back(test_files::expected_block(c.image, c.format, 0, 0, i % blocks_x, i / blocks_x));
        }
        std::atomic<int> different = 0;
        const auto decode_all = [&](unsigned seed) {
            std::vector<int> order(expected.size());
            for (size_t i = 0; i < order.size(); ++i) order[i] = int(i);
            std::shuffle(order.begin(), order.end(), std::mt19937(seed));
            Bytes got(expected[0].size());
            for (const int i : order) {
                source->decode_block(0, 0, i % blocks_x, i / blocks_x, got.data());
                if (got != expected[size_t(i)]) ++different;
            }
        };
        std::vector<std::thread> threads;
        for (unsigned t = 0; t < 4; ++t) threads.emplace_back(decode_all, t);
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(different, 0) << c.name;
    }
}

TEST(ContainerFiles, ThatShrinkAfterOpeningAreAnErrorNotASignal) {
    for (const FileCase& c : files_of_many_pages()) {
        const TemporaryFile file(c.bytes);
        const auto source = open_case(open_file(file.path()));
        ASSERT_EQ(truncate(file.path().c_str(), 2048), 0);
        const int last_x = (c.image.shape.width - 1) / 4, last_y = (c.image.shape.height - 1) / 4;
        Bytes texels(256);
        EXPECT_THROW(source->decode_block(0, 0, last_x, last_y, texels.data()), TextureError) << c.name;
    }
}

TEST(ReinterpretSrgb, ChangesTheFormatAndNotTheTexels) {
    const StoredImage image = random_image({.width = 9, .height = 5, .levels = 2}, 4, 16, 4);
    for (const bool srgb : {false, true}) {
        const auto source = reinterpret_srgb(open_dds(open_memory("a", write_dds(image, 98))), srgb);
        test_files::expect_same_texels(*source, image, srgb ? Format::BC7Srgb : Format::BC7Unorm);
        const auto back = reinterpret_srgb(open_dds(open_memory("a", write_dds(image, 99))), srgb);
        test_files::expect_same_texels(*back, image, srgb ? Format::BC7Srgb : Format::BC7Unorm);
    }
    auto half_float = open_dds(open_memory("a", write_dds(image, 95)));
    const TexelSource* const before = half_float.get();
    EXPECT_EQ(reinterpret_srgb(std::move(half_float), true).get(), before);
}

}  // namespace
}  // namespace rawtexel::texunit
