// SPDX-License-Identifier: MIT
//
// With x fixed, every candidate y_j is a line in x: the open box is x y_j - A_j / n too empty, the
// closed one C_j / n - x y_j too full. Going up in x, a point adds 1 to the counts of all y_j above
// it (open) or from it on (closed), and the highest line is wanted at each x: before the points at
// x enter for the open box, after for the closed one.
//
// Source  D. P. Dobkin, D. Eppstein, D. P. Mitchell, "Computing the discrepancy with applications
//         to supersampling patterns", ACM Trans. Graph. 15 (1996) 354-376,
//         doi:10.1145/234535.234536 (the lines; here with a kinetic tree in place of dynamic convex
//         hulls).

#include "analyzers/star_sweep.hpp"

#include <array>
#include <mutex>

#include "core/parallel.hpp"
#include "math/kinetic_tree.hpp"

namespace stipple::analyzers::star {
namespace {

constexpr std::size_t ticks_apart = 256;  // points between two looks at the stop token

/// The points in order of their first coordinate: those with place a on the first axis have, on
/// the second, the places second[starts[a]], ..., second[starts[a + 1] - 1].
struct ByFirst {
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> second;
};

ByFirst by_first(const CornerGrid& grid) {
    ByFirst order{std::vector<std::uint32_t>(grid.values[0].size() + 1),
                  std::vector<std::uint32_t>(grid.count)};
    for (const auto a : grid.ranks[0]) ++order.starts[a + 1];
    for (std::size_t a = 1; a < order.starts.size(); ++a) order.starts[a] += order.starts[a - 1];
    auto next = order.starts;
    for (std::size_t i = 0; i < grid.count; ++i)
        order.second[next[grid.ranks[0][i]]++] = grid.ranks[1][i];
    return order;
}

/// Progress of several sweeps at once.
class SharedProgress {
  public:
    SharedProgress(const RunContext& run, std::uint64_t total) : run_(run), total_(total) {}

    void add(std::uint64_t done) {
        const std::lock_guard lock(mutex_);
        done_ += done;
        run_.tick(done_, total_);
    }

    [[nodiscard]] const RunContext& run() const { return run_; }

  private:
    const RunContext& run_;
    std::mutex mutex_;
    std::uint64_t done_ = 0;
    std::uint64_t total_;
};

/// The worst box of one side.
template <Side side>
void sweep_side(const CornerGrid& grid, const ByFirst& order, WorstBox& worst,
                SharedProgress& progress) {
    constexpr auto steep = side == Side::open ? SteepWins::late : SteepWins::early;
    constexpr std::size_t shift = side == Side::open ? 1 : 0;  // an open box has no points on it
    KineticTree<steep> lines(grid.values[1], static_cast<double>(grid.count), progress.run());

    const auto query = [&](std::uint32_t a, double x) {
        lines.advance(x);
        const auto level = [&worst] { return worst.threshold(); };
        lines.visit_above(level, x, [&](std::size_t j, std::int32_t count) {
            worst.offer(side, std::array{a, static_cast<std::uint32_t>(j)},
                        static_cast<std::uint64_t>(count));
        });
    };
    std::uint64_t since_tick = 0;
    for (std::uint32_t a = 0; a < grid.values[0].size(); ++a) {
        const double x = grid.values[0][a];
        if (side == Side::open) query(a, x);
        for (auto i = order.starts[a]; i < order.starts[a + 1]; ++i) {
            lines.add_from(order.second[i] + shift, x);
            if (++since_tick == ticks_apart) progress.add(std::exchange(since_tick, 0));
        }
        if (side == Side::closed) query(a, x);
    }
    progress.add(since_tick);
}

}  // namespace

WorstBox sweep_1d(const CornerGrid& grid, const RunContext& run) {
    WorstBox worst(grid);
    const auto& values = grid.values[0];
    std::vector<std::uint32_t> points_at(values.size());
    for (const auto a : grid.ranks[0]) ++points_at[a];
    std::uint64_t below = 0;
    for (std::uint32_t a = 0; a < values.size(); ++a) {
        worst.offer(Side::open, std::array{a}, below);
        below += points_at[a];
        worst.offer(Side::closed, std::array{a}, below);
        if (a % ticks_apart == 0) run.tick(a, values.size());
    }
    run.tick(1, 1);
    return worst;
}

WorstBox sweep_2d(const CornerGrid& grid, const RunContext& run) {
    run.need_memory(2 * KineticTree<SteepWins::late>::memory(grid.values[1].size()),
                    "the sweep over the square");
    const ByFirst order = by_first(grid);
    SharedProgress progress(run, 2 * grid.count);
    std::array worst{WorstBox(grid), WorstBox(grid)};
    constexpr bool silent = true;
    for_each_block(
        worth_threads(run, 1e-6 * static_cast<double>(grid.count)), 2, 1,
        [&](const Block& block) {
            if (block.index == 0)
                sweep_side<Side::open>(grid, order, worst[0], progress);
            else
                sweep_side<Side::closed>(grid, order, worst[1], progress);
        },
        silent);
    worst[0].offer(worst[1]);
    return worst[0];
}

}  // namespace stipple::analyzers::star
