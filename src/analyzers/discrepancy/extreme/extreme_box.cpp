// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/extreme/extreme_box.hpp"

#include <algorithm>
#include <bit>

#include "analyzers/discrepancy/axis_places.hpp"

namespace stipple::analyzers::extreme {
namespace {

/// Sorts one axis: its distinct values, and the place of every point.
void index_axis(const PointSet& points, std::size_t axis, BoxGrid& grid, const RunContext& run) {
    const bool torus = grid.space == Space::torus;
    std::vector<Placed> items(points.count());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const double x = points[i][axis] + 0.0;  // -0 becomes 0
        items[i] = {torus && x == 1 ? 0.0 : x, static_cast<std::uint32_t>(i)};
    }
    auto& values = grid.values[axis];
    if (!torus) values.push_back(0);
    grid.ranks[axis] = places_on_axis(items, values, run);
    grid.order[axis].reserve(items.size());
    for (const Placed& item : items) grid.order[axis].push_back(item.place);
    if (!torus && values.back() != 1) values.push_back(1);
    for (const double x : values) grid.places[axis] = std::max(grid.places[axis], dyadic(x).places);
}

}  // namespace

double BoxGrid::rounding() const {
    const std::uint64_t largest = std::max(scale, 2 * weight * count);
    if (all_places + static_cast<unsigned>(std::bit_width(largest)) <= 52) return 0;
    const auto terms = static_cast<double>(scale) * static_cast<double>(dimension() + 6);
    return (terms + static_cast<double>(weight * count)) * 0x1p-50;
}

BoxGrid box_grid(const PointSet& points, Space space, Measure measure, const RunContext& run) {
    const bool empty = measure == Measure::emptiness;
    const std::size_t d = points.dimension();
    BoxGrid grid{.count = points.count(),
                 .space = space,
                 .measure = measure,
                 .scale = empty ? 1 : points.count(),
                 .weight = empty ? 2U : 1U,  // twice the cube's volume outweighs any box
                 .values = {},
                 .ranks = {},
                 .order = {},
                 .places = {}};
    grid.values.resize(d);
    grid.ranks.resize(d);
    grid.order.resize(d);
    grid.places.resize(d);
    for (std::size_t axis = 0; axis < d; ++axis) {
        index_axis(points, axis, grid, run);
        grid.all_places += grid.places[axis];
    }
    return grid;
}

double length(const BoxGrid& grid, std::size_t axis, Interval interval, Side side) {
    const auto& values = grid.values[axis];
    const double along = values[interval.upper] - values[interval.lower];
    return interval.wraps(side) ? 1 + along : along;
}

Integer exact_length(const BoxGrid& grid, std::size_t axis, Interval interval, Side side) {
    const auto& values = grid.values[axis];
    const unsigned places = grid.places[axis];
    const Integer along =
        scaled(values[interval.upper], places) - scaled(values[interval.lower], places);
    return interval.wraps(side) ? Integer(along + power_of_two(places)) : along;
}

void WorstBox::offer(const GridBox& box) {
    std::uint64_t inside = 0;
    for (std::uint32_t i = 0; i < grid_->count; ++i) {
        bool in = true;
        for (std::size_t k = 0; in && k < grid_->dimension(); ++k)
            in = box.axes[k].contains(grid_->ranks[k][i], box.side);
        inside += in ? 1U : 0U;
    }
    Integer exact = grid_->scale;
    for (std::size_t k = 0; k < grid_->dimension(); ++k)
        exact *= exact_length(*grid_, k, box.axes[k], box.side);
    Integer share = inside * grid_->weight;
    share <<= grid_->all_places;
    exact -= share;
    if (box.side == Side::closed) exact = -exact;
    if (exact <= exact_) return;
    exact_ = std::move(exact);
    worth_ = quotient(exact_, 1, grid_->all_places);
    box_ = box;
    points_ = inside;
}

void WorstBox::offer(const WorstBox& other) {
    if (other.exact_ > exact_) *this = other;
}

double WorstBox::value() const { return quotient(exact_, grid_->scale, grid_->all_places); }

std::vector<double> WorstBox::lower_corner() const {
    std::vector<double> corner;
    for (std::size_t k = 0; k < box_.axes.size(); ++k)
        corner.push_back(grid_->values[k][box_.axes[k].lower]);
    return corner;
}

std::vector<double> WorstBox::upper_corner() const {
    std::vector<double> corner;
    for (std::size_t k = 0; k < box_.axes.size(); ++k)
        corner.push_back(grid_->values[k][box_.axes[k].upper]);
    return corner;
}

double WorstBox::volume() const {
    Integer exact = 1;
    for (std::size_t k = 0; k < box_.axes.size(); ++k)
        exact *= exact_length(*grid_, k, box_.axes[k], box_.side);
    return quotient(exact, 1, grid_->all_places);
}

}  // namespace stipple::analyzers::extreme
