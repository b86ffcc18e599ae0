// SPDX-License-Identifier: MIT
#include "math/polytopes/simplex_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine/wide.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple {
namespace {

STIPPLE_WIDE void square_roots(double* x, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) x[i] = std::sqrt(x[i]);
}

STIPPLE_WIDE [[gnu::flatten]] void roots(double* x, double m, std::size_t rows) {
    const double share = 1 / m;
    for (std::size_t i = 0; i < rows; ++i)
        x[i] = exponential(share * logarithm(std::max(x[i], 1e-300)));
}

}  // namespace

void break_off(double* xi, double* rest, std::size_t m, std::size_t rows) {
    if (m == 2) square_roots(xi, rows);
    if (m > 2) roots(xi, static_cast<double>(m), rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const double left = rest[i] * xi[i];
        xi[i] = rest[i] - left;
        rest[i] = left;
    }
}

double unit_of_share(double share, std::size_t m) {
    double power = 1;
    for (; m > 0; m /= 2, share *= share)
        if (m % 2 == 1) power *= share;
    return power;
}

}  // namespace stipple
