// SPDX-License-Identifier: MIT
//
// Simulated annealing of a design by exchanges of two levels along one coordinate.
//
// An exchange that raises the energy by e is accepted with probability exp(-e / temperature). The
// temperature falls a little when such an exchange is accepted and rises when it is rejected, to
// keep a wanted fraction of accepted ones for any scale of energies. This fraction falls from a
// first value to a last one, by a constant factor every 1024 trials. For maximin, the next target
// is set as soon as the present one is reached, when the energy is 0.
//
// Promise  a function of the start, the schedule and the draws, however the trials are split.
#pragma once

#include <memory>

#include "generators/stratified/latin_hypercube_search/criteria.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple::latin_hypercube_search {

struct Schedule {
    double trials = 1;
    double first_share = 0.05;
    double last_share = 5e-5;
    double target = 0;  ///< first target of maximin; 0: one that suits a random design
};

/// Exchange of the levels of two rows along a coordinate; b may be a spare row (see Design).
struct Exchange {
    std::size_t coordinate;
    std::size_t a;
    std::size_t b;
};

/// A design, changed by exchanges that the rules allow.
class Exchanges {
  public:
    Exchanges(Design design, const Rules& rules);

    /// Draws a random exchange, maybe infeasible; false if the drawn rows cannot be exchanged.
    bool draw(SplitMix64& draws, Exchange& exchange) const;

    /// Number of the exchange's two points that would be infeasible after it.
    int infeasible(const Exchange& exchange);

    void make(const Exchange& exchange);
    [[nodiscard]] const Design& design() const { return design_; }

    /// Exchanges levels to make all points feasible; returns the number of infeasible points left.
    std::size_t make_feasible(SplitMix64& draws, const RunContext& run);

    /// Makes all points feasible, then makes `times` random exchanges per level.
    /// @throws Error(limit) if some points stay infeasible
    void shuffle(SplitMix64& draws, std::size_t times, const RunContext& run = {});

  private:
    [[nodiscard]] std::size_t partner(SplitMix64& draws, std::size_t k, std::size_t a) const;
    [[nodiscard]] bool possible(const Exchange& exchange) const;
    void make_fit(SplitMix64& draws, std::size_t row);
    [[nodiscard]] bool fits(std::size_t row);
    bool fits(std::size_t row, std::size_t k, Level level);

    Design design_;
    const Rules& rules_;
    std::vector<std::uint32_t> group_;   ///< group of each row; empty: one group
    std::vector<std::uint32_t> row_at_;  ///< row of each level, by coordinate; only with groups
    std::vector<Level> row_;             ///< buffer of fits() for the levels to check
};

/// Best design so far, as an earlier design and exchanges, so that improvements need no copy.
class Trail {
  public:
    explicit Trail(Design start) : best_(std::move(start)) {}

    void made(const Exchange& exchange);

    /// Marks the current design as the best.
    void mark(const Design& now);

    const Design& best();

  private:
    void go_to_mark();

    Design best_;                  ///< an earlier design, before the steps
    std::vector<Exchange> steps_;  ///< exchanges made since then
    std::size_t mark_ = 0;         ///< number of steps that lead to the best design
    bool left_ = false;            ///< later steps were dropped, so mark() must copy the design
};

class Annealing {
  public:
    /// @param objective, rules must outlive the annealing
    Annealing(const Objective& objective, const Design& start, const Rules& rules,
              const Schedule& schedule, SplitMix64 draws, const RunContext& run);

    /// Makes `trials` more of the schedule's trials, or fewer if the score cannot improve any more.
    /// @throws Error(cancelled), after updating best() if run.keeps_best
    void advance(double trials, const RunContext& run);

    /// Best design so far and its score. Maximin compares only the start and designs that reach a
    /// target, begin the final phase or end a call of advance().
    [[nodiscard]] const Design& best() { return trail_.best(); }
    [[nodiscard]] const Score& score() const { return score_; }

    /// Final step: recomputes the score of the best design, without rounding errors of exchanges.
    /// @throws Error(cancelled), leaving the score as it was
    void settle(const RunContext& run);

  private:
    void trial();
    bool accepts(double change);
    void note();
    void aim_next();
    [[nodiscard]] double pass() const;

    const Objective& objective_;
    const Rules& rules_;
    Schedule schedule_;
    SplitMix64 draws_;
    Exchanges exchanges_;
    Trail trail_;
    std::unique_ptr<Criterion> criterion_;
    double done_ = 0;
    double next_ = 0;  ///< trial at which the accepted fraction changes next
    double share_;
    double cooling_;  ///< factor of the accepted fraction every 1024 trials
    bool polishing_ = false;
    bool over_ = false;
    double temperature_ = 0;
    Score score_;
};

}  // namespace stipple::latin_hypercube_search
