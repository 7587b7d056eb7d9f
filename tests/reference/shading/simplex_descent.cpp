#include "tests/reference/shading/simplex_descent.h"

#include <algorithm>

namespace rawtexel::reference {

void simplex_descent(const std::function<double(const std::vector<double>&)>& f, std::vector<double>& x, const std::vector<double>& step,
                     int steps) {
    const size_t n = x.size();
    struct Corner {
        std::vector<double> x;
        double value;
    };
    std::vector<Corner> corners{{x, f(x)}};
    for (size_t i = 0; i < n; ++i) {
        std::vector<double> moved = x;
        moved[i] += step[i];
        corners.push_back({moved, f(moved)});
    }
    const double expand = 1.0 + 2.0 / double(n), contract = 0.75 - 0.5 / double(n), shrink = 1.0 - 1.0 / double(n);
    const auto by_value = [](const Corner& a, const Corner& b) { return a.value < b.value; };
    for (int k = 0; k < steps; ++k) {
        std::stable_sort(corners.begin(), corners.end(), by_value);
        std::vector<double> center(n, 0.0);
        for (size_t i = 0; i < n; ++i)
            for (size_t c = 0; c < n; ++c) center[c] += corners[i].x[c] / double(n);
        Corner& worst = corners[n];
        const auto at = [&](double t) {
            std::vector<double> moved(n);
            for (size_t c = 0; c < n; ++c) moved[c] = center[c] + t * (center[c] - worst.x[c]);
            const double value = f(moved);
            return Corner{std::move(moved), value};
        };
        Corner next = at(1.0);
        if (next.value < corners[0].value) {
            Corner further = at(expand);
            worst = further.value < next.value ? further : next;
        } else if (next.value < corners[n - 1].value) {
            worst = next;
        } else {
            next = at(next.value < worst.value ? contract : -contract);
            if (next.value < worst.value) {
                worst = next;
                continue;
            }
            for (size_t i = 1; i <= n; ++i) {
                for (size_t c = 0; c < n; ++c) corners[i].x[c] = corners[0].x[c] + shrink * (corners[i].x[c] - corners[0].x[c]);
                corners[i].value = f(corners[i].x);
            }
        }
    }
    x = std::min_element(corners.begin(), corners.end(), by_value)->x;
}

}  // namespace rawtexel::reference
