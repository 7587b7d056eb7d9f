// Minimising a function of several variables without its derivatives.
#pragma once

#include <functional>
#include <vector>

namespace rawtexel::reference {

/// Nelder and Mead's descent, coefficients by dimension (Gao and Han 2012): `steps` moves from a simplex of x and x + step[i]. Variables
/// whose step is 0 stay as they are. Leaves the best point in `x`.
void simplex_descent(const std::function<double(const std::vector<double>&)>& f, std::vector<double>& x, const std::vector<double>& step,
                     int steps);

}  // namespace rawtexel::reference
