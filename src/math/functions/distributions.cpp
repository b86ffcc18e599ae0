// SPDX-License-Identifier: MIT
#include "math/functions/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

namespace stipple {
namespace {

using Quiet = boost::math::policies::policy<
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
    boost::math::policies::underflow_error<boost::math::policies::ignore_error>>;

}  // namespace

double chi_square_below(double statistic, double freedom) {
    return boost::math::gamma_p(freedom / 2, statistic / 2, Quiet());
}

double chi_square_above(double statistic, double freedom) {
    return boost::math::gamma_q(freedom / 2, statistic / 2, Quiet());
}

double detectable_noncentrality(double freedom, double level) {
    using namespace boost::math;
    const chi_squared_distribution<double, Quiet> null(freedom);
    const double critical = quantile(complement(null, level / 2));
    return non_central_chi_squared_distribution<double, Quiet>::find_non_centrality(freedom,
                                                                                    critical, 0.1);
}

double log_excess(double n) {
    if (n == 0) return 0;
    if (n < 30) return std::lgamma(n + 1) - n * std::log(n) + n;
    // Stirling's series; the next term is below 1e-15.
    const double s = 1 / (n * n);
    const double series = 1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680)));
    return 0.5 * std::log(2 * std::numbers::pi * n) + series / n;
}

double student_quantile(double above, double freedom) {
    const boost::math::students_t student(freedom);
    return boost::math::quantile(boost::math::complement(student, above));
}

}  // namespace stipple
