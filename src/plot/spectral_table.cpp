// SPDX-License-Identifier: MIT
#include "plot/spectral_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "plot/report_charts.hpp"
#include "report/grid_files.hpp"

namespace stipple::plot {
namespace {

constexpr std::size_t least_side = 9;  ///< smaller tables are taken for points

/// Whether the middle number can be the power at frequency zero, (sum of w)^2 / (sum of w^2) for
/// weights w: at least 1, and the largest power. Power 1 is allowed only if all powers are 1, as
/// for a single point.
bool is_power(std::span<const double> v) {
    constexpr double rounding = 1e-6;
    const double centre = v[v.size() / 2];
    const auto [low, high] = std::ranges::minmax(v);
    if (centre < 1 - rounding || high > centre * (1 + rounding)) return false;
    return centre > 1 + rounding || low > 1 - rounding;
}

bool is_side(std::size_t side) { return side % 2 == 1 && side >= least_side; }

/// Whether the numbers are symmetric about the middle of the list, and not negative.
bool is_symmetric(std::span<const double> v) {
    for (std::size_t i = 0; i < v.size() / 2; ++i) {
        const double other = v[v.size() - 1 - i];
        if (!(v[i] >= 0) || std::abs(v[i] - other) > 1e-6 * (1 + v[i])) return false;
    }
    return true;
}

bool is_spectrum(std::span<const double> v) { return is_symmetric(v) && is_power(v); }

/// Concatenates n planes of n x n numbers, each given as a set, into a cube; empty if any set has
/// another size.
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

Colour grey(double shade) {
    const auto level = static_cast<std::uint8_t>(std::lround(255 * shade));
    return {level, level, level};
}

PixelImage picture_of(const Grid& power, const Area& area) {
    PixelImage raster{.area = area, .columns = power.columns, .rows = power.rows};
    raster.pixels.reserve(power.values.size());
    for (std::size_t row = power.rows; row-- > 0;)
        for (std::size_t column = 0; column < power.columns; ++column) {
            const bool centre = row == power.rows / 2 && column == power.columns / 2;
            const double shade = shade_of_power(power.values[row * power.columns + column]);
            raster.pixels.push_back(centre ? Colour{} : grey(shade));
        }
    return raster;
}

}  // namespace

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
    if (first.dimension() != first.count() || !is_side(first.count()) ||
        !is_symmetric(first.flat()))
        return std::nullopt;
    Grid grid = grid_of(first, first.count());
    // A table of pair differences is 0 in the middle, a power spectrum is not.
    const bool differences =
        grid.values[grid.values.size() / 2] == 0 && std::ranges::max(grid.values) > 0;
    if (!differences && !is_power(grid.values)) return std::nullopt;
    return SpectralTable{.differences = differences, .values = std::move(grid)};
}

Drawing draw_spectrum(const Grid& power, const std::string& title, const std::string& subtitle,
                      const PictureStyle& style, const TableNames& names) {
    if (power.rows != power.columns || power.rows % 2 == 0)
        fail(ErrorKind::input,
             "this table has {} x {} numbers; expected a spectrum, (2F + 1) x (2F + 1)", power.rows,
             power.columns);
    if (std::ranges::any_of(power.values, [](double p) { return !(p >= 0); }))
        fail(ErrorKind::input,
             "this table has a negative or undefined power; expected powers from 0");
    const Theme& theme = *style.theme;
    const double last = (static_cast<double>(power.rows / 2) + 0.5) * names.cell;
    const bool whole = names.cell == 1;
    const Axis x{.low = -last, .high = last, .whole = whole, .name = names.x};
    const Axis y{.low = -last, .high = last, .whole = whole, .name = names.y};
    auto [drawing, frame] =
        square_drawing(titled_drawing(title, subtitle, style, 640), {}, x, y, names.bar, style);
    drawing.add(picture_of(power, frame));
    Panel(frame, x, y).draw_axes(drawing, theme, true);
    if (names.bar)
        draw_colour_bar(drawing, bar_beside(frame), names.shade, theme, grey,
                        {{0, "0"}, {0.2, "1/4"}, {0.5, "1"}, {0.8, "4"}, {1, "∞"}});
    return std::move(drawing);
}

Chart power_chart(const Grid& power, const std::string& title) {
    const std::size_t last = power.values.size() / 2;
    Report::Curve frequencies(last);
    std::iota(frequencies.begin(), frequencies.end(), 1);
    Report radial;
    radial.add("frequency", frequencies);
    radial.add("power",
               Report::Curve(power.values.end() - std::ssize(frequencies), power.values.end()));
    radial.add("cells", Report::Integers(last, 2));  // the frequencies f and -f
    const auto by_frequency = std::ranges::find_if(analyzers::all(), [](const Analyzer& analyzer) {
        return !analyzer.curves.empty() && analyzer.curves[0].key == "radial.power";
    });
    Measurement found{.analyzer = by_frequency->name, .source = "-", .dimension = 1, .domain = {}};
    found.results.add("radial", std::move(radial));
    Chart chart = chart_of({&found, 1});
    chart.title = title;
    chart.subtitle = {};
    chart.panels[0].y_name = "power";
    chart.panels[0].whole_x = true;
    return chart;
}

}  // namespace stipple::plot
