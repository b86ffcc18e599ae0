// SPDX-License-Identifier: MIT
//
// Simulated annealing of a design by exchanges of two levels along one coordinate.
//
// Of exchanges that raise the energy by e, a share exp(-e / temperature) is made. The temperature
// follows that share: it goes down a little with each one that is made, and up with each one that is
// not, so that the share falls from a first value to a last one by a constant factor from trial to
// trial, whatever energies are. Where the energy reaches its target, the next one is set (maximin).
//
// Promise  a function of the start, the schedule and the draws; in any pieces.
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
    double target = 0;  ///< of maximin at first; 0: one for a random design
};

/// A row and another one, which may be spare, that can exchange their levels of a coordinate.
struct Exchange {
    std::size_t coordinate;
    std::size_t a;
    std::size_t b;
};

/// A design that exchanges change as the rules allow.
class Exchanges {
  public:
    Exchanges(Design design, const Rules& rules);

    /// A random one; false: the rules, but for what is feasible, do not let it be.
    bool draw(SplitMix64& draws, Exchange& exchange) const;

    /// Whether the points of an exchange would be feasible: how many of them are not.
    int infeasible(const Exchange& exchange);

    void make(const Exchange& exchange);
    [[nodiscard]] const Design& design() const { return design_; }

    /// Exchanges levels until all points are feasible: how many are not, in the end.
    std::size_t make_feasible(SplitMix64& draws);

    /// Makes random exchanges, as many for each level as `times`, and before them those that make all
    /// points feasible. @throws Error(limit) where it finds none
    void shuffle(SplitMix64& draws, std::size_t times);

  private:
    [[nodiscard]] std::size_t partner(SplitMix64& draws, std::size_t k, std::size_t a) const;
    [[nodiscard]] bool possible(const Exchange& exchange) const;
    void make_fit(SplitMix64& draws, std::size_t row);
    [[nodiscard]] bool fits(std::size_t row);
    bool fits(std::size_t row, std::size_t k, Level level);

    Design design_;
    const Rules& rules_;
    std::vector<std::uint32_t> group_;  ///< of each row; empty: one for all
    std::vector<std::uint32_t>
        row_at_;              ///< of each level, coordinate after coordinate; with groups
    std::vector<Level> row_;  ///< that is tried
};

class Annealing {
  public:
    /// @param rules must stay
    Annealing(const Objective& objective, const Design& start, const Rules& rules,
              const Schedule& schedule, SplitMix64 draws);

    /// Makes so many more of the trials; fewer where there is no more to gain, or once the whole run
    /// wants the best so far.
    void advance(double trials, const RunContext& run, const RunContext& whole);

    /// The best design so far that it took note of, and its score.
    [[nodiscard]] const Design& best() const { return best_; }
    [[nodiscard]] const Score& score() const { return score_; }

  private:
    void trial();
    bool accepts(double change);
    void note();
    void aim_next();
    [[nodiscard]] double pass() const;

    Schedule schedule_;
    SplitMix64 draws_;
    Exchanges exchanges_;
    std::unique_ptr<Criterion> criterion_;
    double done_ = 0;
    double next_ = 0;  ///< the trial at which the share changes next
    double share_;
    double cooling_;  ///< of the share, from piece to piece
    bool polishing_ = false;
    bool over_ = false;
    double temperature_ = 0;
    Design best_;
    Score score_;
};

}  // namespace stipple::latin_hypercube_search
