// SPDX-License-Identifier: MIT
//
// Unit square onto directions about an axis with the von Mises-Fisher distribution on the sphere,
// with concentration kappa:
//
//     density kappa exp(kappa cos theta) / (4 pi sinh kappa);    kappa = 0: uniform
//
// xi0 is the probability of the cone about the axis within theta. The longitude is 2 pi xi1, and
//
//     1 - cos theta = -log1p(xi0 expm1(-2 kappa)) / kappa        where theta <= 90 degrees,
//     1 + cos theta =  log1p((1 - xi0) expm1(2 kappa)) / kappa   beyond,
//
// so that no digits are lost at either pole, and no kappa overflows.
//
// Shape   2 unit coordinates; 3 coordinates, a unit vector.
// Strata  xi0 is used directly, not as 1 - xi: 0 is the axis, small xi0 are near it. xi1 turns
//         about the axis; for +z from x towards y. Strata become sectors of rings. If kappa is
//         large, xi0 = 1 is replaced by 1 - 2^-55.
// Cost    O(1) a point; on one core about 8 ns forward, 40 ns inverse.
// Promise unit vectors up to 8 epsilon. A round trip returns the same vector within 1e-14. For the
//         default axis it also returns the same xi within 1e-13, except at the poles. About another
//         axis, rounding of the vector changes xi0 by up to 1e-15 (1 + sqrt(kappa)), and xi1 by
//         1e-15 / sin theta. The same bits on every machine.
// Source  R. Fisher, "Dispersion on a sphere", Proc. R. Soc. A 217 (1953) 295-305,
//         doi:10.1098/rspa.1953.0064.

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "warps/curved/lobe.hpp"
#include "warps/curved/placement.hpp"

namespace stipple::warps::von_mises_fisher {
namespace {

constexpr Param<double> concentration{
    .name = "kappa",
    .fallback = 10,
    .low = 0,
    .high = 1e8,
    .help =
        "Concentration: 0 is uniform; large values approach a normal distribution about the axis, "
        "of standard deviation 1 / sqrt(kappa) radians along each tangent"};

class Fisher {
  public:
    static constexpr bool hemisphere = false;

    explicit Fisher(double kappa) : kappa_(std::max(kappa, 1e-17)) {
        constexpr double most = 55 * 0.6931471805599453;  // -log 2^-55
        // For kappa < 1e-17 the density is uniform to the last bit. For kappa > 20 no xi below 1
        // comes near the far pole, so that 2 - (1 - cos) keeps the digits of 1 + cos.
        const bool both = kappa_ <= 20;
        near_factor_ = exp_minus_1(-2 * kappa_);
        if (both) far_factor_ = exp_minus_1(2 * kappa_);
        turn_ = both ? exp_minus_1(-kappa_) / near_factor_ : 2.0;
        last_ = both ? 0 : std::min(2.0, most / kappa_);
    }

    CosSin forward(double u) const {
        const bool near = u < turn_;
        const double inside = near ? u * near_factor_ : (1 - u) * far_factor_;
        const double size = std::abs(log_1p(u < 1 ? inside : 0)) / kappa_;
        const double small = u < 1 ? size : last_;
        return {near ? 1 - small : small - 1, std::sqrt(small * (2 - small))};
    }
    double fraction(const Vector3& w) const {
        const double v = one_minus_cos(w);
        const double c = one_plus_cos(w);
        if (v < c || far_factor_ == 0) return exp_minus_1(-kappa_ * v) / near_factor_;
        return 1 - exp_minus_1(kappa_ * c) / far_factor_;
    }
    double density(const Vector3& w) const {
        constexpr double around = 2 * std::numbers::pi;
        return kappa_ * stipple::exponential(-kappa_ * one_minus_cos(w)) / (around * -near_factor_);
    }

    /// The cumulants along the axis are the derivatives of log(sinh kappa / kappa).
    AxialMoments moments() const {
        if (kappa_ < 1) return series_moments();
        const double k = kappa_;
        const double coth = (2 + near_factor_) / -near_factor_;
        const double csch = 2 * stipple::exponential(-k) / -near_factor_;
        const double mean = coth - 1 / k;
        const double variance = 1 / (k * k) - csch * csch;
        return {.along = {mean, variance, 2 * (coth * csch * csch - 1 / (k * k * k))},
                .across = mean / k,
                .across_along = (variance - mean / k) / k};
    }

  private:
    /// E z^n = (sum of kappa^j / j! m(n + j)) / (sum of kappa^j / j! m(j)), where m are the moments
    /// of the uniform distribution.
    AxialMoments series_moments() const {
        std::array<double, 4> sums{};
        double term = 1;
        for (int j = 0; j < 24; ++j) {
            for (int n = 0; n < 4; ++n)
                if ((n + j) % 2 == 0) sums[static_cast<std::size_t>(n)] += term / (n + j + 1);
            term *= kappa_ / (j + 1);
        }
        return direction_moments(sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]);
    }

    double kappa_;
    double near_factor_ = -1;  ///< expm1(-2 kappa)
    double far_factor_ = 0;    ///< expm1(2 kappa); 0 if kappa > 20
    double turn_ = 0.5;  ///< xi0 at 90 degrees; 2 if the formula for larger angles is not used
    double last_ = 2;    ///< at xi0 = 1: 1 - cos theta if kappa > 20, else 1 + cos theta
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    return lobe_mapping(Fisher(want.options[concentration]), frame_of(want.options), want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "von-mises-fisher",
            .summary = "Directions about an axis with the distribution of von Mises and Fisher",
            .source = "Fisher 1953, doi:10.1098/rspa.1953.0064",
            .related = {"fisher"},
            .strata =
                "xi1 is the probability of the cone about the axis, 0 on the axis; xi2 turns about "
                "the axis; both are used directly",
            .options = Schema(concentration, axis_option),
            .aliases = {"vmf"},
            .mapping = make};
}

}  // namespace stipple::warps::von_mises_fisher
