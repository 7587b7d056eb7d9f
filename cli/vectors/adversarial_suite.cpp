// The known pitfalls of stochastic texture filtering, a group each: faults that ports were found to have, and those that theory warns of.
#include "cli/vectors/suite_builder.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace rawtexel::cli {
namespace {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Wrap;

constexpr std::array kWraps = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce};
constexpr float kAlmostOne = 1 - 0x1p-24f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The suite at work: textures of every shape, and makers of cases on them.
struct Adversary {
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

    CaseRecord lookup(uint32_t texture, const Kernel& kernel, MipMode mip = MipMode::None, Wrap s = Wrap::Repeat, Wrap t = Wrap::Repeat) {
        SamplerState sampler;
        sampler.magnify = sampler.minify = kernel;
        sampler.mip = mip;
        sampler.wrap_s = s, sampler.wrap_t = t, sampler.wrap_r = s;
        sampler.border = {0.9f, 0.1f, 0.6f, 0.4f};
        CaseRecord record;
        record.op = PortOp::Sample;
        record.texture = texture;
        set_sampler(sampler, record);
        record.at = {builder.unit(), builder.unit(), builder.unit()};
        record.layer = float(builder.below(4));
        if (texture == cube) record.at = {builder.between(-1, 1), builder.between(-1, 1), builder.between(-1, 1)};
        return record;
    }
    CaseRecord drawn(CaseRecord record, Estimator estimator) {
        record.op = PortOp::Draw;
        record.estimator = uint32_t(estimator);
        builder.draw_numbers(record);
        return record;
    }
    Wrap any_wrap() { return kWraps[size_t(builder.below(5))]; }
    Estimator either() { return builder.chance(0.5f) ? Estimator::Reservoir : Estimator::Jitter; }
    void footprint(CaseRecord& record, float least_log2, float most_log2, float ratio = 1.5f) {
        builder.draw_footprint(record, std::exp2(builder.between(least_log2, most_log2)), ratio);
    }
    /// A footprint of a volume or cube map.
    void solid_footprint(CaseRecord& record) {
        const float size = std::exp2(builder.between(-6, -1));
        for (size_t axis = 0; axis < 3; ++axis)
            record.dx[axis] = builder.between(-size, size), record.dy[axis] = builder.between(-size, size);
    }
};

void add_addresses(Adversary& a) {
    a.group("clamp reaches every texel", "clamping to [1/N, 1 - 1/N] before floor never reads texel 0, and of 2x2 only texel (1, 1)");
    for (const Wrap wrap : {Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
        for (const uint32_t texture : {a.tiny, a.square}) {
            a.builder.add_some(16, [&] {
                CaseRecord record = a.drawn(a.lookup(texture, Kernel::Nearest, MipMode::None, wrap, wrap), Estimator::Reservoir);
                record.at = {a.builder.between(-0.2f, 0.3f), a.builder.between(0.7f, 1.2f), 0};
                return record;
            });
        }
    }
    a.group("the border has its colour", "the verdict that a texel is beyond the edge must reach the load of a drawn texel too");
    a.builder.add_some(24, [&] {
        CaseRecord record =
            a.drawn(a.lookup(a.square, Kernel::Bilinear, MipMode::None, Wrap::ClampToBorder, Wrap::ClampToBorder), a.either());
        record.at = {a.builder.between(-0.1f, 0.1f), a.builder.between(0.9f, 1.1f), 0};
        return record;
    });
    a.group("across the seam", "a footprint that crosses u = 0 wraps tap by tap; an address helper that is told a size of 1 reads texel 0");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.square, Kernel::BSpline, MipMode::None, a.any_wrap(), a.any_wrap());
        record.at = {a.builder.between(-0.08f, 0.08f), a.builder.between(0.92f, 1.08f), 0};
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("wraps come after selection", "a drawn texel wraps as an integer: each kernel's mean under a wrap is that of the filter");
    for (const Wrap wrap : kWraps) {
        a.builder.add_some(12, [&] {
            CaseRecord record =
                a.drawn(a.lookup(a.square, a.builder.chance(0.5f) ? Kernel::gaussian(1) : Kernel::Quadratic, MipMode::None, wrap, wrap),
                        a.either());
            record.at = {a.builder.between(-2, 3), a.builder.between(-2, 3), 0};
            return record;
        });
    }
    a.group("just below 0", "frac(-1e-9) is 1 in 32-bit floats: the index is wrapped again, as an integer", true);
    for (const float u : {-1e-9f, -1e-20f, -0.0f, -0x1p-120f, -0x1p-25f}) {
        for (const Wrap wrap : kWraps)
            a.builder.add([&] {
                CaseRecord record = a.lookup(a.square, Kernel::Nearest, MipMode::None, wrap, wrap);
                record.at = {u, 0.25f, 0};
                return record;
            }());
    }
    a.group("ties and texel centres",
            "texel i has its centre at i + 1/2, and floor decides: rounding half to even is off at every other edge", true);
    for (int k = -16; k <= 32; ++k) {
        CaseRecord record = a.lookup(a.square, Kernel::Nearest);
        record.at = {float(k) / 16, float(k) / 32, 0};
        a.builder.add(record);
    }
    a.group("centres of 4095 texels", "an index that goes through a float coordinate and back comes back");
    for (int i = 0; i < 4095; i += 63) {
        CaseRecord record = a.lookup(a.wide, Kernel::Nearest);
        record.at = {(float(i) + 0.5f) / 4095, 0.5f, 0};
        a.builder.add(record);
    }
    a.group("far from the origin",
            "at u = 4096 a 32-bit float has 2048 steps: whole repeats are taken away before the coordinate is scaled");
    a.builder.add_some(32, [&] {
        CaseRecord record =
            a.lookup(a.odd, Kernel::Bilinear, MipMode::None, a.builder.chance(0.5f) ? Wrap::Repeat : Wrap::MirroredRepeat, Wrap::Repeat);
        record.at = {a.builder.between(4000, 4200), a.builder.between(-4200, -4000), 0};
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
}

void add_levels(Adversary& a) {
    a.group("every lane has its level",
            "neighbouring lanes read levels of different sizes: some implementations of textureSize(image, level) "
            "answer a whole SIMD group with the size of its first lane's level");
    a.builder.add_some(128, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Nearest, MipMode::Nearest);
        a.footprint(record, -1, 6);
        return record;
    });
    a.group("every lane has its texture",
            "neighbouring lanes ask different textures and draw different levels: texels must not be shared blindly");
    a.builder.add_some(64, [&] {
        const uint32_t textures[] = {a.square, a.odd, a.thin, a.tiny};
        CaseRecord record = a.drawn(a.lookup(textures[a.builder.below(4)], Kernel::Bilinear, MipMode::Linear), a.either());
        a.footprint(record, -1, 5);
        return record;
    });
    a.group("level, kernel and alpha count", "not level 0, not bilinear, and alpha is a channel like the others");
    a.builder.add_some(24, [&] {
        CaseRecord record = a.lookup(a.odd, a.builder.chance(0.5f) ? Kernel::BSpline : Kernel::gaussian(), MipMode::Linear);
        a.footprint(record, 1, 4);
        return record;
    });
    a.group("bias is added to derivatives",
            "of flat textures, arrays, volumes and cube maps: zero derivatives in its place leave clamp(0 + bias)");
    for (const uint32_t texture : {a.odd, a.array, a.volume, a.cube}) {
        a.builder.add_some(12, [&] {
            CaseRecord record = a.lookup(texture, Kernel::Bilinear, MipMode::Linear);
            if (texture == a.volume || texture == a.cube) {
                a.solid_footprint(record);
            } else {
                a.footprint(record, 0, 4);
            }
            record.lod_bias = a.builder.between(-2, 2);
            return record;
        });
    }
    a.group("no footprint", "the logarithm of a footprint without size is clamped; a derivative that is not finite means the last level",
            true);
    for (const uint32_t texture : {a.odd, a.array, a.volume, a.cube}) {
        for (const float size : {0.0f, kInfinity, kNan}) {
            CaseRecord record = a.lookup(texture, Kernel::Nearest, MipMode::Nearest);
            record.at = {0.40625f, 0.28125f, 0.84375f};
            record.dx = {size, 0, 0};
            a.builder.add(record);
        }
    }
    a.group("clamp before the level is drawn", "lambda beyond the last level or below 0 leaves nothing to draw");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.drawn(a.lookup(a.square, Kernel::Bilinear, MipMode::Linear), a.either());
        if (a.builder.chance(0.5f))
            a.footprint(record, 4.1f, 9);
        else
            a.footprint(record, -8, -0.1f);
        return record;
    });
    a.group("last levels of thin textures", "sizes are max(1, n >> level): 0 makes weights that are not numbers");
    a.builder.add_some(48, [&] {
        CaseRecord record = a.lookup(a.thin, Kernel::Bilinear, MipMode::Linear);
        a.footprint(record, 0, 7);
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("levels of odd textures", "coordinates are scaled by the level's own size, not by that of level 0 over a power of two");
    a.builder.add_some(48, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        a.footprint(record, 1, 6);
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("ratios beyond 16", "the number of probes is the sampler's; an axis without length is not level 0");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        record.probes = a.builder.chance(0.5f) ? 32 : 64;
        a.footprint(record, 3, 6, a.builder.between(16, 64));
        if (a.builder.chance(0.25f)) record.dy = {};
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("as many probes as counted", "counts of probes and texels follow from the footprint and nothing else");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        record.probes = 8;
        a.footprint(record, 1, 5, std::exp2(a.builder.between(0, 4)));
        return record;
    });
}

void add_draws(Adversary& a) {
    a.group("normal offsets of volumes",
            "each axis has a number of its own; one number for radius and angle has neither mean 0 nor variance 1");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.drawn(a.lookup(a.volume, Kernel::gaussian(0.7f), MipMode::None, a.any_wrap()), a.either());
        return record;
    });
    a.group("volumes have three axes", "the slice is weighed, wrapped and drawn like x and y");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.volume, a.builder.chance(0.5f) ? Kernel::Bilinear : Kernel::BSpline, MipMode::Linear, a.any_wrap());
        a.solid_footprint(record);
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("a number of 0", "is as good as any other: no logarithm of 0, no offset that is not finite");
    for (const Kernel& kernel : {Kernel::gaussian(0.5f), Kernel::gaussian(0.02f), Kernel::BSpline, Kernel::Bilinear}) {
        for (const float number : {0.0f, kAlmostOne}) {
            a.builder.add_some(4, [&] {
                CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Jitter);
                record.number_x = record.number_y = number;
                return record;
            });
        }
    }
    a.group("a tap of weight 0", "on a texel's centre the first and the last number draw no tap that weighs nothing", true);
    for (const Kernel& kernel : {Kernel::BSpline, Kernel::Bilinear, Kernel::CatmullRom, Kernel::Lanczos3}) {
        for (const float number : {0.0f, 0x1p-24f, kAlmostOne}) {
            CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Reservoir);
            record.at = {5.5f / 16, 9.5f / 16, 0};
            record.number_x = record.number_y = record.number_sign = number;
            a.builder.add(record);
        }
    }
    a.group("the largest number",
            "weights that round to less than 1 in sum leave room for no other tap than the last that weighs anything");
    for (const Kernel& kernel : {Kernel::gaussian(0.3f), Kernel::gaussian(0.5f), Kernel::gaussian_point(0.4f), Kernel::Lanczos3}) {
        a.builder.add_some(12, [&] {
            CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Reservoir);
            record.number_x = record.number_y = kAlmostOne;
            return record;
        });
    }
    a.group("Gaussians are integrated over texels",
            "offsets drawn from a normal and rounded to texels have the integral over the texel as weight, not the density");
    a.builder.add_some(24, [&] { return a.drawn(a.lookup(a.square, Kernel::gaussian(a.builder.between(0.3f, 1))), Estimator::Reservoir); });
    a.builder.add_some(8, [&] { return a.lookup(a.square, Kernel::gaussian(a.builder.between(0.1f, 0.4f))); });
    a.group("one number, one choice", "level, probe, sign and both axes have numbers of their own; none is used again");
    a.builder.add_some(48, [&] {
        CaseRecord record =
            a.drawn(a.lookup(a.odd, a.builder.chance(0.5f) ? Kernel::CatmullRom : Kernel::BSpline, MipMode::Linear), Estimator::Reservoir);
        record.probes = 8;
        a.footprint(record, 1, 5, 6);
        return record;
    });
    a.group("maps share their numbers", "maps of other resolutions draw with the same numbers: the same offset of either's own texels");
    for (int n = 0; n < 16; ++n) {
        a.builder.add_some(1, [&] {
            CaseRecord record = a.drawn(a.lookup(a.square, Kernel::Bilinear), Estimator::Jitter);
            return record;
        });
        CaseRecord record = a.builder.suite().cases.back();
        record.texture = a.odd;
        a.builder.add(record);
    }
    a.group("the same case again", "shadow and colour passes draw the same texel: an answer depends on the case, not on its place");
    const std::vector<CaseRecord> before(a.builder.suite().cases.end() - 24, a.builder.suite().cases.end());
    for (auto record = before.rbegin(); record != before.rend(); ++record) a.builder.add(*record);
    a.group("cube maps", "offsets are texels of a face, and go on over its edges; at a corner three texels meet");
    for (int n = 0; n < 3; ++n) {
        a.builder.add_some(32, [&] {
            CaseRecord record = a.lookup(a.cube, n == 0 ? Kernel::Nearest : n == 1 ? Kernel::Bilinear : Kernel::BSpline, MipMode::Linear);
            if (a.builder.chance(0.5f)) {  // Near an edge or a corner.
                for (float& component : record.at) component = std::copysign(a.builder.between(0.8f, 1), component);
                if (a.builder.chance(0.5f)) record.at[size_t(a.builder.below(3))] = a.builder.between(-1, 1);
            }
            a.solid_footprint(record);
            return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
        });
    }
    a.group("an infinite texel beside", "a tap of weight 0 is not read: 0 times infinity is not a number", true);
    const uint32_t infinite = [&] {
        texunit::Shape shape{.width = 4, .height = 4, .levels = 3};
        std::vector<float> values(4 * (16 + 4 + 1), 0.5f);
        for (size_t n = 0; n < 16; n += 2) values[4 * n] = kInfinity;
        std::vector<std::byte> bytes(values.size() * 4);
        std::memcpy(bytes.data(), values.data(), bytes.size());
        return a.builder.add_texture({"infinities 4x4", texunit::Format::RGBA32Float, shape, std::move(bytes)});
    }();
    for (const int x : {1, 3}) {
        for (const Kernel& kernel : {Kernel::Bilinear, Kernel::CatmullRom}) {
            CaseRecord record = a.lookup(infinite, kernel);
            record.at = {(float(x) + 0.5f) / 4, 0.375f, 0};
            a.builder.add(record);
        }
    }
}

void add_estimates(Adversary& a) {
    a.group("what others lack", "quadratic and negative lobes, one probe of many, the ellipse: each is drawn, too");
    for (const Kernel& kernel : {Kernel::Quadratic, Kernel::mitchell(), Kernel::Lanczos3}) {
        a.builder.add_some(8, [&] { return a.drawn(a.lookup(a.odd, kernel), Estimator::Reservoir); });
    }
    a.builder.add_some(8, [&] {
        CaseRecord record = a.drawn(a.lookup(a.square, Kernel::Bilinear), Estimator::Jitter);
        record.ellipse = 1.0f / 6;
        a.footprint(record, 0, 4, 4);
        return record;
    });
    a.group("weights of either sign are normalised",
            "raw sinc weights do not sum to 1; subtract after shading, and let the result be negative");
    a.builder.add_some(
        32, [&] { return a.drawn(a.lookup(a.tiny, Kernel::Lanczos3, MipMode::None, a.any_wrap(), a.any_wrap()), Estimator::Reservoir); });
    a.builder.add_some(16, [&] { return a.lookup(a.tiny, a.builder.chance(0.5f) ? Kernel::Lanczos3 : Kernel::Lanczos2); });
    a.group("a drawn texel is raw", "a jittered coordinate that goes to a linear sampler is filtered twice");
    a.builder.add_some(32, [&] { return a.drawn(a.lookup(a.square, Kernel::BSpline), Estimator::Jitter); });
    a.group("no blend between two normals", "a drawn texel of a normal map is one facet, not a curve; its length is the texel's");
    a.builder.add_some(16, [&] { return a.drawn(a.lookup(a.tiny, Kernel::Bilinear), Estimator::Reservoir); });
    a.group("the mean of draws", "is that of the filter when nothing is clamped to neighbours on the way");
    a.builder.add_some(8, [&] {
        CaseRecord record = a.lookup(a.square, a.builder.chance(0.5f) ? Kernel::CatmullRom : Kernel::BSpline);
        record.op = PortOp::Mean;
        record.estimator = uint32_t(Estimator::Reservoir);
        record.count = 64;
        record.pixel_x = uint32_t(a.builder.below(1000)), record.pixel_y = uint32_t(a.builder.below(1000));
        return record;
    });
    a.group("a camera at rest", "a history that is not resampled adds no blur: 32 samples of one pixel");
    a.builder.add_some(8, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        record.op = PortOp::Mean;
        record.estimator = uint32_t(Estimator::Jitter);
        record.count = 32;
        record.pixel_x = uint32_t(a.builder.below(1000)), record.pixel_y = uint32_t(a.builder.below(1000));
        a.footprint(record, 0, 2);
        return record;
    });
    const auto shaded = [&](CaseRecord record, uint32_t order, uint32_t shader) {
        record.op = PortOp::Shade;
        record.order = order, record.shader = shader;
        return record;
    };
    a.group("magnified and squared", "filtering after shading has the square's own frequencies, which no later filter takes away");
    a.builder.add_some(16, [&] { return shaded(a.lookup(a.square, Kernel::Lanczos3), 1, 1); });
    a.group("minified and squared", "filtering before shading stays wrong at any number of samples");
    a.builder.add_some(16, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        record.probes = 8;
        a.footprint(record, 2, 5, 6);
        return shaded(record, 1, 1);
    });
    a.group("which order is which", "before: the shader of the mean; after: the mean of the shader. The same lookups in both");
    for (int n = 0; n < 12; ++n) {
        const CaseRecord record = a.lookup(a.square, Kernel::Bilinear);
        for (const uint32_t order : {0u, 1u}) a.builder.add(shaded(record, order, 2));
    }
    a.group("sRGB texels", "the drawn code is decoded; nothing is ever filtered in codes");
    texunit::Shape shape{.width = 8, .height = 8, .levels = 4};
    std::vector<std::byte> codes(4 * (64 + 16 + 4 + 1));
    for (std::byte& code : codes) code = std::byte(a.builder.bits() >> 24);
    const uint32_t encoded = a.builder.add_texture({"codes 8x8", texunit::Format::RGBA8Srgb, shape, std::move(codes)});
    a.builder.add_some(24, [&] { return a.drawn(a.lookup(encoded, Kernel::BSpline), a.either()); });
    a.builder.add_some(8, [&] { return a.lookup(encoded, Kernel::BSpline); });
}

void add_numbers(Adversary& a) {
    const auto number = [](uint32_t x, uint32_t y, uint32_t sample) {
        CaseRecord record;
        record.op = PortOp::Random;
        record.pixel_x = x, record.pixel_y = y, record.sample = sample;
        record.dimension = uint32_t(texunit::Dimension::TapX);
        return record;
    };
    a.group("a number is never 1", "32 random bits as a float round up to 1: only the upper 24 are used", true);
    // Addresses whose bits are 0xFFFFFF80 and more, or next to 0.
    for (const auto& [x, y, sample] :
         {std::array{2083u, 3596u, 1u}, {762u, 3712u, 1u}, {1950u, 3786u, 1u}, {3688u, 1418u, 0u}, {1970u, 327u, 1u}})
        a.builder.add(number(x, y, sample));
    a.group("an address is a number", "whatever is asked before it, in whatever order", true);
    for (uint32_t n = 0; n < 32; ++n) a.builder.add(number(n * 7 % 32, 3, n % 4));
    for (uint32_t n = 32; n-- > 0;) a.builder.add(number(n * 7 % 32, 3, n % 4));
}

}  // namespace

Suite make_adversarial_suite() {
    Adversary adversary;
    add_addresses(adversary);
    add_levels(adversary);
    add_draws(adversary);
    add_estimates(adversary);
    add_numbers(adversary);
    return adversary.builder.take();
}

}  // namespace rawtexel::cli
