#include "texunit/legal_interval.h"

#include "texunit/colour_hull.h"
#include "texunit/legal_judge.h"
#include "texunit/probe_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace rawtexel::texunit {
namespace {

/// Where and how one lookup may be made.
struct Reading {
    const JudgedTexture& texture;
    const SamplerState& sampler;
    const LegalPatches& patches;
    const LegalPlace& place;
    const LegalLine& line;
};

/// Calls one(level) and two(level, coarser level, range of its share) for what legal levels of detail `lod` read.
template <class One, class Two>
void for_levels(MipMode mip, int levels, Range lod, const One& one, const Two& two) {
    const double last = levels - 1;
    const Range d{std::clamp(lod.low, 0.0, last), std::clamp(lod.high, 0.0, last)};
    if (mip == MipMode::None) return one(0);
    if (mip == MipMode::Nearest) {
        // Half-way either level is legal (Vulkan "Image Level(s) Selection").
        const int first = int(std::ceil(d.low + 0.5)) - 1, end = std::min(int(std::floor(d.high + 0.5)), levels - 1);
        for (int level = std::max(first, 0); level <= end; ++level) one(level);
        return;
    }
    for (int level = int(std::floor(d.low)); level <= int(std::floor(d.high)); ++level) {
        const Range share{std::clamp(d.low - level, 0.0, 1.0), std::clamp(d.high - level, 0.0, 1.0)};
        if (level == levels - 1 || share.high == 0) {
            one(level);
            continue;
        }
        two(level, share);
    }
}

/// Whether a coordinate is too far off to be judged in any of the levels.
bool is_open(const Reading& reading, const LegalPlace& place) {
    const double first = reading.sampler.mip == MipMode::None ? 0 : reading.line.lod.low - 0.5;
    return reading.patches.is_open(place, int(std::clamp(std::floor(first), 0.0, double(reading.texture.shape.levels - 1))));
}

/// The closest of sums of probes.
struct HullSearch {
    const Colour& wanted;
    double threshold;
    double excess = std::numeric_limits<double>::infinity();
    Colour closest{}, least, most;

    void visit(const ColourHull& finer, const ColourHull& coarser, Range share) {
        Colour low, high;
        for (size_t c = 0; c < 4; ++c) {
            const auto mixed = [&](const Colour& a, const Colour& b, double s) { return a[c] + s * (b[c] - a[c]); };
            const Colour finer_low = finer.least(), finer_high = finer.most(), coarser_low = coarser.least(), coarser_high = coarser.most();
            low[c] = std::min(mixed(finer_low, coarser_low, share.low), mixed(finer_low, coarser_low, share.high));
            high[c] = std::max(mixed(finer_high, coarser_high, share.low), mixed(finer_high, coarser_high, share.high));
            least[c] = std::min(least[c], low[c]), most[c] = std::max(most[c], high[c]);
        }
        const double found = ColourHull::excess(finer, coarser, share, wanted, threshold);
        if (found >= excess) return;
        excess = found;
        for (size_t c = 0; c < 4; ++c) closest[c] = std::clamp(wanted[c], low[c], high[c]);
    }
};

/// Pairs of patches in two levels that are searched one by one. Where a coordinate is so uncertain that there are more, their hulls judge,
/// which hold every legal colour and a little more.
constexpr size_t kMostPairs = 1 << 12;

/// All colours of one probe.
void search_one(const Reading& reading, const Kernel& kernel, Range lod, ColourSearch& search, HullSearch& hulls) {
    for_levels(
        reading.sampler.mip, reading.texture.shape.levels, lod,
        [&](int level) {
            for (const ColourPatch& patch : reading.patches.at(reading.place, kernel, level)) search.visit(patch);
        },
        [&](int level, Range share) {
            const auto finer = reading.patches.at(reading.place, kernel, level);
            const auto coarser = reading.patches.at(reading.place, kernel, level + 1);
            if (finer.size() * coarser.size() > kMostPairs) {
                ColourHull finer_hull, coarser_hull;
                finer_hull.add(1, finer);
                coarser_hull.add(1, coarser);
                return hulls.visit(finer_hull, coarser_hull, share);
            }
            for (const auto effort : {ColourSearch::Effort::Descent, ColourSearch::Effort::Whole}) {
                for (const ColourPatch& patch : finer) {
                    for (const ColourPatch& second : coarser) search.visit(patch, second, share, effort);
                }
                if (search.excess() <= 1) return;
            }
        });
}

/// Where probe i of a line may lie.
LegalPlace probe_place(const Reading& reading, double place_on_axis) {
    LegalPlace place = reading.place;
    for (size_t axis = 0; axis < 2; ++axis) {
        const double distance = place_on_axis * reading.line.axis[axis].value;
        // The sum is rounded once more, in steps of its own size and of those of its parts.
        place.at[axis].error += std::abs(place_on_axis) * reading.line.axis[axis].error + std::abs(distance) * 0x1p-22;
        place.at[axis].value += distance;
    }
    return place;
}

const ProbeTable& probe_table(const LegalLine& line) { return line.normal ? gaussian_probes() : uniform_probes(); }

/// The probes of a line in one level, each at its own place.
ColourHull probe_sum(const Reading& reading, const Kernel& kernel, int level) {
    const LegalLine& line = reading.line;
    const ProbeTable& table = probe_table(line);
    const auto first = size_t(kMostProbes * line.probes), count = size_t(line.probes);
    ColourHull sum;
    for (size_t i = first; i < first + count; ++i)
        sum.add(double(table.weight[i]), reading.patches.at(probe_place(reading, double(table.place[i])), kernel, level));
    return sum;
}

void search_probes(const Reading& reading, const Kernel& kernel, Range lod, HullSearch& search) {
    for_levels(
        reading.sampler.mip, reading.texture.shape.levels, lod,
        [&](int level) {
            const ColourHull sum = probe_sum(reading, kernel, level);
            search.visit(sum, sum, {0, 0});
        },
        [&](int level, Range share) { search.visit(probe_sum(reading, kernel, level), probe_sum(reading, kernel, level + 1), share); });
}

}  // namespace

LegalVerdict judge_suspected(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const Colour& colour,
                             const LegalPrecision& precision, const Suspicion& suspicion) {
    assert(sampler.ellipse <= 0 && sampler.probes >= 1 && sampler.probes <= kMostProbes);
    const LegalPatches patches(texture, sampler, precision, suspicion.address);
    ColourSearch search(colour, precision.colour_threshold);
    HullSearch hulls{.wanted = colour, .threshold = precision.colour_threshold, .least = search.least(), .most = search.most()};
    bool open = false;
    LegalVerdict verdict;
    verdict.fewest_probes = kMostProbes;
    verdict.least_lod = std::numeric_limits<double>::infinity(), verdict.most_lod = -verdict.least_lod;
    for (const LegalPlace& place : legal_places(texture.shape, lookup, precision)) {
        for (const LegalLine& line : legal_lines(texture.shape, sampler, place, precision, suspicion.footprint)) {
            verdict.least_lod = std::min(verdict.least_lod, line.lod.low), verdict.most_lod = std::max(verdict.most_lod, line.lod.high);
            verdict.fewest_probes = std::min(verdict.fewest_probes, line.probes);
            verdict.most_probes = std::max(verdict.most_probes, line.probes);
            const Reading reading{texture, sampler, patches, place, line};
            // The first of a line lies as far off as the last.
            const double outermost = line.probes == 1 ? 0 : double(probe_table(line).place[size_t(kMostProbes * line.probes)]);
            open = open || is_open(reading, probe_place(reading, outermost));
            if (open) break;
            const auto filter = [&](const Kernel& kernel, Range lod) {
                if (line.probes == 1) return search_one(reading, kernel, lod, search, hulls);
                search_probes(reading, kernel, lod, hulls);
            };
            if (*line.magnified == *line.minified) {
                filter(*line.magnified, line.lod);
                continue;
            }
            if (line.lod.low <= 0) filter(*line.magnified, {line.lod.low, std::min(line.lod.high, 0.0)});
            if (line.lod.high > 0) filter(*line.minified, {std::max(line.lod.low, 0.0), line.lod.high});
        }
    }
    if (open) {
        verdict.legal = true;
        verdict.closest = colour;
        verdict.least.fill(-std::numeric_limits<double>::infinity()), verdict.most.fill(std::numeric_limits<double>::infinity());
        return verdict;
    }
    const bool by_hull = hulls.excess < search.excess();
    verdict.excess = by_hull ? hulls.excess : search.excess();
    verdict.closest = by_hull ? hulls.closest : search.closest();
    verdict.legal = verdict.excess <= 1;
    for (size_t c = 0; c < 4; ++c) {
        verdict.least[c] = std::min(search.least()[c], hulls.least[c]);
        verdict.most[c] = std::max(search.most()[c], hulls.most[c]);
    }
    return verdict;
}

LegalVerdict judge_lookup(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const Colour& colour,
                          const LegalPrecision& precision) {
    return judge_suspected(texture, sampler, lookup, colour, precision, {});
}

std::string to_string(const LegalVerdict& verdict, const Colour& colour) {
    std::ostringstream text;
    text.precision(7);
    const auto put = [&](const Colour& c) -> std::ostream& { return text << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3]; };
    text << (verdict.legal ? "legal: " : "not legal: ");
    put(colour) << "; legal are ";
    put(verdict.least) << " to ";
    put(verdict.most) << ", closest ";
    put(verdict.closest) << " (" << verdict.excess << " thresholds off), level of detail " << verdict.least_lod << " to "
                         << verdict.most_lod;
    if (verdict.most_probes > 1) text << ", probes " << verdict.fewest_probes << " to " << verdict.most_probes;
    return text.str();
}

}  // namespace rawtexel::texunit
