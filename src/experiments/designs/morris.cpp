// SPDX-License-Identifier: MIT
//
// Morris' design for elementary effects: r trajectories of k + 1 runs, where each differs from
// the previous one in one factor. The levels of a factor are l / (p - 1), l = 0, ..., p - 1, over
// its whole range, and the factor moves by
//
//     delta = p / (2 (p - 1)),       that is, by p / 2 of its p levels.
//
// The order of the factors, the starting levels and the directions are random and equally likely.
//
//     --middles  levels (2 l + 1) / (2 p), the middles of equal cells; delta is 1/2 for every p
//     --radial   r stars instead of trajectories: a point A, then for each factor A with this
//                coordinate from a point B, which is four points ahead of A in the Sobol' sequence
//
// Shape   n = r (k + 1).
// Promise trajectories do not depend on their number: a larger design extends a smaller one.
// Beware  a function with the period delta in a factor seems not to depend on it.
// Source  M. D. Morris, Technometrics 33 (1991) 161-174, doi:10.1080/00401706.1991.10484804;
//         F. Campolongo, A. Saltelli, J. Cariboni, Comput. Phys. Commun. 182 (2011) 978-988,
//         doi:10.1016/j.cpc.2010.12.039 (radial).

#include <numeric>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "experiments/designs/levels.hpp"
#include "experiments/designs/radial.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::generators::morris {
namespace {

constexpr Param<std::int64_t> levels{.name = "levels",
                                     .fallback = 4,
                                     .low = 2,
                                     .high = 1'048'576,
                                     .unit = "levels",
                                     .help = "Number of levels of each factor, even"};

constexpr Param<std::int64_t> trajectories{.name = "trajectories",
                                           .low = 1,
                                           .high = 1'000'000'000,
                                           .optional = true,
                                           .unit = "trajectories",
                                           .help =
                                               "Number of trajectories of k + 1 runs each; gives "
                                               "the count. Default: 10, or from the count"};

constexpr Param<bool> radial{.name = "radial",
                             .help =
                                 "Stars instead of trajectories: a Sobol' point, then copies with "
                                 "one coordinate each from another Sobol' point; without levels"};

constexpr Param<bool> middles{.name = "middles",
                              .help =
                                  "Place levels at the middles of equal cells, for unbounded "
                                  "distributions; by default they range from 0 to just below 1"};

Plan plan(const Request& request, const Values& options) {
    if (options[levels] % 2 != 0)
        fail(ErrorKind::usage, "--levels: {} is odd; steps of half the levels need an even number",
             options[levels]);
    if (options[radial] && (options.given(levels) || options[middles]))
        fail(ErrorKind::usage, "--{}: the points of --radial have no levels",
             options.given(levels) ? levels.name : middles.name);
    const std::size_t k = request.dimension.value_or(2);
    const auto asked = static_cast<std::uint64_t>(options[trajectories]);
    const std::uint64_t runs = (options.given(trajectories) ? asked : 10) * (k + 1);
    if (options.given(trajectories))
        return plan_of_runs(request, runs, k, fmt::format("--trajectories {}", asked));
    const Plan plan = default_plan(request, runs, k);
    require_whole_blocks(plan, k + 1, "morris");
    return plan;
}

class Trajectory {
  public:
    Trajectory(std::uint64_t key, std::size_t dimension, std::uint64_t p)
        : levels_(p), low_(dimension), up_(dimension), order_(dimension) {
        SplitMix64 draws(key);
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        for (std::size_t i = dimension; i > 1; --i)
            std::swap(order_[i - 1], order_[draws.below(i)]);
        for (std::size_t k = 0; k < dimension; ++k) {
            low_[k] = draws.below(p / 2);
            up_[k] = draws.below(2) != 0;
        }
    }

    /// Moves to the other level of the next factor.
    void step() {
        const std::size_t k = order_[moved_++];
        up_[k] = !up_[k];
    }

    void write(std::span<double> row, bool ends, const LevelPlaces& places) const {
        for (std::size_t k = 0; k < row.size(); ++k)
            row[k] = places(k, level_place(low_[k] + (up_[k] ? levels_ / 2 : 0), levels_, ends));
    }

  private:
    std::uint64_t levels_;
    std::vector<std::uint64_t> low_;  ///< lower level of each factor
    std::vector<bool> up_;
    std::vector<std::size_t> order_;
    std::size_t moved_ = 0;
};

void fill(const Plan& plan, const LevelPlaces& places, std::uint64_t p, bool ends,
          std::uint64_t first, std::span<double> rows) {
    const std::size_t d = plan.dimension;
    const Rng keys(plan.seed, 0);
    while (!rows.empty()) {
        Trajectory trajectory(keys.bits(first / (d + 1)), d, p);
        for (std::size_t j = 0; j <= d && !rows.empty(); ++j) {
            if (j > 0) trajectory.step();
            if (j < first % (d + 1)) continue;  // the first trajectory may begin before `first`
            trajectory.write(rows.first(d), ends, places);
            rows = rows.subspan(d);
            if (j == d) first += d + 1 - first % (d + 1);
        }
    }
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    if (options[radial])
        return radial_sequence(
            {.dimension = plan.dimension, .runs = plan.dimension + 1, .ahead = 4}, usual_base,
            plan.seed, [](std::size_t j, std::span<const double> b, std::span<double> row) {
                if (j > 0) row[j - 1] = b[j - 1];
            });
    const auto p = static_cast<std::uint64_t>(options[levels]);
    const bool ends = !options[middles];
    return sequence_of(
        [plan, places = LevelPlaces(plan), p, ends](std::uint64_t first, std::span<double> rows) {
            fill(plan, places, p, ends, first, rows);
        });
}

}  // namespace

Generator unit() {
    return {
        .name = "morris",
        .summary = "Changes one factor at a time along random trajectories, for elementary effects",
        .source =
            "Morris 1991, doi:10.1080/00401706.1991.10484804; Campolongo, Saltelli, Cariboni "
            "2011, doi:10.1016/j.cpc.2010.12.039",
        .related = {"sensitivity", "elementary-effects", "screening", "oat", "one-at-a-time", "gsa",
                    "salib"},
        .traits = {.max_dimension = 10'600},
        .options = Schema(levels, trajectories, radial, middles),
        .stream_version = 2,
        .plan = plan,
        .sequence = make};
}

}  // namespace stipple::generators::morris
