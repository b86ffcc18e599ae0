// SPDX-License-Identifier: MIT
//
// Full factorial design: every combination of the factors' levels once, in standard order: the
// first factor changes fastest. levels.hpp defines the coordinates of levels.
//
// Shape   n = m_1 m_2 ... m_k runs, up to 2^53. Without --levels, a given count must be m^k.
//         With neither, a factor has 2 levels, or one per outcome of a parameter with up to 10.
// Source  D. C. Montgomery, "Design and Analysis of Experiments", Wiley, chapter 5.

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "experiments/designs/levels.hpp"
#include "math/functions/powers.hpp"
#include "math/geometry/lattice.hpp"

namespace stipple::generators::factorial {
namespace {

constexpr Param<Numbers> levels{
    {.name = "levels",
     .unit = "levels",
     .help = "Number of levels of all factors (3) or of each (2,3,4); gives the count and the "
             "dimension. Default: 2, or the k-th root of the count; for parameters with up to 10 "
             "outcomes, one per outcome"}};

/// Number of levels of each factor. @throws Error(usage)
std::vector<std::uint64_t> levels_of(const std::vector<double>& given, std::size_t dimension) {
    std::vector<std::uint64_t> sizes;
    for (const double m : given) {
        if (!(m >= 1 && m <= 0x1p53 && m == std::floor(m)))
            fail(ErrorKind::usage, "--levels: {} is not a whole number from 1 to 2^53",
                 format_number(m));
        sizes.push_back(static_cast<std::uint64_t>(m));
    }
    if (sizes.size() == 1) sizes.resize(dimension, sizes[0]);
    if (sizes.size() != dimension)
        fail(ErrorKind::usage, "--dimension: {} contradicts --levels {}, for {} factors", dimension,
             format_value(Value(given)), sizes.size());
    return sizes;
}

Plan plan(const Request& request, const Values& options) {
    const std::vector<double> given = options[levels];
    if (!options.given(levels)) {
        const std::size_t d = request.dimension.value_or(2);
        const Plan plan = default_plan(request, saturating_power(2, d), d);
        exact_root(plan.count, d, "factorial without --levels");
        return plan;
    }
    const std::size_t d = request.dimension.value_or(given.size() == 1 ? 2 : given.size());
    std::uint64_t runs = 1;
    for (const std::uint64_t m : levels_of(given, d))
        if (__builtin_mul_overflow(runs, m, &runs)) runs = ~std::uint64_t{0};
    return plan_of_runs(request, runs, d, "--levels " + format_value(Value(given)));
}

/// Checks that a factor has at most as many levels as outcomes, or a multiple. @throws Error(usage)
void check_outcomes(const std::vector<std::uint64_t>& sizes, const LevelPlaces& places) {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const std::uint64_t outcomes = places.outcomes(k);
        if (outcomes == 0 || sizes[k] <= outcomes || sizes[k] % outcomes == 0) continue;
        fail(ErrorKind::usage,
             "--levels: {} levels of parameter {} would give some of its {} outcomes more often "
             "than others; expected at most {} levels, or a multiple",
             sizes[k], k + 1, outcomes, outcomes);
    }
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const auto sizes =
        options.given(levels)
            ? levels_of(options[levels], plan.dimension)
            : std::vector(plan.dimension, exact_root(plan.count, plan.dimension, "factorial"));
    const bool ends = options[ends_option];
    const LevelPlaces places(plan);
    check_outcomes(sizes, places);
    const auto place = [sizes, ends, places](std::size_t k, std::uint64_t level) {
        return places(k, level_place(level, sizes[k], ends));
    };
    auto points = sequence_of([sizes, place](std::uint64_t first, std::span<double> rows) {
        const std::size_t d = sizes.size();
        for_each_lattice_row(sizes, first, rows.size() / d,
                             [&](auto cell, std::size_t offset, std::size_t length) {
                                 double* x = rows.data() + offset * d;
                                 for (std::size_t k = 1; k < d; ++k) x[k] = place(k, cell[k]);
                                 for (std::size_t j = 0; j < length; ++j) {
                                     std::copy_n(x + 1, d - 1, x + j * d + 1);
                                     x[j * d] = place(0, cell[0] + j);
                                 }
                             });
    });
    std::vector<std::string> ranges;
    for (const std::uint64_t m : sizes) ranges.push_back(coded_range(m, ends));
    if (std::ranges::count(ranges, ranges[0]) == std::ssize(ranges)) ranges.resize(1);
    points->set_found([ranges] { return Findings{{"coded_bounds", join(ranges, ",")}}; });
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "factorial",
            .summary = "Full factorial design: every combination of the factors' levels",
            .source = "Montgomery, Design and Analysis of Experiments, chapter 5",
            .related = {"doe", "experiment", "expand-grid", "fullfact", "ff2n", "levels"},
            .traits = {.prefix = false, .seeded = false, .levels = true},
            .options = Schema(levels, ends_option),
            .aliases = {"full-factorial"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::factorial
