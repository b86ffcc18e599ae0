// SPDX-License-Identifier: MIT
//
// Jittered (stratified) points: one in each of n cells of equal volume, uniform in it.
//
//     d = 1    n intervals
//     d = 2    R = round(sqrt(n)) rows. Row r has the cells s_r, ..., s_{r+1} - 1, where
//              s_r = floor(r n / R), side by side and equally wide; it reaches from y = s_r / n to
//              s_{r+1} / n. So all cells have the area 1 / n, and for n = k^2 they are the k x k
//              grid.
//     d > 2    k^d = n cubes, the first coordinate fastest; or, for any d, a shape of
//              k_1 x ... x k_d = n boxes in the same order
//
// Cost    O(n d); point i is found without the others.
// Promise point i is in cell i, half-open, in exact arithmetic (math/digital/stratum.hpp).
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927.

#include <algorithm>
#include <numeric>

#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "generators/stratified/stratified.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/digital/stratum.hpp"
#include "math/functions/powers.hpp"
#include "math/geometry/lattice.hpp"

namespace stipple::generators::jittered {
namespace {

constexpr Param<Extents> shape{
    {.name = "shape",
     .unit = "cells",
     .help = "Number of cells in each direction, such as 40x25; gives count and dimension"}};
constexpr Param<Choice> cell{.name = "cell",
                             .fallback = "random",
                             .choices = "random|center",
                             .help = "Position of a point in its cell"};

/// Moves coordinates from [0, 1) into their cells, or to the middles of the cells.
void place(bool centered, const Strata& strata, double* x, std::size_t stride) {
    centered ? place_in_middles(strata, x, stride) : place_in_strata(strata, x, stride);
}

/// Puts points first, first + 1, ... of n into rows of cells in the plane.
void place_in_rows(std::uint64_t n, bool centered, std::uint64_t first, std::span<double> rows) {
    const std::uint64_t row_count = rounded_root(n);
    const auto row_begin = [&](std::uint64_t row) {
        return static_cast<std::uint64_t>(Wide{row} * n / row_count);
    };
    // Row of point `first`: the largest r with floor(r n / row_count) <= first.
    auto row = static_cast<std::uint64_t>((Wide{first + 1} * row_count - 1) / n);
    std::vector<double> low;
    for (std::size_t offset = 0; offset < rows.size(); ++row) {
        const std::uint64_t begin = row_begin(row);
        const std::uint64_t cells = row_begin(row + 1) - begin;
        const std::uint64_t column = first - begin;
        low.resize(std::min<std::size_t>((rows.size() - offset) / 2, cells - column));
        std::iota(low.begin(), low.end(), static_cast<double>(column));
        place(centered, {.low = low, .parts = cells}, rows.data() + offset, 2);
        std::ranges::fill(low, static_cast<double>(begin));
        place(centered, {.low = low, .width = cells, .parts = n}, rows.data() + offset + 1, 2);
        first += low.size();
        offset += 2 * low.size();
    }
}

/// Puts points first, first + 1, ... into boxes; sides[k] is the number of boxes along axis k.
void place_in_boxes(std::span<const std::uint64_t> sides, bool centered, std::uint64_t first,
                    std::span<double> rows) {
    const std::size_t d = sides.size();
    // Number of points in a block, whose low edges are stored axis after axis.
    const std::size_t most = std::min(1 + 4096 / d, rows.size() / d);
    std::vector<double> low(most * d);
    for (std::size_t done = 0; done < rows.size() / d; done += most) {
        const std::size_t count = std::min(most, rows.size() / d - done);
        for_each_lattice_row(sides, first + done, count,
                             [&](auto start, std::size_t offset, std::size_t length) {
                                 for (std::size_t k = 0; k < d; ++k)
                                     for (std::size_t i = 0; i < length; ++i)
                                         low[k * most + offset + i] =
                                             static_cast<double>(start[k] + (k == 0 ? i : 0));
                             });
        for (std::size_t k = 0; k < d; ++k)
            place(centered, {.low = std::span(low).subspan(k * most, count), .parts = sides[k]},
                  rows.data() + done * d + k, d);
    }
}

Plan plan(const Request& request, const Values& options) {
    if (options.given(shape)) return plan_of_shape(request, options[shape], "cells");
    if (request.dimension.value_or(2) == 2) return default_plan(request);
    return plan_of_cubes(request, "jittered");
}

/// Number of cells along each axis; empty for rows of cells in the plane.
std::vector<std::uint64_t> grid_of(const Plan& plan, const Values& options) {
    if (plan.dimension == 2 && !options.given(shape)) return {};
    return sides_of(plan, options[shape], "jittered");
}

/// The number of rows, or the numbers of cells along the axes.
std::vector<Constants> constants(const Plan& plan, const Values& options, const RunContext&) {
    const auto sides = grid_of(plan, options);
    if (sides.empty()) return {{"rows", {rounded_root(plan.count)}, true}};
    return {{"sides", sides, true}};
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const bool centered = options[cell] == "center";
    const auto sides = grid_of(plan, options);
    const bool in_rows = sides.empty();
    return sequence_of([=, d = plan.dimension, n = plan.count, rng = Rng(plan.seed)](
                           std::uint64_t first, std::span<double> rows) {
        if (!centered) rng.fill(first * d, rows);
        in_rows ? place_in_rows(n, centered, first, rows)
                : place_in_boxes(sides, centered, first, rows);
    });
}

}  // namespace

Generator unit() {
    return {.name = "jittered",
            .summary = "Jittered points: one at random in each of n cells of equal volume",
            .source = "Cook 1986, doi:10.1145/7529.8927",
            .related = {"jitter", "jittered-grid"},
            .traits = {.prefix = false},
            .options = Schema(shape, cell),
            .aliases = {"stratified"},
            .plan = plan,
            .sequence = make,
            .constants = constants};
}

}  // namespace stipple::generators::jittered
