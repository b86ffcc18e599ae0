// SPDX-License-Identifier: MIT
//
// Finds the correlation of normal scores for which two parameters have a given correlation. With X
// = F^-1(Phi(Z)), Y = G^-1(Phi(W)), and Z, W standard normal with correlation sin t (Plackett),
//
//     Cov(X, Y) = integral over [0, t] of S,
//     S(t) = 1 / (2 pi) sum of dX(z) dY(w) exp(-(z^2 - 2 z w sin t + w^2) / (2 cos^2 t)),
//
// where the sum is over the increments of X and Y. These are the steps of a discrete distribution;
// for others they are at the nodes of Gauss's rule on panels, halved until the rule yields X's
// change over each panel. Increments within a fraction of cos t are replaced by four with the
// same moments. At the ends, t = +-pi / 2, the covariance is an integral over z alone.
//
// Cost    some thousand quantiles per parameter, and 1 to 30 ms per pair.
// Promise correlations within 1e-9 for steps, 1e-6 for other distributions that are smooth where
//         continuous, 1e-5 for all others. The same bits on every machine.
// Source  R. L. Plackett, Biometrika 41 (1954) 351-360, doi:10.1093/biomet/41.3-4.351; M. C. Cario,
//         B. L. Nelson, "Modeling and generating random vectors with arbitrary marginal
//         distributions and correlation matrix", Northwestern University, 1997 (NORTA); W. Whitt,
//         Ann. Statist. 4 (1976) 1280-1289, doi:10.1214/aos/1176343660 (the ends).
#pragma once

#include <vector>

#include "math/distributions/marginal.hpp"

namespace stipple::parameters {

/// A parameter's values, or their mean ranks, as a function of the normal score.
class Scored {
  public:
    /// Correlated quantity: the values x, or their mean ranks (F(x) + F(x-)) / 2.
    enum class Of { numbers, ranks };

    /// @throws Error(usage) if the variance is 0, infinite, or mostly beyond tails of 1e-300
    Scored(MarginalPtr law, Of of);

    /// Correlation of the scores for which this parameter and the other one have the correlation r.
    /// @throws Error(usage) naming the possible range if r is outside
    [[nodiscard]] double scores_for(const Scored& other, double r) const;
    /// Correlation of both parameters if that of their scores is `sign`, 1 or -1.
    [[nodiscard]] double extreme(const Scored& other, double sign) const;

    struct Increment {
        double at;  ///< normal score
        double size;
    };

  private:
    void take_steps();
    void take_cells();
    void take_panels();
    void add_panel(double low, double high, double x_low, double x_high);
    /// number(z) is the value or mean rank at the score z; at(z) is the same minus the mean.
    [[nodiscard]] double at(double z) const;
    [[nodiscard]] double number(double z) const;
    /// Increments, at most four in each interval of length `width`, with the same moments.
    [[nodiscard]] std::vector<Increment> gathered(double width) const;

    MarginalPtr law_;
    bool ranks_;
    bool stepped_ = false;  ///< whether the increments are exactly the distribution's steps
    std::vector<Increment> increments_;  ///< ascending by score
    std::vector<double> levels_;         ///< values or ranks between consecutive steps
    std::vector<double> cuts_;           ///< limits of intervals on which number() is smooth
    double mean_ = 0;
    double deviation_ = 1;
};

}  // namespace stipple::parameters
