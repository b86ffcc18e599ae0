// SPDX-License-Identifier: MIT
//
// Criteria for the optimisation of Latin hypercubes. Distances are Euclidean, between levels 0,
// ..., n - 1; x are the middles of the strata, (2 level + 1) / (2 n).
//
//     maximin        the minimum squared distance, maximised; if equal, the fewest pairs with it
//     phi_p          (sum over pairs of d^-p)^(1/p)
//     audze_eglais   sum over pairs of d^-2
//     centered_l2    the squared centered L2 discrepancy of x (math/l2/kinds.hpp)
//     maxpro         (mean over pairs of prod_k (x_ik - x_jk)^-2)^(1/d)
//     correlation    the largest absolute correlation of two coordinates
//
// A search minimises an energy, which an exchange of two levels updates in O(n), for correlations
// in O(d):
//
//     maximin        sum over pairs of max(0, target - d^2); the target rises once the sum is 0
//     centered_l2    n^2 times the squared discrepancy, without its constant term
//     correlation    sum over pairs of coordinates of the fourth power of the correlation
//     others         the sum over pairs
//
// Promise  energies of maximin are whole numbers, and exact.
// Source   phi_p: M. D. Morris, T. J. Mitchell, J. Statist. Plann. Inference 43 (1995) 381-402,
//          doi:10.1016/0378-3758(94)00035-T. Audze-Eglais, summed without further factors, as in
//          the tables of spacefillingdesigns.nl: B. G. M. Husslage, G. Rennen, E. R. van Dam,
//          D. den Hertog, Optim. Eng. 12 (2011) 611-630, doi:10.1007/s11081-010-9129-8. maxpro:
//          V. R. Joseph, E. Gul, S. Ba, Biometrika 102 (2015) 371-380, doi:10.1093/biomet/asv002.
#pragma once

#include <compare>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "generators/stratified/latin_hypercube_search/design.hpp"
#include "stipple/run.hpp"

namespace stipple::latin_hypercube_search {

enum class Kind { maximin, phi_p, audze_eglais, centered_l2, maxpro, correlation };

struct Objective {
    Kind kind = Kind::maximin;
    int power = 15;  ///< p of phi_p, in [1, 50]
};

/// Value of a design, smaller is better; `second` decides between equal values.
struct Score {
    double value = 0;
    double second = 0;
    auto operator<=>(const Score&) const = default;
};

class Criterion {
  public:
    Criterion() = default;
    Criterion(const Criterion&) = delete;
    Criterion& operator=(const Criterion&) = delete;
    virtual ~Criterion() = default;

    /// Change of the energy if rows a and b exchange levels on an axis; only b may be a spare row.
    virtual double change(std::size_t coordinate, std::size_t a, std::size_t b) = 0;

    /// Makes the exchange; `change` is the result of change().
    virtual void exchange(std::size_t coordinate, std::size_t a, std::size_t b, double change) = 0;

    [[nodiscard]] virtual double energy() const = 0;

    /// Whether the energy is known to be minimal; for maximin: whether the target is reached.
    [[nodiscard]] virtual bool reached() const { return false; }

    /// Sets the target of maximin, a squared distance; 0: the mean squared distance of nearest
    /// neighbours. Returns false for criteria without targets.
    virtual bool aim(double /*target*/) { return false; }

    [[nodiscard]] virtual Score score() const = 0;

    /// Returns the score, or `other` if a quick test shows that the score is not below `other`.
    virtual Score score_below(const Score& other) = 0;
};

/// Criterion of a design. Later changes of the design affect it only by exchange(). Pairs of fixed
/// rows do not count. A stop request ends long computations. @throws Error(cancelled)
std::unique_ptr<Criterion> make_criterion(const Objective& objective, const Design& design,
                                          const Rules& rules, const RunContext& run = {});
std::unique_ptr<Criterion> pair_criterion(const Objective& objective, const Design& design,
                                          const Rules& rules, const RunContext& run);

/// Bytes that a criterion needs.
double criterion_memory(const Objective& objective, const Design& design);

/// Typical difference of two levels, and mean squared distance of two points; used as divisors.
double usual_difference(std::size_t points);
double usual_square(std::size_t points, std::size_t dimension);

/// Value of a score as reported in provenance and progress.
double reported(const Objective& objective, const Score& score, std::size_t points,
                std::size_t dimension);

/// Named results: the criterion's value over all points, and related quantities. Infinite ones,
/// which occur if points share a level, are left out. Takes O(n^2 d).
std::vector<std::pair<std::string, std::string>> described(const Objective& objective,
                                                           const Design& design, const Rules& rules,
                                                           const RunContext& run);

}  // namespace stipple::latin_hypercube_search
