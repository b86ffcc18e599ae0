// SPDX-License-Identifier: MIT
//
// Integrands given by a single formula each, with their integrals.
//
//     smooth-gaussian  exp(-|x - 1/2|^2 / (2 width^2)), centred at (1/2, ..., 1/2)
//     zone-plate       (1 + cos(k (x^2 + y^2))) / 2
//     owen             sum over all sets u of `order` axes of prod_{j in u} sqrt(12) (x_j - 1/2),
//                      divided by the root of the number of sets: integral 0, and variance 1, all
//                      from interactions of exactly `order` coordinates
//     sobol-g          prod (|4 x_j - 2| + a_j) / (1 + a_j), integral 1; a_j = j - 1 by default;
//                      a single given a applies to all axes
//     sky-radiance     cos theta (1 + 2 cos theta) / 3: the light on a level plane from an
//                      overcast sky of zenith radiance 1; integral over the hemisphere 7 pi / 9
//     measure          1: its integral is the domain's length, area, volume or solid angle
//
// Promise integrals within 1e-15 relative or a few rounding errors. For the zone plate it is (1 +
//         Re (int_0^1 e^(i k x^2) dx)^2) / 2, by the 31-point Gauss-Kronrod rule on pieces whose
//         phase changes by at most 4 radians: within 1e-15.
// Source  A. B. Owen, "The dimension distribution and quadrature test functions", Statistica Sinica
//         13 (2003) 1-17 (functions whose interactions have a chosen order). A. Saltelli,
//         I. M. Sobol', Reliability Engineering and System Safety 50 (1995) 225-239 (g-function).
//         P. Moon, D. E. Spencer, Illuminating Engineering 37 (1942) 707-726 (overcast sky).

#include "math/integrands/integrands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/radians.hpp"

namespace stipple {
namespace {

constexpr Param<double> width{.name = "width",
                              .fallback = 0.25,
                              .low = 1e-3,
                              .high = 1e3,
                              .help = "Standard deviation of the peak"};

Integrand smooth_gaussian(std::size_t dimension, const Values& values) {
    const double factor = -0.5 / (values[width] * values[width]);
    const double reach = 0.5 / (std::numbers::sqrt2 * values[width]);
    const double axis = error_function(reach) / (std::numbers::inv_sqrtpi * 2 * reach);
    const double exact = whole_power(axis, dimension);
    require_normal(exact, "smooth-gaussian", dimension);
    return {[factor](auto point) {
                double sum = 0;
                for (const double x : point) sum += (x - 0.5) * (x - 0.5);
                return exponential(factor * sum);
            },
            exact};
}

constexpr Param<double> phase{.name = "phase",
                              .fallback = 100,
                              .low = 0,
                              .high = 1e5,
                              .unit = "radians",
                              .help = "Phase k at distance 1; rings get finer outwards"};

/// Returns int_0^1 e^(i k x^2) dx.
std::complex<double> fresnel(double k) {
    const auto pieces = static_cast<int>(std::ceil(k / 2)) + 1;
    std::complex<double> sum = 0;
    for (int j = 0; j < pieces; ++j) {
        const auto piece = [&](const std::function<double(double)>& f) {
            return gauss_kronrod(f, static_cast<double>(j) / pieces,
                                 static_cast<double>(j + 1) / pieces)
                .value;
        };
        sum +=
            std::complex<double>(piece([k](double x) { return cos_sin_radians(k * x * x).cos; }),
                                 piece([k](double x) { return cos_sin_radians(k * x * x).sin; }));
    }
    return sum;
}

Integrand zone_plate(std::size_t, const Values& values) {
    const double k = values[phase];
    const std::complex<double> one = fresnel(k);
    return {[k](auto x) { return (1 + cos_sin_radians(k * (x[0] * x[0] + x[1] * x[1])).cos) / 2; },
            (1 + (one * one).real()) / 2};
}

constexpr Param<std::int64_t> order{
    .name = "order",
    .fallback = 2,
    .low = 1,
    .high = 10,
    .help = "Number of coordinates that interact, at most the dimension"};

Integrand owen(std::size_t dimension, const Values& values) {
    const auto k = static_cast<std::size_t>(std::min<std::int64_t>(
        values[order], static_cast<std::int64_t>(std::min<std::size_t>(dimension, 10))));
    double sets = 1;
    for (std::size_t j = 0; j < k; ++j)
        sets *= static_cast<double>(dimension - j) / static_cast<double>(j + 1);
    return {[k, scale = real_power(12, static_cast<double>(k) / 2) / std::sqrt(sets)](auto x) {
                std::array<double, 11> symmetric{1};  // elementary symmetric polynomials
                for (const double t : x)
                    for (std::size_t j = k; j > 0; --j)
                        symmetric[j] += (t - 0.5) * symmetric[j - 1];
                return scale * symmetric[k];
            },
            0};
}

constexpr Param<Numbers> numbers{
    {.name = "a",
     .help = "Coefficient a of each coordinate, 0 or more, or one for all; the larger a, the less "
             "important the coordinate; default: 0,1,2,..."}};

Integrand sobol_g(std::size_t dimension, const Values& values) {
    std::vector<double> given = values[numbers];
    for (const double x : given)
        if (!(x >= 0)) fail(ErrorKind::usage, "--integrand: sobol-g: --a: {} is below 0", x);
    if (given.size() > 1 && given.size() != dimension)
        fail(ErrorKind::usage,
             "--integrand: sobol-g: --a: {} numbers for {} coordinate{}; give one for all, or one "
             "for each",
             given.size(), dimension, dimension == 1 ? "" : "s");
    const bool rising = given.empty();
    for (std::size_t j = given.size(); j < dimension; ++j)
        given.push_back(rising ? static_cast<double>(j) : given.back());
    return {[given = std::move(given)](auto x) {
                double product = 1;
                for (std::size_t j = 0; j < x.size(); ++j)
                    product *= (std::abs(4 * x[j] - 2) + given[j]) / (1 + given[j]);
                return product;
            },
            1};
}

Integrand sky(std::size_t, const Values&) {
    return {[](auto w) { return w[2] * (1 + 2 * w[2]) / 3; }, 7 * std::numbers::pi / 9};
}

Integrand measure(std::size_t, const Values&) {
    return {[](auto) { return 1.0; }, 1};
}

}  // namespace

std::vector<IntegrandKind> smooth_integrands() {
    return {{.name = "smooth-gaussian",
             .summary = "a Gaussian peak in the middle",
             .max_dimension = 500,
             .options = Schema(width),
             .make = smooth_gaussian},
            {.name = "zone-plate",
             .summary = "rings that get finer outwards",
             .min_dimension = 2,
             .max_dimension = 2,
             .options = Schema(phase),
             .make = zone_plate},
            {.name = "owen",
             .summary = "only interactions of a given number of coordinates",
             .options = Schema(order),
             .make = owen},
            {.name = "sobol-g",
             .summary = "a product with a kink in each coordinate",
             .options = Schema(numbers),
             .make = sobol_g},
            {.name = "sky-radiance",
             .summary = "light from an overcast sky on a horizontal plane",
             .region = Region::hemisphere,
             .min_dimension = 3,
             .max_dimension = 3,
             .options = Schema(),
             .make = sky},
            {.name = "measure",
             .summary = "1: length, area or volume of the domain",
             .region = Region::anywhere,
             .options = Schema(),
             .make = measure}};
}

}  // namespace stipple
