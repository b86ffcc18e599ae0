// SPDX-License-Identifier: MIT
#include "math/functions/incomplete_functions.hpp"

#include "math/functions/portable_double.hpp"

// After the functions that its templates are to find.
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace stipple {
namespace {

using Number = PortableDouble;
constexpr detail::NoErrors no_errors;

}  // namespace

double log_gamma(double x) { return boost::math::lgamma(Number(x), no_errors).value; }

double gamma_ratio(double x, double delta) {
    return 1 / boost::math::tgamma_delta_ratio(Number(x), Number(delta), no_errors).value;
}

double gamma_below(double a, double x) {
    return boost::math::gamma_p(Number(a), Number(x), no_errors).value;
}
double gamma_above(double a, double x) {
    return boost::math::gamma_q(Number(a), Number(x), no_errors).value;
}
double gamma_density(double a, double x) {
    return boost::math::gamma_p_derivative(Number(a), Number(x), no_errors).value;
}
double gamma_quantile(double a, double p) {
    return boost::math::gamma_p_inv(Number(a), Number(p), no_errors).value;
}
double gamma_upper_quantile(double a, double q) {
    return boost::math::gamma_q_inv(Number(a), Number(q), no_errors).value;
}

double beta_below(double a, double b, double x) {
    return boost::math::ibeta(Number(a), Number(b), Number(x), no_errors).value;
}
double beta_above(double a, double b, double x) {
    return boost::math::ibetac(Number(a), Number(b), Number(x), no_errors).value;
}
double beta_density(double a, double b, double x) {
    return boost::math::ibeta_derivative(Number(a), Number(b), Number(x), no_errors).value;
}
Shares beta_quantile(double a, double b, double p) {
    Number rest;
    const Number x = boost::math::ibeta_inv(Number(a), Number(b), Number(p), &rest, no_errors);
    return {x.value, rest.value};
}

}  // namespace stipple
