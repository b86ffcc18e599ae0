// SPDX-License-Identifier: MIT
//
// Upper bound of the star discrepancy from counts at the corners of a coarse grid. If lo <= c <= hi
// are the corners of the cell that contains c,
//
//     vol(c) - #{x < c} / n <= vol(hi) - #{x <= lo} / n,
//     #{x <= c} / n - vol(c) <= #{x <= hi} / n - vol(lo).
//
// So the worst cell bounds the discrepancy, and exceeds it by at most delta = max (vol(hi) -
// vol(lo)). The grid is finer towards 1, where volumes change most:
//
//     1,  x_0 = (1 - delta)^(1/d),  x_(i+1) = (x_i - delta) x_0^(1 - d),  ...,  0.
//
// Shape   any n; about (d / (d - 1) ln(d) / delta)^d corners: useful only in few dimensions.
// Cost    O(n d + corners d); 4 bytes per corner.
// Promise a proven bound, including rounding errors. Does not depend on the number of threads.
// Source  B. Doerr, M. Gnewuch, A. Srivastav, J. Complexity 21 (2005) 691-709 (delta-covers).

#include "math/discrepancy/star/search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::discrepancy::star {
namespace {

/// Values of the grid on each axis, increasing from 0 to 1.
std::vector<double> cuts_for(double delta, double dimension) {
    std::vector<double> cuts{1};
    const double first = exponential(logarithm(1 - delta) / dimension);
    const double stretch = exponential(logarithm(first) * (1 - dimension));
    for (double x = first; x > 0; x = (x - delta) * stretch) cuts.push_back(x);
    cuts.push_back(0);
    std::ranges::reverse(cuts);
    return cuts;
}

/// Finest grid with at most `most_corners` corners; empty if it would have no inner ones.
std::vector<double> finest_cuts(std::size_t dimension, double most_corners) {
    const auto d = static_cast<double>(dimension);
    const double most = std::floor(exponential(logarithm(most_corners) / d) + 1e-9);
    if (most < 6) return {};  // delta would be above 1/2
    double coarse = 1 - 1e-9;
    double fine = 1e-7;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(coarse * fine);
        const double corners = static_cast<double>(cuts_for(middle, d).size());
        (corners > most ? fine : coarse) = middle;
    }
    auto cuts = cuts_for(coarse, d);
    if (static_cast<double>(cuts.size()) > most) cuts.clear();
    return cuts;
}

/// Number of points with coordinates up to each corner; the last axis is the fastest index.
std::vector<std::uint32_t> corner_counts(const BoxGrid& grid, const std::vector<double>& cuts,
                                         const RunContext& run) {
    const std::size_t side = cuts.size();
    std::size_t corners = 1;
    std::vector<std::uint32_t> corner_of(grid.count);
    for (std::size_t k = 0; k < grid.dimension(); ++k, corners *= side) {
        run.check_stop();
        std::vector<std::uint32_t> above;  // index of the first cut not below each value
        std::uint32_t at = 0;
        for (const double x : grid.values[k]) {
            while (cuts[at] < x) ++at;
            above.push_back(at);
        }
        for (std::size_t i = 0; i < grid.count; ++i)
            corner_of[i] =
                corner_of[i] * static_cast<std::uint32_t>(side) + above[grid.ranks[k][i]];
    }
    std::vector<std::uint32_t> counts(corners);
    for (const std::uint32_t corner : corner_of) ++counts[corner];
    for (std::size_t stride = 1; stride < corners; stride *= side)
        for (std::size_t first = 0; first < corners; first += stride * side) {
            if (first % (std::size_t{1} << 20) < stride * side) run.check_stop();
            std::uint32_t* at = counts.data() + first;
            for (std::size_t i = stride; i < stride * side; ++i) at[i] += at[i - stride];
        }
    return counts;
}

/// Bound of the worst cell, by lines of cells along the last axis.
double worst_cell(const BoxGrid& grid, const std::vector<double>& cuts, const RunContext& run) {
    const auto counts = corner_counts(grid, cuts, run);
    const auto points = static_cast<double>(grid.count);
    const std::size_t side = cuts.size();
    std::size_t across = 1;  // index difference between the upper and lower corner of a cell
    for (std::size_t k = 1; k < grid.dimension(); ++k) across = across * side + 1;
    double worst = 0;
    for (std::size_t line = 0; line * side + across < counts.size(); ++line) {
        if (line % 65536 == 0) run.check_stop();
        double low = 1;  // volumes of the corners on all axes except the last
        double high = 1;
        std::size_t rest = line;
        for (std::size_t k = 1; k < grid.dimension(); ++k, rest /= side) {
            const std::size_t at = rest % side;
            low *= cuts[at];
            high *= at + 1 < side ? cuts[at + 1] : 0;
        }
        if (high == 0) continue;  // no cells begin at 1
        const std::uint32_t* below = &counts[line * side];
        const std::uint32_t* within = below + across;
        for (std::size_t i = 0; i + 1 < side; ++i) {
            const double open = high * cuts[i + 1] - below[i] / points;
            const double closed = within[i] / points - low * cuts[i];
            worst = std::max(worst, std::max(open, closed));
        }
    }
    return worst;
}

}  // namespace

double cover_bound(const BoxGrid& grid, std::uint64_t most_corners, const RunContext& run) {
    const std::size_t d = grid.dimension();
    const auto cuts = finest_cuts(d, std::min(static_cast<double>(most_corners), 0x1p31));
    if (cuts.empty()) return 1;
    const double worst = worst_cell(grid, cuts, run);
    const double rounding = 4e-16 * static_cast<double>(d + 2);
    return std::min(1.0, worst + rounding);
}

}  // namespace stipple::discrepancy::star
