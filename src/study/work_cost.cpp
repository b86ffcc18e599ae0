// SPDX-License-Identifier: MIT
#include "study/work_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr std::array measures = {Growth{"chi-square", 5e-8, 1.0},
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

double cost_of_part(const Sweep& sweep, const Cell& cell, std::size_t part) {
    const std::size_t generators = sweep.generators().size();
    if (part < generators) return generate_cost(sweep, cell);
    return measure_cost(sweep, cell, part - generators);
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
    double seconds = seconds_of(measures, name, n, 1e-7 * n * d);
    if (d <= 2) return once + seconds;
    // What grows with the dimension: pairs of points, and searches that give up in the end.
    if (name == "l2-discrepancy") seconds = std::min(1e-10 * n * n * d, seconds * 20 * d);
    if (name == "star-discrepancy") seconds = std::min(100.0, 1e-8 * std::pow(n, 0.8 * d));
    if (name == "dispersion") seconds = 1e-8 * std::pow(n, d - 1);
    return once + seconds * d / 2;
}

WorkLeft::WorkLeft(const Sweep& sweep)
    : sweep_(sweep), parts_(sweep.generators().size() + sweep.measures().size()) {
    for (std::uint64_t c = 0; c < sweep.cells(); ++c) {
        const Cell cell = sweep.cell(c);
        const bool seeded = sweep.seeded(cell.generator);
        const double sets = seeded ? static_cast<double>(sweep.request().seeds) : 1;
        parts_[cell.generator].left += sets * generate_cost(sweep, cell);
        for (std::size_t m = 0; m < sweep.measures().size(); ++m)
            parts_[sweep.generators().size() + m].left += sets * measure_cost(sweep, cell, m);
    }
}

std::vector<double> WorkLeft::model(const std::vector<UnitRange>& ranges) const {
    std::vector<double> costs(parts_.size());
    const std::uint64_t measures_of_set = sweep_.measures().size();
    const std::uint64_t per_cell = sweep_.units_per_cell();
    for (const UnitRange& range : ranges)
        for (std::uint64_t first = range.first; first < range.last;) {
            const std::uint64_t last = std::min(range.last, (first / per_cell + 1) * per_cell);
            const Cell cell = sweep_.cell(first / per_cell);
            const double units = static_cast<double>(last - first);
            const double seeds =
                sweep_.seeded(cell.generator) ? 1 : static_cast<double>(sweep_.request().seeds);
            // Ranges that begin or end inside a set count for their share of it.
            const double sets = units / static_cast<double>(measures_of_set) / seeds;
            costs[cell.generator] += sets * cost_of_part(sweep_, cell, cell.generator);
            for (std::size_t part = sweep_.generators().size(); part < parts_.size(); ++part)
                costs[part] += sets * cost_of_part(sweep_, cell, part);
            first = last;
        }
    return costs;
}

void WorkLeft::forget(const std::vector<UnitRange>& ranges) {
    const auto costs = model(ranges);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].left = std::max(0.0, parts_[i].left - costs[i]);
}

void WorkLeft::finish(const std::vector<UnitRange>& ranges, const std::vector<double>& seconds) {
    if (ranges.empty() || seconds.empty()) return;
    const auto costs = model(ranges);
    const std::size_t generator = sweep_.cell(ranges[0].first / sweep_.units_per_cell()).generator;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].left = std::max(0.0, parts_[i].left - costs[i]);
        parts_[i].modelled += costs[i];
    }
    parts_[generator].spent += seconds[0];
    for (std::size_t m = 1; m < seconds.size(); ++m)
        parts_[sweep_.generators().size() + m - 1].spent += seconds[m];
}

double WorkLeft::seconds() const {
    double modelled = 0;
    double spent = 0;
    for (const Part& part : parts_) {
        modelled += part.modelled;
        spent += part.spent;
    }
    const double all = modelled > 0 ? spent / modelled : 1;
    double left = 0;
    for (const Part& part : parts_)
        left += part.left * (part.modelled > 0 ? part.spent / part.modelled : all);
    return left;
}

}  // namespace stipple
