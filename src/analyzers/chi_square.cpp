// SPDX-License-Identifier: MIT
//
// Pearson's chi-square test of uniformity on the domain that the points live on. The domain's
// measure-preserving coordinates take it to a unit cube, which is cut into K equal boxes, so that
// each cell has probability exactly 1 / K; cells with an expectation below 5 are pooled with their
// neighbours in order. Over the groups, with counts O_i and expectations E_i = n (cells) / K:
//
//     X^2 = sum_i (O_i - E_i)^2 / E_i,    degrees of freedom = groups - 1
//     p_upper = P(chi2 >= X^2),  p_lower = P(chi2 <= X^2),  p = min(1, 2 min(p_upper, p_lower))
//
// p < level with the upper tail the smaller one: non-uniform, the counts differ too much. With the
// lower tail: stratified, they differ less than those of random points do. Else: uniform.
//
// The default grid has the largest product of odd primes near 2 n^(2/5) (Mann and Wald's rate), at
// most n / 5, on as many of the first axes as take 3 cells each: odd primes, since strata are cut
// by 2 and 10, and cells that line up with strata tell nothing. Axes beyond are cut by --cells
// only.
//
// Smallest detectable effect: with cell probabilities p_i (1 + e_i), X^2 has the noncentral
// chi-square distribution with noncentrality n sum_i p_i e_i^2 (for large n). The effect is the
// root-mean-square e, sqrt(sum_i p_i e_i^2), at which the test says non-uniform with probability
// 0.9.
//
// Shape   points n x d on any domain; a report of numbers and the verdict.
// Cost    O(n d) time, O(K) memory besides the points; about 15 ns a point in 2-D on one core.
// Promise counts, and so all results, are the same for any number of threads. A coordinate of
//         exactly 1 belongs to the last cell.
// Beware  one set of low-discrepancy points is stratified, not random: its p is a description, not
//         a chance. The p of random points is approximate where expectations are small.
// Source  K. Pearson, Philosophical Magazine 50 (1900) 157-175, doi:10.1080/14786440009463897.
//         H. B. Mann, A. Wald, Annals of Mathematical Statistics 13 (1942) 306-317,
//         doi:10.1214/aoms/1177731569 (number of cells).

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <mutex>

#include "analyzers/analyzer.hpp"
#include "analyzers/outside.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

namespace stipple::analyzers {
namespace {

constexpr Param<Extents> cells{
    {.name = "cells",
     .fallback = {},
     .help = "Cells along each axis of the domain's cube, or one number for all; default: odd "
             "primes with a product near 2 n^(2/5)"}};

constexpr Param<double> level{.name = "level",
                              .fallback = 0.001,
                              .low = 0,
                              .high = 0.5,
                              .low_open = true,
                              .help = "Significance: a p-value below it decides the verdict"};

constexpr Param<Choice> expect{
    .name = "expect",
    .choices = "uniform|stratified",
    .help = "Fail (exit code 1) when the verdict is another; stratified points are not 'uniform'"};

using Grid = std::vector<std::size_t>;  ///< cells along each axis

constexpr std::uint64_t fewest = 5;  ///< expected points in a group
constexpr std::uint64_t most_cells = 100'000'000;

bool is_odd_prime(std::size_t m) {
    if (m < 3 || m % 2 == 0) return false;
    for (std::size_t q = 3; q * q <= m; q += 2)
        if (m % q == 0) return false;
    return true;
}

/// The odd prime nearest to x by ratio, and not above `cap`, which is at least 3.
std::size_t odd_prime_near(double x, std::size_t cap) {
    auto below = std::min(cap, std::max<std::size_t>(3, static_cast<std::size_t>(x)));
    while (!is_odd_prime(below)) --below;
    auto above = below + 1;
    while (!is_odd_prime(above)) ++above;
    const bool nearer = static_cast<double>(above) / x < x / static_cast<double>(below);
    return nearer && above <= cap ? above : below;
}

Grid default_grid(std::uint64_t n, std::size_t axes) {
    if (n < 3 * fewest)
        fail(ErrorKind::input,
             "chi-square needs at least {} points for its smallest grid, {} cells; these are {}",
             3 * fewest, 3, n);
    const std::size_t cap = n / fewest;
    const double target =
        std::min(2 * std::pow(static_cast<double>(n), 0.4), static_cast<double>(cap));
    std::size_t cut = 1;     // axes to cut
    std::size_t others = 1;  // 3^(cut - 1): room to leave for the axes that come later
    while (cut < axes && static_cast<double>(9 * others) <= target) {
        ++cut;
        others *= 3;
    }
    Grid grid(axes, 1);
    std::size_t product = 1;
    for (std::size_t k = 0; k < cut; ++k, others /= 3) {
        const double share =
            std::pow(target / static_cast<double>(product), 1 / static_cast<double>(cut - k));
        grid[k] = odd_prime_near(share, cap / (product * others));
        product *= grid[k];
    }
    return grid;
}

/// The grid that --cells asks for. @throws Error(usage)
Grid asked_grid(const std::vector<std::int64_t>& extents, const Domain& domain) {
    const std::size_t axes = domain.cube_dimension();
    if (extents.size() != 1 && extents.size() != axes)
        fail(ErrorKind::usage, "--cells: {} numbers for {} axes; one for all, or one for each",
             extents.size(), axes);
    Grid grid(axes);
    double product = 1;
    for (std::size_t k = 0; k < axes; ++k) {
        grid[k] = static_cast<std::size_t>(extents[extents.size() == 1 ? 0 : k]);
        product *= static_cast<double>(grid[k]);
    }
    if (product < 2 || product > static_cast<double>(most_cells))
        fail(ErrorKind::usage, "--cells: {:.6g} cells are outside [2, {}]", product, most_cells);
    return grid;
}

std::uint64_t cell_count(const Grid& grid) {
    std::uint64_t product = 1;
    for (const std::size_t m : grid) product *= m;
    return product;
}

/// What helps where points are outside the domain.
std::string hint_for(const Domain& domain) {
    std::string hint = "--domain names what the points live on";
    if (domain.spec() == "unit-cube")
        hint += "; --rescale or --bounds lo..hi moves them into the cube";
    return hint;
}

/// The cell of a point of the cube; `grid` has as many axes.
std::size_t cell_of(std::span<const double> cube, const Grid& grid) {
    std::size_t cell = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        if (grid[k] == 1) continue;
        const auto place = static_cast<std::size_t>(cube[k] * static_cast<double>(grid[k]));
        cell = cell * grid[k] + std::min(place, grid[k] - 1);
    }
    return cell;
}

/// Points in each cell. @throws Error(input) when a point is outside the domain.
std::vector<std::uint64_t> count_points(const PointSet& points, const Grid& grid,
                                        const RunContext& run) {
    const std::uint64_t total = cell_count(grid);
    run.need_memory(static_cast<double>(total) * sizeof(std::uint64_t), "the count of cells");
    std::vector<std::uint64_t> counts(total);
    Outside outside;
    std::mutex adding;
    const std::size_t block = std::max<std::size_t>(1, 16384 / points.dimension());
    for_each_block(run, points.count(), block, [&](const Block& b) {
        std::vector<double> cube(grid.size());
        std::vector<std::size_t> found;
        Outside lost;
        for (std::uint64_t i = b.first; i < b.last; ++i) {
            if (points.domain->contains(points[i])) {
                points.domain->to_cube(points[i], cube);
                found.push_back(cell_of(cube, grid));
            } else if (lost.count++ == 0) {
                lost.first = i;
            }
        }
        const std::lock_guard lock(adding);
        for (const std::size_t cell : found) ++counts[cell];
        outside.add(lost);
    });
    if (outside.count > 0) refuse(outside, points, hint_for(*points.domain));
    return counts;
}

struct Fit {
    double statistic = 0;
    std::uint64_t groups = 0;
    std::uint64_t pooled = 0;  ///< cells that were put together with others
};

/// Cells to a group so that its expectation is at least 5. @throws Error(input) if fewer than two
/// groups come of it.
std::uint64_t group_size(std::uint64_t n, std::uint64_t total) {
    const std::uint64_t size = (fewest * total + n - 1) / n;
    if (size > total / 2) {
        const std::uint64_t half = total / 2;
        fail(ErrorKind::input, "chi-square needs at least {} points for {} cells; these are {}",
             (fewest * total + half - 1) / half, total, n);
    }
    return size;
}

/// Groups of `size` neighbours; what is left over goes to the last group.
Fit fit(const std::vector<std::uint64_t>& counts, std::uint64_t n, std::uint64_t size,
        const RunContext& run) {
    using Wide = __int128;
    const std::uint64_t total = counts.size();
    Fit found{.groups = total / size, .pooled = size > 1 ? total : 0};
    for (std::uint64_t g = 0; g < found.groups; ++g) {
        if (g % 65536 == 0) run.check_stop();
        const std::uint64_t first = g * size;
        const std::uint64_t last = g + 1 < found.groups ? first + size : total;
        std::uint64_t observed = 0;
        for (std::uint64_t c = first; c < last; ++c) observed += counts[c];
        // K (O - E) and K n E are whole numbers.
        const auto scaled = static_cast<double>(static_cast<Wide>(observed) * total -
                                                static_cast<Wide>(last - first) * n);
        const double expected = static_cast<double>(n) *
                                (static_cast<double>(last - first) / static_cast<double>(total));
        const double off = scaled / static_cast<double>(total);
        found.statistic += off * off / expected;
    }
    return found;
}

using Quiet = boost::math::policies::policy<
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

/// The noncentrality at which the test says non-uniform with probability 0.9.
double detectable_noncentrality(double freedom, double threshold) {
    using namespace boost::math;
    const chi_squared_distribution<double, Quiet> null(freedom);
    const double critical = quantile(complement(null, threshold / 2));
    return non_central_chi_squared_distribution<double, Quiet>::find_non_centrality(freedom,
                                                                                    critical, 0.1);
}

/// Adds p-values and verdict for a statistic; complains when it is not what is expected.
void judge(Report& report, double statistic, double freedom, const Values& options) {
    const double upper = boost::math::gamma_q(freedom / 2, statistic / 2, Quiet());
    const double lower = boost::math::gamma_p(freedom / 2, statistic / 2, Quiet());
    const double p = std::min(1.0, 2 * std::min(upper, lower));
    const char* extreme = upper < lower ? "non-uniform" : "stratified";
    const std::string verdict = p < options[level] ? extreme : "uniform";
    report.add("p_value", p).add("p_upper", upper).add("p_lower", lower).add("verdict", verdict);
    const std::string wanted = options[expect];
    if (!wanted.empty() && wanted != verdict)
        report.unmet(fmt::format("expected {}, found {} (p = {:.3g})", wanted, verdict, p));
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Domain& domain = *points.domain;
    if (domain.dimension() != points.dimension())
        fail(ErrorKind::input, "points of the domain {} have dimension {}; these have {}",
             domain.spec(), domain.dimension(), points.dimension());
    const std::uint64_t n = points.count();
    const Grid grid = options.given(cells) ? asked_grid(options[cells], domain)
                                           : default_grid(n, domain.cube_dimension());
    const std::uint64_t size = group_size(n, cell_count(grid));
    const Fit found = fit(count_points(points, grid, run), n, size, run);
    const auto freedom = static_cast<double>(found.groups - 1);

    Report report;
    report.add("statistic", found.statistic).add("degrees_of_freedom", found.groups - 1);
    judge(report, found.statistic, freedom, options);
    report.add("cells", cell_count(grid)).add("pooled_cells", found.pooled);
    report.add(
        "smallest_detectable_effect",
        std::sqrt(detectable_noncentrality(freedom, options[level]) / static_cast<double>(n)));
    return report.add("grid", Report::Integers(grid.begin(), grid.end()));
}

/// Of several sets: the sum of their statistics has the sum of their degrees of freedom.
void refine(Report& mean, std::size_t sets, const Values& options) {
    const auto m = static_cast<double>(sets);
    const double freedom = mean.number("degrees_of_freedom");
    judge(mean, m * mean.number("statistic"), m * freedom, options);
    const double shrink = detectable_noncentrality(m * freedom, options[level]) / m /
                          detectable_noncentrality(freedom, options[level]);
    mean.add("smallest_detectable_effect",
             mean.number("smallest_detectable_effect") * std::sqrt(shrink));
}

}  // namespace

Analyzer chi_square() {
    return {
        .name = "chi-square",
        .summary = "Two-sided test of uniformity on the points' domain",
        .source = "Pearson 1900, doi:10.1080/14786440009463897",
        .traits = {.unit_cube = false},
        .options = Schema(cells, level, expect),
        .results = {{"statistic",
                     "sum of (observed - expected)^2 / expected over the groups of cells"},
                    {"degrees_of_freedom", "groups of cells less 1"},
                    {"p_value", "two-sided: twice the smaller of p_upper and p_lower, at most 1"},
                    {"p_upper", "chance that random points have as large a statistic"},
                    {"p_lower", "chance that random points have as small a statistic"},
                    {"verdict",
                     "uniform; non-uniform: counts differ too much; stratified: too little"},
                    {"cells", "cells laid out, of equal probability"},
                    {"pooled_cells", "cells put together with others to expect at least 5 points"},
                    {"smallest_detectable_effect",
                     "root-mean-square relative error of the cells' probabilities that is found "
                     "non-uniform with probability 0.9"},
                    {"grid", "cells along each axis of the domain's cube"}},
        .analyze = analyze,
        .refine = refine};
}

}  // namespace stipple::analyzers
