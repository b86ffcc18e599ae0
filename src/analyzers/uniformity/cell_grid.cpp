// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers {
namespace {

/// Odd prime nearest to x by ratio, at most `cap`, which is at least 3.
std::size_t odd_prime_near(double x, std::size_t cap) {
    auto below = std::min(cap, std::max<std::size_t>(3, static_cast<std::size_t>(x)));
    while (!is_prime(below)) --below;
    const std::size_t above = next_prime(below + 1);
    const bool nearer = static_cast<double>(above) / x < x / static_cast<double>(below);
    return nearer && above <= cap ? above : below;
}

/// Number of points that selects the default grid: n or, for large sets, n rounded down.
std::uint64_t rounded_count(std::uint64_t n) {
    std::uint64_t rounded = n;
    for (const std::uint64_t count : grid_counts)
        if (count <= n) rounded = count;
    return rounded;
}

/// Interval of an axis.
struct Stretch {
    double low;
    double high;
};

/// Intervals that form cell `place` of an axis with m cells: two for the first cell if shifted.
std::vector<Stretch> stretches(std::size_t place, std::size_t m, bool shifted) {
    const auto cells = static_cast<double>(m);
    const auto first = static_cast<double>(place);
    if (m == 1) return {{0, 1}};
    if (!shifted) return {{first / cells, (first + 1) / cells}};
    if (place > 0) return {{(first - 0.5) / cells, (first + 0.5) / cells}};
    return {{0, 0.5 / cells}, {(cells - 0.5) / cells, 1}};
}

/// Boxes that make up a cell: more than one if a shifted cell wraps around.
std::vector<Box> pieces_of(std::size_t cell, const CellGrid& grid, bool shifted) {
    const std::size_t axes = grid.size();
    std::vector<Box> pieces{{std::vector<double>(axes), std::vector<double>(axes)}};
    for (std::size_t k = axes; k-- > 0; cell /= grid[k]) {
        const auto parts = stretches(cell % grid[k], grid[k], shifted);
        const std::size_t before = pieces.size();
        for (std::size_t part = 1; part < parts.size(); ++part)
            for (std::size_t i = 0; i < before; ++i) pieces.push_back(Box(pieces[i]));
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pieces[i].low[k] = parts[i / before].low;
            pieces[i].high[k] = parts[i / before].high;
        }
    }
    return pieces;
}

Estimate mass_of(const Domain& domain, const std::vector<Box>& pieces) {
    Estimate mass;
    for (const Box& piece : pieces) {
        const Estimate part = domain.probability(piece);
        if (!(part.value >= -part.error) || !(part.error >= 0) || !(part.value <= 1 + part.error))
            fail(ErrorKind::limit, "{}: the cell {} has the impossible probability {} within {}",
                 domain.title(), format_box(piece), part.value, part.error);
        mass += {std::max(part.value, 0.0), part.error};
    }
    return mass;
}

}  // namespace

CellGrid default_grid(std::uint64_t n, std::size_t axes) {
    if (n < 3 * fewest_expected)
        fail(ErrorKind::input,
             "chi-square needs at least {} points for its smallest grid, {} cells; these are {}",
             3 * fewest_expected, 3, n);
    const std::uint64_t count = rounded_count(n);
    const std::size_t cap = count / fewest_expected;
    const double target =
        std::min(2 * real_power(static_cast<double>(count), 0.4), static_cast<double>(cap));
    std::size_t cut = 1;     // number of axes to cut
    std::size_t others = 1;  // 3^(cut - 1): fewest cells on the other axes to cut
    while (cut < std::min(axes, most_cut_axes) && static_cast<double>(9 * others) <= target) {
        ++cut;
        others *= 3;
    }
    CellGrid grid(axes, 1);
    std::size_t product = 1;
    for (std::size_t k = 0; k < cut; ++k, others /= 3) {
        const double share =
            real_power(target / static_cast<double>(product), 1 / static_cast<double>(cut - k));
        grid[k] = odd_prime_near(share, cap / (product * others));
        product *= grid[k];
    }
    return grid;
}

CellGrid asked_grid(const std::vector<std::int64_t>& extents, std::size_t axes) {
    if (extents.size() != 1 && extents.size() != axes)
        fail(ErrorKind::usage,
             "--cells: {} numbers for {} axes; expected one for all, or one for each",
             extents.size(), axes);
    CellGrid grid(axes);
    double product = 1;
    for (std::size_t k = 0; k < axes; ++k) {
        grid[k] = static_cast<std::size_t>(extents[extents.size() == 1 ? 0 : k]);
        product *= static_cast<double>(grid[k]);
    }
    if (product < 2 || product > static_cast<double>(most_cells))
        fail(ErrorKind::usage, "--cells: the number of cells, {:.6g}, is outside [2, {}]", product,
             most_cells);
    return grid;
}

std::uint64_t cell_count(const CellGrid& grid) {
    std::uint64_t product = 1;
    for (const std::size_t m : grid) product *= m;
    return product;
}

std::size_t cell_of(std::span<const double> cube, const CellGrid& grid, bool shifted) {
    std::size_t cell = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        if (grid[k] == 1) continue;
        const double place = cube[k] * static_cast<double>(grid[k]) + (shifted ? 0.5 : 0.0);
        const auto at = static_cast<std::size_t>(place);
        cell = cell * grid[k] + (at < grid[k] ? at : shifted ? 0 : grid[k] - 1);
    }
    return cell;
}

std::vector<Estimate> cell_masses(const Domain& domain, const CellGrid& grid, bool shifted,
                                  const RunContext& run) {
    std::vector<Estimate> masses(cell_count(grid));
    for_each_block(silent(run), masses.size(), 4, [&](const Block& block) {
        for (std::uint64_t c = block.first; c < block.last; ++c)
            masses[c] = mass_of(domain, pieces_of(c, grid, shifted));
    });
    Estimate sum;
    for (const Estimate& mass : masses) sum += mass;
    // Each probability also has a rounding error, which its `error` does not include.
    const double rounding =
        std::numeric_limits<double>::epsilon() * (64 + 4 * static_cast<double>(masses.size()));
    if (std::abs(sum.value - 1) > sum.error + rounding)
        fail(ErrorKind::limit,
             "{}: the probabilities of its {} cells sum to {}; expected 1 within their error {}",
             domain.title(), masses.size(), sum.value, sum.error);
    return masses;
}

}  // namespace stipple::analyzers
