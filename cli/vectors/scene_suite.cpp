#include "cli/vectors/scene_suite.h"

#include "cli/pixel_explanation.h"
#include "cli/vectors/expectation.h"
#include "scenes/image_io.h"
#include "shading/executor.h"
#include "texunit/draw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <queue>
#include <span>
#include <tuple>

namespace rawtexel::cli {
namespace {

using texunit::Texture;

/// A lookup that was seen.
struct SeenLookup {
    uint32_t hash = 0;
    uint32_t pixel_x = 0, pixel_y = 0;
    shading::MapSlot slot{};
    Texture* texture = nullptr;
    CaseRecord record;

    auto place() const { return std::tuple(size_t(slot), pixel_y, pixel_x, hash); }
    bool operator<(const SeenLookup& other) const { return std::tuple(hash, place()) < std::tuple(other.hash, other.place()); }
};

/// Keeps those of smallest hash: an even choice, whatever the number of lookups.
class LookupCollector final : public shading::LookupListener {
  public:
    LookupCollector(size_t most, uint32_t seed) : most_(most), seed_(seed) {}

    void begin_tile(int, int) override {}
    void begin_wave(const shading::ListenedWave& wave) override {
        wave_ = wave;
        first_ = {.x = uint32_t(wave.x), .y = uint32_t(wave.y), .sample = wave.sample, .seed = seed_};
        draw_numbers(first_, positive_);
        negative_draw_numbers(first_, negative_);
    }
    void fragments(const shading::ListenedFragments&) override {}
    void lookup(const shading::ListenedLookup& lookup) override { keep(lookup, false); }
    void drawn(const shading::ListenedDraw& draw) override {
        if (draw.first) keep(draw.lookup, true);
    }
    void end_wave() override {}
    void end_sample() override {}
    void end_tile() override {}

    std::vector<SeenLookup> take() {
        std::vector<SeenLookup> seen;
        for (; !kept_.empty(); kept_.pop()) seen.push_back(kept_.top());
        std::ranges::sort(seen, {}, &SeenLookup::place);
        return seen;
    }

  private:
    void keep(const shading::ListenedLookup& lookup, bool drawn) {
        for (texunit::WaveMask lanes = lookup.lanes; lanes != 0; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            SeenLookup seen;
            seen.pixel_x = uint32_t(wave_.x + lane % texunit::kWaveWidth), seen.pixel_y = uint32_t(wave_.y + lane / texunit::kWaveWidth);
            seen.slot = lookup.slot;
            seen.texture = lookup.map->texture;
            seen.hash = texunit::mix_bits(texunit::mix_bits(seen.pixel_x * texunit::kRandomStart ^ seen.pixel_y) ^ uint32_t(lookup.slot));
            if (kept_.size() == most_ && !(seen.hash < kept_.top().hash)) continue;
            seen.record = record_of(lookup, lane, drawn);
            kept_.push(seen);
            if (kept_.size() > most_) kept_.pop();
        }
    }

    CaseRecord record_of(const shading::ListenedLookup& lookup, int lane, bool drawn) const {
        CaseRecord record;
        record.op = drawn ? PortOp::Draw : PortOp::Sample;
        texunit::SamplerState sampler = lookup.map->sampler;
        if (!drawn) sampler.estimator = texunit::Estimator::All;
        set_sampler(sampler, record);
        const texunit::WaveCoordinates& at = *lookup.at;
        record.at = {at.u[lane], at.v[lane], 0};
        record.dx = {at.dudx[lane], at.dvdx[lane], 0};
        record.dy = {at.dudy[lane], at.dvdy[lane], 0};
        if (!drawn) return record;
        const auto numbers = [&](const texunit::DrawNumbers& from, float& x, float& y, float& sign) {
            x = from.x[lane], y = from.y[lane], sign = from.sign[lane];
        };
        numbers(positive_, record.number_x, record.number_y, record.number_sign);
        numbers(negative_, record.negative_x, record.negative_y, record.negative_sign);
        record.number_level = positive_.level[lane], record.number_probe = positive_.probe[lane];
        return record;
    }

    size_t most_;
    uint32_t seed_;
    shading::ListenedWave wave_;
    texunit::RandomAddress first_;
    texunit::DrawNumbers positive_, negative_;
    std::priority_queue<SeenLookup> kept_;
};

/// Every texel as linear floats: whatever its file holds.
SuiteTexture copy_texture(Texture& texture) {
    const texunit::Shape& shape = texture.shape();
    std::vector<std::byte> bytes;
    bytes.reserve(16 * texels_of(shape));
    for (int level = 0; level < shape.levels; ++level) {
        for (int slice = 0; slice < slice_count(shape, level); ++slice) {
            for (int y = 0; y < texunit::level_extent(shape.height, level); ++y) {
                for (int x = 0; x < texunit::level_extent(shape.width, level); ++x) {
                    const std::array<float, 4> texel = texture.texel(level, slice, x, y);
                    const auto added = std::as_bytes(std::span(texel));
                    bytes.insert(bytes.end(), added.begin(), added.end());
                }
            }
        }
    }
    return {texture.name(), texunit::Format::RGBA32Float, shape, std::move(bytes)};
}

}  // namespace

Suite make_scene_suite(const std::string& name, const shading::Scene& scene, const shading::Lighting& lighting,
                       const shading::RenderOptions& options, size_t cases) {
    LookupCollector collector(cases, options.seed);
    shading::RenderOptions watched = options;
    watched.listener = &collector;
    const auto one_thread = shading::make_executor(shading::ExecutorKind::Threads, 1);
    shading::render(scene, lighting, watched, *one_thread);
    std::vector<SeenLookup> seen = collector.take();
    if (seen.empty()) throw scenes::InputError(name + ": no surface of this view has a texture");

    Suite suite;
    suite.name = name;
    suite.about = "lookups of a frame of " + name;
    std::map<Texture*, uint32_t> numbers;
    uint64_t bytes = 0;
    for (const SeenLookup& lookup : seen) {
        if (!numbers.emplace(lookup.texture, uint32_t(numbers.size())).second) continue;
        bytes += 16 * texels_of(lookup.texture->shape());
        if (bytes > kMostSceneTexels)
            throw scenes::InputError(name + ": its textures take more than " + std::to_string(kMostSceneTexels) + " bytes as floats");
        suite.textures.push_back(copy_texture(*lookup.texture));
    }
    std::optional<shading::MapSlot> slot;
    for (SeenLookup& lookup : seen) {
        if (slot != lookup.slot) {
            slot = lookup.slot;
            suite.groups.push_back({std::string(name_of(*slot)), "lookups of this map", uint32_t(suite.cases.size()), 0, false});
        }
        lookup.record.texture = numbers.at(lookup.texture);
        const std::optional<Expectation> expected = expect(suite, lookup.record);
        if (!expected) {
            ++suite.left_out;
            continue;
        }
        suite.cases.push_back(lookup.record);
        suite.expected.push_back(*expected);
        ++suite.groups.back().count;
    }
    std::erase_if(suite.groups, [](const CaseGroup& group) { return group.count == 0; });
    if (suite.cases.empty())
        throw scenes::InputError(name + ": no lookup of this view has one answer; try more cases or another estimator");
    return suite;
}

}  // namespace rawtexel::cli
