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
    std::size_t make_feasible(SplitMix64& draws, const RunContext& run);

    /// Makes random exchanges, as many for each level as `times`, and before them those that make all
    /// points feasible. @throws Error(limit) where it finds none
    void shuffle(SplitMix64& draws, std::size_t times, const RunContext& run = {});

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

/// The best of the designs that exchanges lead to, by the way to it: no copy for each better one.
class Trail {
  public:
    explicit Trail(Design start) : best_(std::move(start)) {}

    void made(const Exchange& exchange);

    /// The design that all exchanges made is the best.
    void mark(const Design& now);

    const Design& best();

  private:
    void go_to_mark();

    Design best_;                  ///< before the steps
    std::vector<Exchange> steps_;  ///< from it
    std::size_t mark_ = 0;         ///< those that lead to the best
    bool left_ = false;            ///< steps were too many: the next mark is a copy
};

class Annealing {
  public:
    /// @param objective, rules must stay
    Annealing(const Objective& objective, const Design& start, const Rules& rules,
              const Schedule& schedule, SplitMix64 draws, const RunContext& run);

    /// Makes so many more of the trials; fewer where there is no more to gain.
    /// @throws Error(cancelled): of the best so far it has then taken note
    void advance(double trials, const RunContext& run);

    /// The best design so far, of maximin among those that reached a target, and its score.
    [[nodiscard]] const Design& best() { return trail_.best(); }
    [[nodiscard]] const Score& score() const { return score_; }

    /// The end: the score is that of the best design by itself, without the rounding of exchanges.
    /// @throws Error(cancelled): the score is then as it was
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
    double next_ = 0;  ///< the trial at which the share changes next
    double share_;
    double cooling_;  ///< of the share, from piece to piece
    bool polishing_ = false;
    bool over_ = false;
    double temperature_ = 0;
    Score score_;
};

}  // namespace stipple::latin_hypercube_search
