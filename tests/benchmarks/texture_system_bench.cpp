// Lookups per second beside OpenImageIO's TextureSystem: the same coherent lookups into the same 4096x4096 RGBA8 texture, one thread, all
// of it decoded on either side; `lazy` is ours where only what the walk reads was decoded. The footprint is 2.7 texels wide (0.5 where
// there are no levels) and as many times longer as the probes allow, along a diagonal.
#include "texunit/draw.h"
#include "texunit/memory_source.h"
#include "texunit/random.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

namespace {

using rawtexel::texunit::kWaveHeight;
using rawtexel::texunit::kWaveLanes;
using rawtexel::texunit::kWaveWidth;
using rawtexel::texunit::MipMode;
using rawtexel::texunit::SamplerState;
using rawtexel::texunit::WaveCoordinates;

constexpr int kExtent = 4096;
constexpr int kColumns = 512, kRows = 64;  ///< of the walk
constexpr int kTile = 64;                  ///< pixels: it goes tile by tile, as renderers do

const std::vector<std::byte>& texels() {
    static const std::vector<std::byte> noise = [] {
        std::vector<std::byte> bytes(size_t(kExtent) * kExtent * 4);
        uint32_t state = 1;
        for (std::byte& byte : bytes) {
            state = state * 1664525u + 1013904223u;
            byte = std::byte(state >> 24);
        }
        return bytes;
    }();
    return noise;
}

std::unique_ptr<rawtexel::texunit::Texture> make_texture() {
    return std::make_unique<rawtexel::texunit::Texture>(
        "noise", rawtexel::texunit::make_memory_source(rawtexel::texunit::Format::RGBA8Unorm, kExtent, kExtent, texels()));
}

rawtexel::texunit::Texture& whole_texture() {
    static const std::unique_ptr<rawtexel::texunit::Texture> texture = [] {
        auto made = make_texture();
        for (int level = 0; level < made->shape().levels; ++level) {
            const int extent = std::max(1, kExtent >> level);
            for (int y = 0; y < extent; y += 4) {
                for (int x = 0; x < extent; x += 4) made->ensure(level, 0, x, y);
            }
        }
        return made;
    }();
    return *texture;
}

rawtexel::texunit::Texture& lazy_texture() {
    static const std::unique_ptr<rawtexel::texunit::Texture> texture = make_texture();
    return *texture;
}

/// A file with levels, looked up through a tile cache that holds all of it.
class TextureSystemFile {
  public:
    TextureSystemFile() : folder_(std::filesystem::temp_directory_path() / "rawtexel_texture_system_bench") {
        std::filesystem::create_directories(folder_);
        file = OIIO::ustring((folder_ / "noise.tif").string());
        OIIO::ImageBuf image(OIIO::ImageSpec(kExtent, kExtent, 4, OIIO::TypeDesc::UINT8));
        image.set_pixels(image.roi(), OIIO::TypeDesc::UINT8, texels().data());
        OIIO::ImageSpec settings;
        settings.tile_width = settings.tile_height = 64;
        settings.attribute("maketx:filtername", "box");
        if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, file.string(), settings)) {
            throw std::runtime_error(OIIO::geterror());
        }
        system = OIIO::TextureSystem::create(false);
        system->attribute("max_memory_MB", 4096.0f);
    }
    ~TextureSystemFile() {
        OIIO::TextureSystem::destroy(system);
        std::filesystem::remove_all(folder_);
    }
    TextureSystemFile(const TextureSystemFile&) = delete;
    TextureSystemFile& operator=(const TextureSystemFile&) = delete;

    OIIO::TextureSystem* system = nullptr;
    OIIO::ustring file;

  private:
    std::filesystem::path folder_;
};

TextureSystemFile& texture_system() {
    static TextureSystemFile file;
    return file;
}

struct Walk {
    float minor, ratio;  ///< of the footprint, texels
    float u(int column, int row) const { return 0.3f + step() * (kCosine * float(column) - kSine * float(row)); }
    float v(int column, int row) const { return 0.2f + step() * (kSine * float(column) + kCosine * float(row)); }
    float dudx() const { return minor * ratio / kExtent * kDiagonal; }  ///< and dvdx; the minor axis is (-dudy, dudy)
    float dudy() const { return minor / kExtent * kDiagonal; }

  private:
    static constexpr float kCosine = 0.93937271f, kSine = 0.34289781f, kDiagonal = 0.70710678f;
    float step() const { return minor / kExtent; }
};

/// The walk's lookups, wave by wave.
std::vector<WaveCoordinates> waves_of(const Walk& walk) {
    std::vector<WaveCoordinates> waves(size_t(kColumns / kWaveWidth) * (kRows / kWaveHeight));
    constexpr int kWavesPerRow = kTile / kWaveWidth, kWavesPerTile = kWavesPerRow * kTile / kWaveHeight;
    for (size_t w = 0; w < waves.size(); ++w) {
        const int tile = int(w) / kWavesPerTile, in_tile = int(w) % kWavesPerTile;
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const int column = tile * kTile + in_tile % kWavesPerRow * kWaveWidth + lane % kWaveWidth;
            const int row = in_tile / kWavesPerRow * kWaveHeight + lane / kWaveWidth;
            waves[w].u[lane] = walk.u(column, row), waves[w].v[lane] = walk.v(column, row);
            waves[w].dudx[lane] = walk.dudx(), waves[w].dvdx[lane] = walk.dudx();
            waves[w].dudy[lane] = -walk.dudy(), waves[w].dvdy[lane] = walk.dudy();
        }
    }
    return waves;
}

void look_up_waves(benchmark::State& state, rawtexel::texunit::Texture& texture, Walk walk, SamplerState sampler) {
    const std::vector<WaveCoordinates> waves = waves_of(walk);
    rawtexel::texunit::WaveColor color;
    for (const WaveCoordinates& at : waves) sample_wave(texture, sampler, at, rawtexel::texunit::kWaveFull, color);
    for (auto _ : state) {
        for (const WaveCoordinates& at : waves) {
            sample_wave(texture, sampler, at, rawtexel::texunit::kWaveFull, color);
            benchmark::DoNotOptimize(color);
        }
    }
    state.SetItemsProcessed(state.iterations() * kColumns * kRows);
}

void ours(benchmark::State& state, Walk walk, SamplerState sampler) { look_up_waves(state, whole_texture(), walk, sampler); }
void ours_lazy(benchmark::State& state, Walk walk, SamplerState sampler) { look_up_waves(state, lazy_texture(), walk, sampler); }

/// One texel a lookup, its random numbers hashed on the way, as a renderer's are.
void ours_drawn(benchmark::State& state, Walk walk, SamplerState sampler) {
    const std::vector<WaveCoordinates> waves = waves_of(walk);
    rawtexel::texunit::WaveColor color;
    uint32_t sample = 0;
    for (auto _ : state) {
        for (size_t w = 0; w < waves.size(); ++w) {
            rawtexel::texunit::DrawNumbers numbers;
            draw_numbers({.x = uint32_t(w) * kWaveWidth, .y = 0, .sample = sample}, numbers);
            sample_drawn_wave(whole_texture(), sampler, waves[w], rawtexel::texunit::kWaveFull, numbers, color);
            benchmark::DoNotOptimize(color);
        }
        ++sample;
    }
    state.SetItemsProcessed(state.iterations() * kColumns * kRows);
}

void openimageio(benchmark::State& state, Walk walk, OIIO::TextureOpt::MipMode mode) {
    TextureSystemFile& peer = texture_system();
    OIIO::TextureSystem::Perthread* const thread = peer.system->get_perthread_info();
    OIIO::TextureSystem::TextureHandle* const handle = peer.system->get_texture_handle(peer.file, thread);
    OIIO::TextureOpt options;
    options.mipmode = mode;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    options.anisotropic = 16;
    float color[4];
    const auto look_up_all = [&] {
        for (int i = 0; i < kColumns * kRows; ++i) {
            const int column = i / (kTile * kTile) * kTile + i % kTile, row = i / kTile % kTile;
            OIIO::TextureOpt own = options;  // the call may write to it
            own.rnd = float(i % 1024) / 1024;
            peer.system->texture(handle, thread, own, walk.u(column, row), walk.v(column, row), walk.dudx(), walk.dudx(), -walk.dudy(),
                                 walk.dudy(), 4, color);
            benchmark::DoNotOptimize(color);
        }
    };
    look_up_all();
    for (auto _ : state) look_up_all();
    state.SetItemsProcessed(state.iterations() * kColumns * kRows);
}

constexpr Walk kMagnified{0.5f, 1}, kRound{2.7f, 1}, kLong{2.7f, 16};

BENCHMARK_CAPTURE(ours, bilinear, kMagnified, SamplerState{.mip = MipMode::None});
BENCHMARK_CAPTURE(openimageio, bilinear, kMagnified, OIIO::TextureOpt::MipModeNoMIP);
BENCHMARK_CAPTURE(ours, trilinear, kRound, SamplerState{});
BENCHMARK_CAPTURE(openimageio, trilinear, kRound, OIIO::TextureOpt::MipModeTrilinear);
BENCHMARK_CAPTURE(ours, anisotropic_16, kLong, SamplerState{.probes = 16});
BENCHMARK_CAPTURE(ours_lazy, anisotropic_16, kLong, SamplerState{.probes = 16});
BENCHMARK_CAPTURE(ours, anisotropic_16_exact_axes, kLong, SamplerState{.probes = 16, .lod_rule = rawtexel::texunit::LodRule::Exact});
BENCHMARK_CAPTURE(ours, anisotropic_16_by_variance, kLong, SamplerState{.probes = 16, .probe_variance = 1.0f / 6});
BENCHMARK_CAPTURE(ours, anisotropic_32_by_variance, kLong, SamplerState{.probes = 32, .probe_variance = 1.0f / 6});
BENCHMARK_CAPTURE(openimageio, anisotropic_16, kLong, OIIO::TextureOpt::MipModeAniso);
BENCHMARK_CAPTURE(ours_drawn, stochastic_anisotropic_16, kLong, SamplerState{.probes = 16});
BENCHMARK_CAPTURE(openimageio, stochastic_anisotropic_16, kLong, OIIO::TextureOpt::MipModeStochasticAniso);
BENCHMARK_CAPTURE(ours, elliptical, kLong, SamplerState{.ellipse = 1.0f / 6});

}  // namespace
