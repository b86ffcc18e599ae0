// SPDX-License-Identifier: MIT
//
// Branch and bound for anchored boxes. With many points, cells take long to become small, so a
// first upper bound comes from a grid cover, or from a net if the points form one. From time to
// time a threshold search looks for worse boxes, which exploring the cells would find only late.
//
// Source  the bounds are original; earlier exact methods are surveyed in C. Doerr, M. Gnewuch, M.
//         Wahlstroem, arXiv:1405.1653.
#include "math/discrepancy/star/search.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/star/cell.hpp"

namespace stipple::discrepancy::star {
namespace {

class AnchoredBoxes final : public Problem {
  public:
    AnchoredBoxes(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run)
        : grid_(grid),
          logs_(logarithms(grid)),
          points_(all_points(grid)),
          limits_(limits),
          run_(run) {}

    [[nodiscard]] std::vector<Cell> all_cells() const override {
        return {whole_cell(grid_, Side::open), whole_cell(grid_, Side::closed)};
    }

    void explore(Task& task) const override {
        star::explore(grid_, logs_, points_, task, limits_, run_);
    }

    [[nodiscard]] bool by_stages(const Known& known) const override {
        constexpr std::uint64_t part = 64;  // 1 / part of the work is spent on an exact value first
        return limits_.wants_bounds() ||
               known.work > std::max(SearchLimits::short_work, limits_.work / part);
    }

    void look_around(Known& known, std::uint64_t work) override {
        constexpr std::uint64_t short_work = SearchLimits::short_work;
        if (known.work > short_work / 4) look_quickly(known.worst, known.upper);
        // Work between two threshold searches, as a multiple of theirs.
        constexpr std::uint64_t searches_apart = 16;
        if (known.work > short_work && searches_apart * threshold_work_ < known.work) {
            const std::uint64_t cost =
                accept_thresholds(grid_, rounds_, known.worst, limits_, run_);
            ++rounds_;
            threshold_work_ += cost;
            known.work += cost;
        }
        if (!covered_ && (limits_.wants_bounds() || known.work > short_work)) cover(known, work);
    }

    /// Computes the cheapest bounds, once.
    void look_quickly(WorstBox& worst, double& upper) {
        if (std::exchange(looked_, true)) return;
        offer_axis_boxes(grid_, worst);
        upper = std::max(worst.value(), std::min(upper, quick_bound(grid_, run_)));
    }

  private:
    /// Computes an upper bound with about an eighth of the remaining work or time.
    void cover(Known& known, std::uint64_t work) {
        covered_ = true;
        constexpr double corners_a_second = 1e8;
        const std::uint64_t d = grid_.dimension();
        std::uint64_t corners = std::uint64_t{1} << 25;
        corners = std::min(corners, (work - std::min(known.work, work)) / (16 * d));
        corners = std::min(corners, run_.max_memory / 16);
        if (!limits_.wants_bounds()) corners = std::min(corners, known.work / (16 * d));
        if (limits_.wants_bounds() && run_.seconds)
            corners = static_cast<std::uint64_t>(
                std::clamp((limits_.deadline - run_.seconds()) / 16 * corners_a_second, 0.0,
                           static_cast<double>(corners)));
        known.upper = std::min(known.upper, cover_bound(grid_, corners, run_));
        known.upper = std::min(known.upper, net_bound(grid_, known.upper, corners * d, run_));
        known.work += 2 * corners * d;
    }

    const BoxGrid& grid_;
    const std::vector<std::vector<double>> logs_;
    const Active points_;
    const SearchLimits& limits_;
    const RunContext& run_;
    std::uint64_t rounds_ = 0;  ///< rounds of threshold accepting so far
    std::uint64_t threshold_work_ = 0;
    bool looked_ = false;
    bool covered_ = false;
};

}  // namespace

double quick_bound(const BoxGrid& grid, const RunContext& run, double of_axis, double of_all) {
    constexpr std::uint64_t few_corners = 1U << 17;
    return std::min(axis_bound(grid, of_axis),
                    of_all * cover_bound(grid, few_corners, unstopped(run)));
}

SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers) {
    AnchoredBoxes problem(grid, limits, run);
    SearchResult found =
        branch_and_bound(problem, grid, {.worst = std::move(worst)}, limits, run, peers);
    if (found.ending != Ending::complete) problem.look_quickly(found.worst, found.upper);
    return found;
}

SearchResult sweep_or_search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                             const RunContext& run) {
    if (grid.dimension() == 1) return sweep_1d(grid, run);
    if (grid.dimension() == 2) return sweep_2d(grid, limits, run);
    return search(grid, std::move(worst), limits, run);
}

SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        Peers* peers) {
    const Ascent first = ascend(grid, limits, run);
    return search(grid, first.worst, limits.after(first.work), run, peers);
}

double search_bytes(std::size_t count, std::size_t dimension, unsigned threads) {
    // Each thread keeps the points of its first cell and of all smaller cells down to the current
    // one. The smaller cells have together about as many points as the first. A third copy covers
    // the scratch space of the bounds.
    constexpr double copies = 3;
    return (1 + copies * threads) * static_cast<double>(count) * static_cast<double>(dimension) *
           sizeof(std::int32_t);
}

}  // namespace stipple::discrepancy::star
