// SPDX-License-Identifier: MIT
#include "study/work_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

namespace stipple {
namespace {

constexpr double once = 2e-5;  // what every set and every measure costs, however small

/// Seconds factor * n^power, in the plane.
struct Growth {
    std::string_view name;
    double factor;
    double power;
};

constexpr std::array slow_generators = {
    Growth{"best-candidate", 4e-7, 1.4},        Growth{"capacity-constrained", 2e-4, 1.05},
    Growth{"dart-throwing", 5e-5, 1.0},         Growth{"farthest-point", 1e-3, 1.0},
    Growth{"gaussian-blue-noise", 1.2e-3, 1.0}, Growth{"lloyd", 1.3e-4, 1.0},
    Growth{"poisson-disk", 1e-5, 1.0},          Growth{"sample-elimination", 1e-5, 1.0},
    Growth{"void-and-cluster", 4e-4, 1.0}};

constexpr std::array growths = {Growth{"chi-square", 5e-8, 1.0},
                                Growth{"coverage", 4e-6, 1.0},
                                Growth{"dispersion", 2e-6, 1.05},
                                Growth{"integration", 2e-7, 1.0},
                                Growth{"kolmogorov-smirnov", 1e-7, 1.0},
                                Growth{"l2-discrepancy", 5e-7, 1.0},
                                Growth{"moments", 3e-8, 1.0},
                                Growth{"nearest-neighbor", 4e-7, 1.0},
                                Growth{"pair-correlation", 4e-6, 1.0},
                                Growth{"periodogram", 3e-6, 1.0},
                                Growth{"poisson-disk", 4e-6, 1.0},
                                Growth{"serial", 1e-7, 1.0},
                                Growth{"star-discrepancy", 3e-8, 1.33},
                                Growth{"t-value", 1e-6, 1.0}};

template <std::size_t size>
double seconds_of(const std::array<Growth, size>& table, std::string_view name, double n,
                  double otherwise) {
    const auto it = std::ranges::find(table, name, &Growth::name);
    return it == table.end() ? otherwise : it->factor * std::pow(n, it->power);
}

/// Exact searches, of Halton's, Sobol's and random points in 3 to 20 dimensions.
double star_cost(double n, double d) {
    const double power = d <= 8 ? 1 + d / 4 : 2.2 + d / 10;
    return std::min(100.0, 5e-8 * std::pow(n, power));
}

}  // namespace

double generate_cost(const Sweep& sweep, const Cell& cell) {
    const auto& generator = *sweep.generators()[cell.generator].unit;
    const auto n = static_cast<double>(cell.count);
    const auto d = static_cast<double>(cell.dimension);
    const double harder = generator.traits.sequence ? 1 : std::pow(5.0, std::max(0.0, d - 2));
    return once + harder * seconds_of(slow_generators, generator.name, n, 3e-8 * n * d) +
           5e-8 * n * d * static_cast<double>(sweep.warps().size());
}

double measure_cost(const Sweep& sweep, const Cell& cell, std::size_t measure) {
    const std::string& name = sweep.measures()[measure].unit->name;
    const auto n = static_cast<double>(cell.count);
    const auto d = static_cast<double>(cell.dimension);
    double seconds = seconds_of(growths, name, n, 1e-7 * n * d);
    if (d <= 2) return once + seconds;
    // What grows with the dimension: pairs of points, and searches that give up in the end.
    if (name == "l2-discrepancy") seconds = std::min(1e-10 * n * n * d, seconds * 20 * d);
    if (name == "star-discrepancy") return once + star_cost(n, d);
    if (name == "dispersion") seconds = 1e-8 * std::pow(n, d - 1);
    return once + seconds * d / 2;
}

WorkLeft::WorkLeft(const Sweep& sweep)
    : sweep_(sweep),
      dimensions_(sweep.request().dimensions.size()),
      parts_((sweep.generators().size() + sweep.measures().size()) * dimensions_) {
    for (std::uint64_t c = 0; c < sweep.cells(); ++c) {
        const Cell cell = sweep.cell(c);
        const bool seeded = sweep.seeded(cell.generator);
        const double sets = seeded ? static_cast<double>(sweep.request().seeds) : 1;
        parts_[part(cell.generator, c)].left += sets * generate_cost(sweep, cell);
        for (std::size_t m = 0; m < sweep.measures().size(); ++m)
            parts_[part(sweep.generators().size() + m, c)].left +=
                sets * measure_cost(sweep, cell, m);
    }
}

std::size_t WorkLeft::part(std::size_t unit, std::uint64_t cell) const {
    const auto dimension = cell / sweep_.request().counts.size() % dimensions_;
    return unit * dimensions_ + static_cast<std::size_t>(dimension);
}

std::vector<double> WorkLeft::model(const std::vector<UnitRange>& ranges) const {
    std::vector<double> costs(parts_.size());
    const std::uint64_t measures_of_set = sweep_.measures().size();
    const std::uint64_t per_cell = sweep_.units_per_cell();
    for (const UnitRange& range : ranges)
        for (std::uint64_t first = range.first; first < range.last;) {
            const std::uint64_t last = std::min(range.last, (first / per_cell + 1) * per_cell);
            const std::uint64_t index = first / per_cell;
            const Cell cell = sweep_.cell(index);
            const double units = static_cast<double>(last - first);
            const double seeds =
                sweep_.seeded(cell.generator) ? 1 : static_cast<double>(sweep_.request().seeds);
            // Ranges that begin or end inside a set count for their share of it.
            const double sets = units / static_cast<double>(measures_of_set) / seeds;
            costs[part(cell.generator, index)] += sets * generate_cost(sweep_, cell);
            for (std::size_t m = 0; m < measures_of_set; ++m)
                costs[part(sweep_.generators().size() + m, index)] +=
                    sets * measure_cost(sweep_, cell, m);
            first = last;
        }
    return costs;
}

void WorkLeft::forget(const std::vector<UnitRange>& ranges) { take_out(model(ranges)); }

void WorkLeft::take_out(std::span<const double> costs) {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].left = std::max(0.0, parts_[i].left - costs[i]);
}

void WorkLeft::finish(const std::vector<UnitRange>& ranges, const std::vector<double>& seconds) {
    if (ranges.empty() || seconds.empty()) return;
    const auto costs = model(ranges);
    take_out(costs);
    const std::size_t generators = sweep_.generators().size() * dimensions_;
    spend(seconds[0], costs, 0, generators);
    for (std::size_t m = 1; m < seconds.size(); ++m)
        spend(seconds[m], costs, generators + (m - 1) * dimensions_, dimensions_);
}

void WorkLeft::spend(double seconds, std::span<const double> costs, std::size_t first,
                     std::size_t count) {
    const auto of_these = costs.subspan(first, count);
    const double all = std::accumulate(of_these.begin(), of_these.end(), 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        if (of_these[i] == 0) continue;
        parts_[first + i].modelled += of_these[i];
        parts_[first + i].spent += seconds * of_these[i] / all;
    }
}

double WorkLeft::seconds() const {
    Part all;
    for (const Part& part : parts_) all.add(part);
    double left = 0;
    for (std::size_t first = 0; first < parts_.size(); first += dimensions_) {
        const auto of_unit = std::span(parts_).subspan(first, dimensions_);
        Part unit;
        for (const Part& part : of_unit) unit.add(part);
        for (const Part& part : of_unit)
            left += part.left * part.correction(unit.correction(all.correction(1)));
    }
    return left;
}

}  // namespace stipple
