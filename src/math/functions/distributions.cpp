// SPDX-License-Identifier: MIT
#include "math/functions/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>

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

double student_above(double t, double freedom) {
    const double square = t * t / freedom;
    return square < 1 ? 0.5 * beta_above(0.5, 0.5 * freedom, square / (1 + square))
                      : 0.5 * beta_below(0.5 * freedom, 0.5, 1 / (1 + square));
}

double student_quantile(double above, double freedom) {
    // P(T > t) = I_x(freedom / 2, 1 / 2) / 2 with x = freedom / (freedom + t^2), for t >= 0.
    const auto [x, rest] = beta_quantile(freedom / 2, 0.5, 2 * std::min(above, 1 - above));
    return std::copysign(std::sqrt(freedom * (rest / x)), 0.5 - above);
}

}  // namespace stipple
