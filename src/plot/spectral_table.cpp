// SPDX-License-Identifier: MIT
#include "plot/spectral_table.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::plot {
namespace {

constexpr std::size_t least_side = 9;  ///< smaller tables may be points

/// Whether the middle number can be the power at frequency zero, (sum of w)^2 / (sum of w^2), which
/// is at least 1 and no less than any other power; a set of one point has the power 1 everywhere.
bool is_power(std::span<const double> v) {
    constexpr double rounding = 1e-6;
    const double centre = v[v.size() / 2];
    const auto [low, high] = std::ranges::minmax(v);
    if (centre < 1 - rounding || high > centre * (1 + rounding)) return false;
    return centre > 1 + rounding || low > 1 - rounding;
}

bool is_side(std::size_t side) { return side % 2 == 1 && side >= least_side; }

/// Whether the numbers are those of a table about its middle.
bool is_symmetric(std::span<const double> v) {
    for (std::size_t i = 0; i < v.size() / 2; ++i) {
        const double other = v[v.size() - 1 - i];
        if (!(v[i] >= 0) || std::abs(v[i] - other) > 1e-6 * (1 + v[i])) return false;
    }
    return true;
}

bool is_spectrum(std::span<const double> v) { return is_symmetric(v) && is_power(v); }

/// The numbers of planes that are as many as their sides, one after the other; else none.
std::vector<double> cube_of(std::span<const PointSet* const> sets) {
    std::vector<double> values;
    for (const PointSet* plane : sets) {
        if (plane->dimension() != sets.size() || plane->count() != sets.size()) return {};
        values.insert(values.end(), plane->flat().begin(), plane->flat().end());
    }
    return values;
}

Grid grid_of(const PointSet& table, std::size_t rows) {
    const auto values = table.flat();
    return {
        .rows = rows, .columns = values.size() / rows, .values = {values.begin(), values.end()}};
}

/// Whether it can be the density of pair differences: none at zero.
bool looks_like_differences(const Grid& grid) {
    return grid.rows == grid.columns && is_side(grid.rows) && is_symmetric(grid.values) &&
           grid.values[grid.values.size() / 2] == 0 && std::ranges::max(grid.values) > 0;
}

}  // namespace

bool looks_like_power(const Grid& grid) {
    return grid.rows == grid.columns && is_side(grid.rows) && is_spectrum(grid.values);
}

std::optional<SpectralTable> spectral_table(std::span<const PointSet* const> sets) {
    const PointSet& first = *sets[0];
    if (!first.provenance.generator.empty()) return std::nullopt;
    if (sets.size() > 1) {
        const auto values = cube_of(sets);
        if (values.empty() || !is_side(sets.size()) || !is_spectrum(values)) return std::nullopt;
        return SpectralTable{.dimension = 3,
                             .values = grid_of(*sets[sets.size() / 2], sets.size())};
    }
    if (first.dimension() == 1) {
        if (!is_side(first.count()) || !is_spectrum(first.flat())) return std::nullopt;
        return SpectralTable{.dimension = 1, .values = grid_of(first, 1)};
    }
    Grid grid = grid_of(first, first.count());
    const bool differences = looks_like_differences(grid);
    if (!differences && !looks_like_power(grid)) return std::nullopt;
    return SpectralTable{.differences = differences, .values = std::move(grid)};
}

Chart power_chart(const Grid& power, const std::string& title) {
    const std::size_t middle = power.values.size() / 2;
    Series curve{.name = "power"};
    for (std::size_t f = 1; f <= middle; ++f) {
        curve.x.push_back(static_cast<double>(f));
        curve.y.push_back(power.values[middle + f]);
    }
    ChartPanel panel{.x_name = "frequency",
                     .y_name = "power",
                     .whole_x = true,
                     .from_zero = true,
                     .reach_y = 1.4,
                     .least_y = 1e-4};
    // As in the chart of radial power: a lattice's peaks would hide everything else.
    panel.log_y = std::ranges::max(curve.y) > 12;
    panel.guides.push_back({.name = "white noise", .y = {1}});
    panel.series.push_back(std::move(curve));
    return {.title = title, .panels = {std::move(panel)}};
}

}  // namespace stipple::plot
