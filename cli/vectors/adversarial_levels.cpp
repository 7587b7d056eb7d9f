// Pitfalls of levels and footprints: another lane's sizes, biases, footprints without size, thin textures, many probes.
#include "cli/vectors/adversary.h"

#include <cmath>
#include <limits>

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
}

void add_level_pitfalls(Adversary& a) {
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
    a.group("no footprint",
            "the logarithm of a footprint without size is clamped, with a bias too; a derivative that is not finite means the last level",
            true);
    for (const uint32_t texture : {a.odd, a.array, a.volume, a.cube}) {
        for (const float size : {0.0f, kInfinity, kNan}) {
            for (const float bias : {0.0f, 1.5f, -1.5f}) {
                CaseRecord record = a.lookup(texture, Kernel::Nearest, MipMode::Nearest);
                record.at = {0.40625f, 0.28125f, 0.84375f};
                record.dx = {size, 0, 0};
                record.lod_bias = bias;
                a.builder.add(record);
            }
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

}  // namespace rawtexel::cli
