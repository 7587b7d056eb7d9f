// Common mistakes of texture units, tried one after the other on a colour that is not legal.
#include "texunit/legal_judge.h"

#include "texunit/srgb.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

/// Everything that a verdict is about.
struct Case {
    JudgedTexture texture;
    SamplerState sampler;
    JudgedLookup lookup;
    Colour colour{};
    Suspicion suspicion;
};

struct Mistake {
    const char* name;
    std::function<void(Case&)> make;
};

void add_kernels_and_levels(const SamplerState& sampler, std::vector<Mistake>& mistakes) {
    const auto add = [&](const char* name, std::function<void(Case&)> make) { mistakes.push_back({name, std::move(make)}); };
    if (sampler.mip != MipMode::None) {
        add("level 0 alone", [](Case& c) { c.sampler.mip = MipMode::None; });
        add("level one too coarse", [](Case& c) { c.sampler.lod_bias += 1; });
        add("level one too fine", [](Case& c) { c.sampler.lod_bias -= 1; });
        if (sampler.lod_bias != 0) add("bias of the level left out", [](Case& c) { c.sampler.lod_bias = 0; });
        add("bounds of the level left out", [](Case& c) { c.sampler.min_lod = 0, c.sampler.max_lod = 1000; });
    }
    if (sampler.mip == MipMode::Linear) add("the nearest level alone", [](Case& c) { c.sampler.mip = MipMode::Nearest; });
    if (sampler.mip == MipMode::Nearest) add("two levels mixed", [](Case& c) { c.sampler.mip = MipMode::Linear; });
    if (sampler.magnify != sampler.minify)
        add("kernels of magnification and minification swapped", [](Case& c) { std::swap(c.sampler.magnify, c.sampler.minify); });
    for (const auto& [name, kernel] :
         {std::pair{"the nearest texel alone", Kernel(Kernel::Nearest)}, {"bilinear", Kernel(Kernel::Bilinear)}})
        add(name, [kernel = kernel](Case& c) { c.sampler.magnify = c.sampler.minify = kernel; });
}

void add_footprints(const Shape& shape, const SamplerState& sampler, std::vector<Mistake>& mistakes) {
    const auto add = [&](const char* name, auto make) { mistakes.push_back({name, [make](Case& c) { make(c.suspicion.footprint); }}); };
    const auto isotropic = [&](const char* name) {
        mistakes.push_back({name, [](Case& c) { c.sampler.probes = 1, c.sampler.probe_variance = 0; }});
    };
    if (shape.cube || shape.depth > 1 || (sampler.probes == 1 && sampler.probe_variance <= 0)) return;
    isotropic("isotropic, at the level of the longer axis");
    using S = FootprintSuspicion;
    add("half as many probes", [](S& s) { s.probes = 0.5; });
    add("twice as many probes", [](S& s) { s.probes = 2; });
    add("probes along the other axis", [](S& s) { s.other_axis = true; });
    add("probes at the level of the longer axis", [](S& s) { s.level_of_long = true; });
    add("probes at the level of the shorter axis, however few there may be", [](S& s) { s.level_of_short = true; });
    add("one probe at the level of many", [](S& s) { s.probes = 0; });
}

void add_addresses(const Shape& shape, const SamplerState& sampler, std::vector<Mistake>& mistakes) {
    const auto add = [&](const char* name, std::function<void(Case&)> make) { mistakes.push_back({name, std::move(make)}); };
    static constexpr const char* kShifts[3][2] = {{"half a texel left", "half a texel right"},
                                                  {"half a texel up", "half a texel down"},
                                                  {"half a slice before", "half a slice behind"}};
    const size_t axes = shape.depth > 1 ? 3 : 2;
    for (size_t axis = 0; axis < axes; ++axis) {
        for (const bool after : {false, true})
            add(kShifts[axis][after], [=](Case& c) { c.suspicion.address.shift[axis] = after ? 0.5 : -0.5; });
    }
    add("half a texel left and up", [](Case& c) { c.suspicion.address.shift = {-0.5, -0.5, 0}; });
    if (shape.cubes() > 1) {
        add("layer off by one, the one before", [](Case& c) { c.lookup.layer = std::round(c.lookup.layer) - 1; });
        add("layer off by one, the one behind", [](Case& c) { c.lookup.layer = std::round(c.lookup.layer) + 1; });
        add("layer 0", [](Case& c) { c.lookup.layer = 0; });
    }
    if (shape.cube) {
        add("edges of faces clamped", [](Case& c) { c.suspicion.address.seamless = false; });
        static constexpr const char* kFaces[6] = {"face +X", "face -X", "face +Y", "face -Y", "face +Z", "face -Z"};
        for (int face = 0; face < 6; ++face) {
            add(kFaces[face], [=](Case& c) {
                c.texture.texel = [=, texel = c.texture.texel](int level, int slice, int x, int y) {
                    return texel(level, slice / 6 * 6 + face, x, y);
                };
            });
        }
        static constexpr const char* kMirrors[3] = {"direction mirrored in x", "direction mirrored in y", "direction mirrored in z"};
        for (size_t axis = 0; axis < 3; ++axis) {
            add(kMirrors[axis], [=](Case& c) {
                c.lookup.at[axis] = -c.lookup.at[axis], c.lookup.dx[axis] = -c.lookup.dx[axis], c.lookup.dy[axis] = -c.lookup.dy[axis];
            });
        }
        return;
    }
    static constexpr const char* kFlips[3] = {"u flipped", "v flipped", "w flipped"};
    for (size_t axis = 0; axis < axes; ++axis) {
        add(kFlips[axis], [=](Case& c) {
            c.lookup.at[axis] = 1 - c.lookup.at[axis], c.lookup.dx[axis] = -c.lookup.dx[axis], c.lookup.dy[axis] = -c.lookup.dy[axis];
        });
    }
    static constexpr std::pair<const char*, std::pair<size_t, size_t>> kSwaps[] = {
        {"u and v swapped", {0, 1}}, {"u and w swapped", {0, 2}}, {"v and w swapped", {1, 2}}};
    for (const auto& [name, pair] : kSwaps) {
        if (pair.second >= axes) continue;
        add(name, [pair = pair](Case& c) {
            for (auto* v : {&c.lookup.at, &c.lookup.dx, &c.lookup.dy}) std::swap((*v)[pair.first], (*v)[pair.second]);
        });
    }
    static constexpr const char* kWraps[] = {"wrapped as repeat", "wrapped as mirror", "wrapped as clamp", "wrapped as border",
                                             "wrapped as mirror-once"};
    for (int wrap = 0; wrap < 5; ++wrap) {
        for (Wrap SamplerState::*axis : {&SamplerState::wrap_s, &SamplerState::wrap_t, &SamplerState::wrap_r}) {
            if (axis == &SamplerState::wrap_r && axes < 3) continue;
            if (sampler.*axis != Wrap(wrap)) add(kWraps[wrap], [=](Case& c) { c.sampler.*axis = Wrap(wrap); });
        }
    }
    add("border colour left out", [](Case& c) { c.sampler.border = {}; });
}

Colour encoded(const Colour& linear) {
    return {linear_to_srgb(linear[0]), linear_to_srgb(linear[1]), linear_to_srgb(linear[2]), linear[3]};
}

void add_colours(std::vector<Mistake>& mistakes) {
    const auto add = [&](const char* name, std::function<void(Case&)> make) { mistakes.push_back({name, std::move(make)}); };
    const auto encode_texels = [](Case& c) {
        c.texture.texel = [texel = c.texture.texel](int level, int slice, int x, int y) { return encoded(texel(level, slice, x, y)); };
    };
    add("red and blue swapped", [](Case& c) { std::swap(c.colour[0], c.colour[2]); });
    add("sRGB not decoded", encode_texels);
    add("filtered before sRGB is decoded", [=](Case& c) {
        encode_texels(c);
        c.colour = encoded(c.colour);
    });
    add("alpha 1", [](Case& c) {
        c.texture.texel = [texel = c.texture.texel](int level, int slice, int x, int y) {
            const Colour linear = texel(level, slice, x, y);
            return Colour{linear[0], linear[1], linear[2], 1};
        };
    });
}

}  // namespace

std::string likely_cause(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const Colour& colour,
                         const LegalPrecision& precision) {
    std::vector<Mistake> mistakes;
    add_footprints(texture.shape, sampler, mistakes);
    add_addresses(texture.shape, sampler, mistakes);
    add_kernels_and_levels(sampler, mistakes);
    add_colours(mistakes);
    for (const Mistake& mistake : mistakes) {
        Case one{texture, sampler, lookup, colour, {}};
        mistake.make(one);
        if (judge_suspected(one.texture, one.sampler, one.lookup, one.colour, precision, one.suspicion).legal) return mistake.name;
    }
    return "";
}

}  // namespace rawtexel::texunit
