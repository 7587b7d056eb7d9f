#include "texunit/probe_table.h"

#include <cmath>
#include <cstddef>

namespace rawtexel::texunit {
namespace {

constexpr double kReach = 2;  ///< standard deviations of the normal density that the probes cover on either side

struct Probe {
    double place, weight;
};

template <class MakeProbe>
ProbeTable make_table(MakeProbe make_probe) {
    ProbeTable table{};
    for (int n = 1; n <= kMostProbes; ++n) {
        double total = 0, sum = 0;
        for (int i = 0; i < n; ++i) total += make_probe(i, n).weight;
        for (int i = 0; i < n; ++i) {
            const Probe probe = make_probe(i, n);
            sum += probe.weight;
            const auto at = size_t(kMostProbes * n + i);
            table.place[at] = float(probe.place);
            table.share[at] = float(probe.weight / sum);
            table.weight[at] = float(probe.weight / total);
        }
        table.gap[size_t(n)] = n > 1 ? float(make_probe(1, n).place - make_probe(0, n).place) : 0.0f;
    }
    return table;
}

Probe uniform_probe(int i, int n) { return {(i + 0.5) / n - 0.5, 1}; }

Probe normal_probe(int i, int n) {
    const double place = kReach * ((2.0 * i + 1) / n - 1);
    return {place, std::exp(-0.5 * place * place)};
}

/// Standard deviation of n weighted places; 1 for a single one.
double spread(int n) {
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
        const Probe probe = normal_probe(i, n);
        sum += probe.weight;
        squares += probe.weight * probe.place * probe.place;
    }
    return n > 1 ? std::sqrt(squares / sum) : 1;
}

}  // namespace

const ProbeTable& uniform_probes() {
    static const ProbeTable table = make_table(uniform_probe);
    return table;
}

const ProbeTable& gaussian_probes() {
    static const ProbeTable table = make_table([](int i, int n) {
        const Probe probe = normal_probe(i, n);
        return Probe{probe.place / spread(n), probe.weight};
    });
    return table;
}

}  // namespace rawtexel::texunit
