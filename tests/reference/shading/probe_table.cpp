#include "tests/reference/shading/probe_table.h"

#include "shading/brdf.h"
#include "shading/environment_tables.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace rawtexel::reference {
namespace {

using Table = shading::ReflectionProbeTable;
constexpr int kProbes = Table::kProbes;

/// A neighbour's probes in their place in the lobe of another roughness: widths go with roughness, angles with its square.
FittedProbes rescaled(FittedProbes probes, double ratio) {
    for (FittedProbe& probe : probes) {
        probe.roughness = std::clamp(probe.roughness * ratio, double(shading::kMinRoughness), double(shading::kFlatRoughness));
        probe.lean *= std::min(ratio * ratio, 1.2);
    }
    return probes;
}

FittedProbes mean(const std::vector<FittedProbes>& many) {
    FittedProbes sum{};
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        double log_roughness = 0.0;
        for (const FittedProbes& probes : many) {
            const double share = 1.0 / double(many.size());
            sum[k].lean += share * probes[k].lean;
            log_roughness += share * std::log(probes[k].roughness);
            sum[k].scale_share += share * probes[k].scale_share;
            sum[k].bias_share += share * probes[k].bias_share;
        }
        sum[k].roughness = std::exp(log_roughness);
    }
    return sum;
}

/// Puts probes without a share to work: beside the one with the greatest.
void employ_all(FittedProbes& probes) {
    const auto share = [](const FittedProbe& probe) { return probe.scale_share + probe.bias_share; };
    for (FittedProbe& idle : probes) {
        if (share(idle) > 0.02) continue;
        const auto less = [&](const FittedProbe& a, const FittedProbe& b) { return share(a) < share(b); };
        FittedProbe& busiest = *std::max_element(probes.begin(), probes.end(), less);
        busiest.scale_share *= 0.5;
        busiest.bias_share *= 0.5;
        idle = busiest;
        const double apart = 0.3 * busiest.roughness * busiest.roughness;
        idle.lean -= apart;
        busiest.lean += apart;
    }
}

/// The table while it is being filled.
class NodeGrid {
  public:
    std::vector<FittedProbes> probes() const {
        std::vector<FittedProbes> all;
        for (const Node& node : nodes_) all.push_back(node.probes);
        return all;
    }
    const FittedProbes& at(int view, int roughness) const { return node(view, roughness).probes; }

    /// What the fitted neighbours suggest; the node itself where there are none.
    FittedProbes expected(int view, int roughness) const {
        std::vector<FittedProbes> neighbours;
        for (const glm::ivec2& step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
            const int v = view + step.x, r = roughness + step.y;
            if (v < 0 || v >= Table::kViews || r < 0 || r >= Table::kRoughnesses) continue;
            if (node(v, r).fitted) neighbours.push_back(rescaled(at(v, r), node_roughness(roughness) / node_roughness(r)));
        }
        return neighbours.empty() ? at(view, roughness) : mean(neighbours);
    }

    void fit(int view, int roughness, const FittedProbes& start, const FittedProbes& expected) {
        FittedProbes probes = start;
        // Leans have no meaning at the last view but between it and the one before.
        if (view == Table::kViews - 1)
            for (size_t k = 0; k < size_t(kProbes); ++k) probes[k].lean = at(view - 1, roughness)[k].lean;
        ProbeFit(node_view(view), node_roughness(roughness)).improve(probes, expected, kSteps);
        nodes_[index(view, roughness)] = {probes, true};
    }

  private:
    static constexpr int kSteps = 600;
    struct Node {
        FittedProbes probes;
        bool fitted = false;
    };
    static size_t index(int view, int roughness) { return size_t(view + Table::kViews * roughness); }
    const Node& node(int view, int roughness) const { return nodes_[index(view, roughness)]; }

    std::array<Node, size_t(Table::kViews* Table::kRoughnesses)> nodes_;
};

/// The words that hold a node's probes; shares are rounded so that they sum to one.
std::array<uint32_t, Table::kNodeWords> packed_probes(const FittedProbes& probes) {
    constexpr double kOne = 65535.0;
    const auto fraction = [](double value, double least, double range) {
        return uint32_t(std::lround(std::clamp((value - least) / range, 0.0, 1.0) * kOne));
    };
    std::array<uint32_t, size_t(kProbes)> scale{}, bias{};
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        scale[k] = fraction(probes[k].scale_share, 0.0, 1.0);
        bias[k] = fraction(probes[k].bias_share, 0.0, 1.0);
    }
    // The largest share takes what rounding left over.
    for (auto* shares : {&scale, &bias}) {
        uint32_t sum = 0;
        for (const uint32_t share : *shares) sum += share;
        *std::max_element(shares->begin(), shares->end()) += uint32_t(kOne) - sum;
    }
    std::array<uint32_t, Table::kNodeWords> words;
    for (size_t k = 0; k < size_t(kProbes); ++k) {
        const double least = Table::kLeastLean, range = Table::kLeanRange, widest = Table::kRoughnessRange;
        words[2 * k] = fraction(probes[k].lean, least, range) << 16 | fraction(probes[k].roughness, 0.0, widest);
        words[2 * k + 1] = scale[k] << 16 | bias[k];
    }
    return words;
}

}  // namespace

double node_view(int view) {
    const double root = std::sin(0.5 * std::numbers::pi * double(view) / (Table::kViews - 1));
    return std::clamp(root * root, 0.002, 0.99999);
}

double node_roughness(int roughness) { return std::max(double(roughness) / (Table::kRoughnesses - 1), double(shading::kMinRoughness)); }

std::vector<FittedProbes> fit_all_probes() {
    // Begin at an angle that keeps every probe busy.
    constexpr int kFirstView = 5, kFirstRoughness = 8;
    FittedProbes first{};
    for (size_t k = 0; k < size_t(kProbes); ++k) first[k] = {0.6 - 0.8 * double(k) / (kProbes - 1), 0.25, 1.0 / kProbes, 1.0 / kProbes};
    NodeGrid grid;
    for (int again = 0; again < 8; ++again) {
        employ_all(first);
        grid.fit(kFirstView, kFirstRoughness, first, first);
        first = grid.at(kFirstView, kFirstRoughness);
    }

    // Row by row away from there, within a row too.
    const auto fit_row = [&](int r) {
        for (const int step : {1, -1})
            for (int v = step > 0 ? kFirstView : kFirstView - 1; v >= 0 && v < Table::kViews; v += step)
                grid.fit(v, r, grid.expected(v, r), grid.expected(v, r));
    };
    for (int r = kFirstRoughness; r < Table::kRoughnesses; ++r) fit_row(r);
    for (int r = kFirstRoughness - 1; r >= 0; --r) fit_row(r);

    // Again, now that every node has all its neighbours.
    for (int r = 0; r < Table::kRoughnesses; ++r)
        for (int v = 0; v < Table::kViews; ++v) grid.fit(v, r, grid.at(v, r), grid.expected(v, r));
    return grid.probes();
}

std::string probe_table_source(const std::vector<FittedProbes>& nodes) {
    std::ostringstream text;
    text << "// Written by tests/reference/shading/probe_fit.cpp: do not edit.\n"
            "#include \"shading/reflection_probes.h\"\n\n"
            "namespace rawtexel::shading {\n\n"
            "// clang-format off\n"
            "const ReflectionProbeTable kReflectionProbes{{\n";
    for (const FittedProbes& probes : nodes) {
        text << "   ";
        for (const uint32_t word : packed_probes(probes)) text << " 0x" << std::hex << std::setw(8) << std::setfill('0') << word << ",";
        text << "\n";
    }
    text << "}};\n// clang-format on\n\n}  // namespace rawtexel::shading\n";
    return text.str();
}

}  // namespace rawtexel::reference
