// The suite of known pitfalls at work: its textures, makers of cases on them, and the pitfalls by topic. Groups are faults that ports were
// found to have, and those that theory warns of; docs/pitfalls.md lists them.
#pragma once

#include "cli/vectors/suite_builder.h"

#include <array>

namespace rawtexel::cli {

inline constexpr std::array kEveryWrap = {texunit::Wrap::Repeat, texunit::Wrap::MirroredRepeat, texunit::Wrap::ClampToEdge,
                                          texunit::Wrap::ClampToBorder, texunit::Wrap::MirrorOnce};
inline constexpr float kLargestNumber = 1 - 0x1p-24f;

class Adversary {
  public:
    SuiteBuilder builder{"adversarial", "the known pitfalls of stochastic texture filtering, by name"};
    uint32_t tiny = builder.add_noise_texture("tiny 2x2", {.width = 2, .height = 2});
    uint32_t square = builder.add_noise_texture("square 16x16", {.width = 16, .height = 16});
    uint32_t odd = builder.add_noise_texture("odd 45x60", {.width = 45, .height = 60});
    uint32_t thin = builder.add_noise_texture("thin 64x1", {.width = 64, .height = 1});
    uint32_t wide = builder.add_noise_texture("wide 4095x1", {.width = 4095, .height = 1});
    uint32_t array = builder.add_noise_texture("array 12x12 of 4", {.width = 12, .height = 12, .layers = 4});
    uint32_t volume = builder.add_noise_texture("volume 9x8x7", {.width = 9, .height = 8, .depth = 7});
    uint32_t cube = builder.add_noise_texture("cube 8x8", {.width = 8, .height = 8, .layers = 6, .cube = true});

    void group(const char* name, const char* about, bool exact = false) { builder.begin_group(name, about, exact); }

    /// A filtered lookup somewhere, or into some direction, without a footprint.
    CaseRecord lookup(uint32_t texture, const texunit::Kernel& kernel, texunit::MipMode mip = texunit::MipMode::None,
                      texunit::Wrap s = texunit::Wrap::Repeat, texunit::Wrap t = texunit::Wrap::Repeat);
    /// One draw of it, with numbers of its own.
    CaseRecord drawn(CaseRecord record, texunit::Estimator estimator);
    /// The mean of `count` draws of it, with the random numbers of some pixel.
    CaseRecord mean(CaseRecord record, texunit::Estimator estimator, uint32_t count);

    texunit::Wrap any_wrap() { return kEveryWrap[size_t(builder.below(5))]; }
    texunit::Estimator either() { return builder.chance(0.5f) ? texunit::Estimator::Reservoir : texunit::Estimator::Jitter; }
    /// Of a flat texture: the longer axis within these powers of 2, in texels.
    void footprint(CaseRecord& record, float least_log2, float most_log2, float ratio = 1.5f);
    /// Of a volume or cube map.
    void solid_footprint(CaseRecord& record);
};

void add_address_pitfalls(Adversary& a);
void add_level_pitfalls(Adversary& a);
void add_draw_pitfalls(Adversary& a);
void add_number_pitfalls(Adversary& a);
void add_order_pitfalls(Adversary& a);

}  // namespace rawtexel::cli
