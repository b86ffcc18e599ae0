// SPDX-License-Identifier: MIT
#include "generators/optimized/order_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/optimized/planar_order.hpp"
#include "generators/search_run.hpp"
#include "math/combinatorics/order.hpp"

namespace stipple {
namespace {

using Ranks = PlanarOrder::Ranks;

const double golden = (std::sqrt(5.0) - 1) / 2;

constexpr double on_cycle = 0.35;  ///< fraction of the swaps that are tried on the critical cycle
constexpr double patience = 20;  ///< a descent ends after this many swaps per point without a gain
constexpr double kick_height = 0.2;     ///< largest relative rise of the level by a kick
constexpr std::size_t kick_swaps = 20;  ///< largest number of swaps in a kick
constexpr double solution = 30;         ///< steps to solve one order, divided by n^2

struct Descent {
    Ranks ranks;
    double level = std::numeric_limits<double>::infinity();
    bool over = false;              ///< true if many swaps in a row gained nothing
    std::vector<double> rows = {};  ///< points with that level; empty unless the run keeps the best
};

Descent reached(const PlanarOrder& order, bool over, const RunContext& run) {
    return {order.ranks(), order.level(), over,
            run.keeps_best ? order.points() : std::vector<double>()};
}

bool better(const Descent& a, const Descent& b) { return a.level < b.level; }

double unit(SplitMix64& draws) { return to_unit(draws.next()); }

/// For each point in the order of x, its rank by y; all coordinates are distinct.
Ranks order_of(const std::vector<double>& x, const std::vector<double>& y) {
    const auto sorted = [](const std::vector<double>& values) {
        return order_by(values.size(), [&](std::uint32_t i) { return values[i]; });
    };
    const auto by_x = sorted(x);
    const auto by_y = sorted(y);
    Ranks place(x.size());
    for (std::uint32_t j = 0; j < by_y.size(); ++j) place[by_y[j]] = j;
    Ranks ranks;
    for (const std::uint32_t i : by_x) ranks.push_back(place[i]);
    return ranks;
}

/// Order of the points (i, (i phi + s) mod 1), phi the golden section, with a random shift s.
Ranks rotation(std::size_t n, SplitMix64& draws) {
    std::vector<double> x;
    std::vector<double> y;
    const double shift = unit(draws);
    for (std::size_t i = 0; i < n; ++i) {
        const double turned = static_cast<double>(i) * golden + shift;
        x.push_back(static_cast<double>(i));
        y.push_back(turned - std::floor(turned));
    }
    return order_of(x, y);
}

/// Order of the points (k t (a + b / golden), (k / t) (a - b golden)), a and b integers, that a
/// random shift puts into the unit square. t is random, and k such that these are n points on
/// average; returns an empty order unless they are exactly n.
Ranks lattice_cut(std::size_t n, SplitMix64& draws) {
    const double k = std::sqrt(1 / (static_cast<double>(n) * std::sqrt(5.0)));
    const double t = golden + unit(draws) * (1 / golden - golden);
    const double right = unit(draws);
    const double up = unit(draws);
    const double wide = 1 / (k * t);
    const double high = t / k;
    // Bounds: a + b / golden in wide * [-right, 1 - right), a - b golden in high * [-up, 1 - up).
    const double spread = golden + 1 / golden;
    const auto first =
        static_cast<std::int64_t>(std::floor((-right * wide - (1 - up) * high) / spread));
    const auto last =
        static_cast<std::int64_t>(std::ceil(((1 - right) * wide + up * high) / spread));
    std::vector<double> x;
    std::vector<double> y;
    for (std::int64_t b = first; b <= last; ++b) {
        const auto whole = static_cast<double>(b);
        const double low = std::max(-right * wide - whole / golden, -up * high + whole * golden);
        for (double a = std::ceil(low);; ++a) {
            const double across = (a + whole / golden) / wide + right;
            const double upward = (a - whole * golden) / high + up;
            if (across >= 1 || upward >= 1) break;
            if (across < 0 || upward < 0) continue;
            x.push_back(across);
            y.push_back(upward);
        }
    }
    return x.size() == n ? order_of(x, y) : Ranks();
}

Ranks start(std::size_t n, SplitMix64& draws, const RunContext& run) {
    constexpr int tries = 100;
    const bool cut = draws.below(2) == 0;
    for (int i = 0; cut && i < tries; ++i) {
        run.check_stop();
        if (Ranks ranks = lattice_cut(n, draws); !ranks.empty()) return ranks;
    }
    return rotation(n, draws);
}

PlanarOrder::Swap any_swap(std::size_t n, SplitMix64& draws) {
    const bool by_x = draws.below(2) == 0;
    return {by_x, 1 + static_cast<std::size_t>(draws.below(n - 1))};
}

/// Makes a random number of swaps that together raise the level by at most a random amount.
void kick(PlanarOrder& order, std::size_t n, SplitMix64& draws) {
    constexpr int tries = 200;
    const double u = unit(draws);
    const double limit = order.level() * (1 + kick_height * u * u);
    const std::size_t most = 1 + draws.below(kick_swaps);
    std::size_t made = 0;
    for (int i = 0; i < tries && made < most; ++i)
        made += static_cast<std::size_t>(order.attempt(any_swap(n, draws), limit));
}

/// Continues a descent for at most `steps` steps; if it is over, first changes its order by a kick.
/// Returns the steps taken. @throws Error(cancelled)
double go_on(Descent& descent, SplitMix64 draws, double steps, const RunContext& run) {
    constexpr double equal = 1 + 1e-12;
    const std::size_t n = descent.ranks.size();
    PlanarOrder order(descent.ranks, run);
    if (descent.over) kick(order, n, draws);
    const auto most = static_cast<std::uint64_t>(patience * static_cast<double>(n));
    double lowest = order.level();
    std::uint64_t in_vain = 0;
    const bool kicked = descent.over;
    while (in_vain < most && static_cast<double>(order.steps()) < steps) {
        run.check_stop();
        ++in_vain;
        const bool critical = unit(draws) < on_cycle;
        const auto swap = critical ? order.critical_swap(draws) : any_swap(n, draws);
        if (swap) order.attempt(*swap, lowest * equal, critical);
        if (order.level() * equal >= lowest) continue;
        lowest = order.level();
        in_vain = 0;
        if (run.keeps_best && lowest < descent.level) descent = reached(order, kicked, run);
    }
    if (!kicked || order.level() <= descent.level * equal)
        descent = reached(order, in_vain >= most, run);
    return static_cast<double>(order.steps());
}

class OrderSearch {
  public:
    OrderSearch(std::size_t n, std::uint64_t seed, double budget, const RunContext& run)
        : n_(n), rng_(seed), budget_(budget), run_(run), inner_(silent(run)) {}

    /// @throws Error(cancelled), also if a stop request comes before there is a best order
    Descent best() {
        make_starts();
        std::vector<Descent> all;
        for (std::size_t i = 0; spent_ < 0.4 * budget_ && !run_.best_is_wanted();) {
            std::vector<Descent> some;
            for (; some.size() < together(); ++i)
                some.push_back(i < starts_.size() ? starts_[i] : another_start());
            advance(some, 0.1);
            std::ranges::move(some, std::back_inserter(all));
        }
        if (all.empty()) all = starts_;
        while (spent_ < budget_ && !run_.best_is_wanted()) {
            keep_best(all, spent_ < 0.6 * budget_    ? 32
                           : spent_ < 0.75 * budget_ ? 16
                           : spent_ < 0.88 * budget_ ? 8
                                                     : 4);
            advance(all, 0.05);
        }
        if (all.empty()) run_.check_stop();
        return *std::ranges::min_element(all, better);
    }

  private:
    /// Returns a start to use after all of starts_: a random one of them, changed by up to n swaps.
    Descent another_start() {
        SplitMix64 own = draws();
        Ranks ranks = starts_[own.below(starts_.size())].ranks;
        for (std::uint64_t swaps = 1 + own.below(n_); swaps > 0; --swaps) {
            const auto [by_x, p] = any_swap(n_, own);
            auto& first = by_x ? ranks[p - 1] : *std::ranges::find(ranks, p - 1);
            auto& second = by_x ? ranks[p] : *std::ranges::find(ranks, p);
            std::swap(first, second);
        }
        return {std::move(ranks)};
    }

    /// Number of descents advanced together: fewer if each takes long; the same on every machine.
    [[nodiscard]] std::size_t together() const { return n_ <= 200 ? 16 : n_ <= 500 ? 8 : 4; }

    [[nodiscard]] SplitMix64 draws() { return SplitMix64(rng_.bits(tasks_++)); }

    void make_starts() {
        const double size = static_cast<double>(n_) * static_cast<double>(n_);
        const double some = std::clamp(0.1 * budget_ / (solution * size), 4.0, 1000.0);
        std::vector<Descent> all(static_cast<std::size_t>(some));
        std::vector<SplitMix64> streams;
        for (std::size_t i = 0; i < all.size(); ++i) streams.push_back(draws());
        std::vector<double> steps(all.size());
        for_each_block(until_best_is_wanted(run_.stage(0, 0.1)), all.size(), 1,
                       [&](const Block& block) {
                           unless_best_is_wanted(run_, [&] {
                               inner_.check_stop();
                               SplitMix64 own = streams[block.index];
                               const PlanarOrder order(start(n_, own, inner_), inner_);
                               all[block.index] = reached(order, false, run_);
                               steps[block.index] = static_cast<double>(order.steps());
                           });
                       });
        spent_ += std::accumulate(steps.begin(), steps.end(), 0.0);
        std::erase_if(all, [](const Descent& one) { return one.ranks.empty(); });
        keep_best(all, all.size());
        starts_ = std::move(all);
    }

    /// Removes duplicates, sorts by level and keeps at most `most`.
    static void keep_best(std::vector<Descent>& all, std::size_t most) {
        std::ranges::stable_sort(all, {}, &Descent::ranks);
        const auto same = [](const Descent& a, const Descent& b) { return a.ranks == b.ranks; };
        all.erase(std::unique(all.begin(), all.end(), same), all.end());
        std::ranges::stable_sort(all, better);
        if (all.size() > most) all.resize(most);
    }

    /// Continues all descents, each for at most a fraction `share` of the budget.
    void advance(std::vector<Descent>& all, double share) {
        std::vector<SplitMix64> streams;
        for (std::size_t i = 0; i < all.size(); ++i) streams.push_back(draws());
        std::vector<double> steps(all.size());
        for_each_block(until_best_is_wanted(inner_), all.size(), 1, [&](const Block& block) {
            const std::size_t i = block.index;
            unless_best_is_wanted(run_, [&] {
                inner_.check_stop();
                steps[i] = go_on(all[i], streams[i], share * budget_, inner_);
            });
        });
        if (run_.best_is_wanted()) return;
        spent_ += std::accumulate(steps.begin(), steps.end(), 0.0);
        const double level = std::ranges::min_element(all, better)->level;
        least_ = least_ > 0 ? std::min(least_, level) : level;
        const auto n = static_cast<double>(n_);
        report_search(run_, spent_ / budget_, "star", level / n, least_ / n);
    }

    std::size_t n_;
    Rng rng_;
    double budget_;
    const RunContext& run_;
    RunContext inner_;  ///< context of descents, without progress
    std::uint64_t tasks_ = 0;
    double spent_ = 0;
    double least_ = 0;
    std::vector<Descent> starts_;
};

}  // namespace

optimized::OptimizedRows least_star_discrepancy(std::size_t n, std::uint64_t seed, double budget,
                                                const RunContext& run) {
    const auto size = static_cast<double>(n);
    const double bytes = 8 * size * size + 200 * size;
    run.need_memory(bytes, "the search for an order");
    RunContext own = run;  // has only as many threads as memory allows
    own.threads = static_cast<unsigned>(std::min(static_cast<double>(run.memory_left()) / bytes,
                                                 static_cast<double>(run.thread_count())));
    Descent best = n > 1 ? OrderSearch(n, seed, budget, own).best() : Descent{{0}};
    if (run.best_is_wanted() && !best.rows.empty())
        return {std::move(best.rows), best.level / size, true};
    const PlanarOrder order(best.ranks, run);
    return {order.points(), order.level() / size, run.best_is_wanted()};
}

}  // namespace stipple
