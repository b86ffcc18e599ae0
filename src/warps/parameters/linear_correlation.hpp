// SPDX-License-Identifier: MIT
//
// Which correlation of normal scores gives two parameters the correlation that is asked for. With
// X = F^-1(Phi(Z)), Y = G^-1(Phi(W)), and Z, W standard normal with correlation sin t (Plackett 1954),
//
//     Cov(X, Y) = integral over [0, t] of S,
//     S(t) = 1 / (2 pi) sum of dX(z) dY(w) exp(-(z^2 - 2 z w sin t + w^2) / (2 cos^2 t)),
//
// over the increments of both: the steps of what is discrete; of what is continuous, nodes of Gauss's
// rule, panels being halved until they give the increment of X. Many increments within a part of
// cos t are four that have the same moments (Gauss's rule for them). At the ends, t = +-pi / 2, the
// covariance is an integral over z alone.
//
// Cost    some thousand quantiles of each parameter, and 1 to 30 ms a pair.
// Promise correlations within 1e-9 for steps, 1e-6 for other distributions that are smooth where
//         they are continuous, 1e-5 for any. The same bits on every machine.
// Source  R. L. Plackett, Biometrika 41 (1954) 351-360, doi:10.1093/biomet/41.3-4.351; M. C. Cario,
//         B. L. Nelson, "Modeling and generating random vectors with arbitrary marginal distributions
//         and correlation matrix", Northwestern University, 1997 (NORTA); W. Whitt, Ann. Statist. 4
//         (1976) 1280-1289, doi:10.1214/aos/1176343660 (the ends).
#pragma once

#include <vector>

#include "math/distributions/marginal.hpp"

namespace stipple::parameters {

/// A parameter, or the mean ranks of its numbers, as a function of its normal score.
class Scored {
  public:
    /// What of a parameter is correlated: its numbers, or the middles (F(x) + F(x-)) / 2 of their
    /// ranks.
    enum class Of { numbers, ranks };

    /// @throws Error(usage) where the variance is 0 or infinite, or lies too far in the tails
    Scored(MarginalPtr law, Of of);

    /// The correlation of the scores with which this and another one have the correlation r.
    /// @throws Error(usage) where none has, naming what is possible
    [[nodiscard]] double scores_for(const Scored& other, double r) const;

    /// The correlation of both where that of their scores is sign, 1 or -1.
    [[nodiscard]] double extreme(const Scored& other, double sign) const;

    struct Increment {
        double at;  ///< score
        double size;
    };

  private:
    void take_steps();
    void take_cells();
    void take_panels();
    void add_panel(double low, double high, double x_low, double x_high);
    void settle();

    /// At a score, from the mean on.
    [[nodiscard]] double at(double z) const;
    /// The number itself.
    [[nodiscard]] double number(double z) const;
    /// Increments for kernels that are not narrower than `width`.
    [[nodiscard]] std::vector<Increment> gathered(double width) const;

    MarginalPtr law_;
    bool ranks_;
    bool stepped_ = false;               ///< all increments are steps, and these are all
    std::vector<Increment> increments_;  ///< rising
    std::vector<double> levels_;         ///< between steps
    std::vector<double> cuts_;           ///< between which it is smooth
    double mean_ = 0;
    double deviation_ = 1;
};

}  // namespace stipple::parameters
