// SPDX-License-Identifier: MIT
#include "math/functions/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <numbers>

#include "math/functions/incomplete_functions.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/portable_double.hpp"

namespace stipple {

double chi_square_below(double statistic, double freedom) {
    return gamma_below(freedom / 2, statistic / 2);
}

double chi_square_above(double statistic, double freedom) {
    return gamma_above(freedom / 2, statistic / 2);
}

double detectable_noncentrality(double freedom, double level) {
    using Number = PortableDouble;
    const double critical = 2 * gamma_upper_quantile(freedom / 2, level / 2);
    return boost::math::non_central_chi_squared_distribution<
               Number, detail::NoErrors>::find_non_centrality(freedom, critical, Number(0.1))
        .value;
}

double log_excess(double n) {
    if (n < 1e-300) return 0;
    double rise = 0;  // that of n + 1 is more by 1 - n ln(1 + 1 / n)
    for (; n < 30; ++n) rise += 1 - n * log_1p(1 / n);
    // Stirling's series; the next term is below 1e-15.
    const double s = 1 / (n * n);
    const double series = 1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680)));
    return 0.5 * logarithm(2 * std::numbers::pi * n) + series / n - rise;
}

double log_factorial(double n) { return n > 0 ? n * logarithm(n) - n + log_excess(n) : 0; }

double student_quantile(double above, double freedom) {
    // P(T > t) = I_x(freedom / 2, 1 / 2) / 2 with x = freedom / (freedom + t^2), for t >= 0.
    const auto [x, rest] = beta_quantile(freedom / 2, 0.5, 2 * std::min(above, 1 - above));
    return std::copysign(std::sqrt(freedom * (rest / x)), 0.5 - above);
}

}  // namespace stipple
