// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/star/star_box.hpp"

#include <algorithm>

#include "analyzers/discrepancy/axis_places.hpp"
#include "core/large_pages.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::star {
namespace {

/// Points with a coordinate 1, for half-open boxes; none for closed ones.
std::vector<std::uint32_t> in_no_box(const PointSet& points, Boxes boxes) {
    std::vector<std::uint32_t> places;
    if (boxes == Boxes::closed) return places;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (std::ranges::find(points[i], 1.0) != points[i].end())
            places.push_back(static_cast<std::uint32_t>(i));
    return places;
}

/// Sorts one axis: its distinct values with 1, and the place of every point; `at_one` are taken to
/// be at 1.
void index_axis(const PointSet& points, std::size_t axis, const std::vector<std::uint32_t>& at_one,
                CornerGrid& grid, const RunContext& run) {
    std::vector<Placed> items;
    fill_with_zeros(items, points.count());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {points[i][axis] + 0.0, static_cast<std::uint32_t>(i)};  // -0 becomes 0
    for (const std::uint32_t i : at_one) items[i].value = 1;
    auto& values = grid.values[axis];
    grid.ranks[axis] = places_on_axis(items, values, run);
    if (values.back() != 1) values.push_back(1);
}

unsigned places_of(const std::vector<double>& values) {
    unsigned most = 0;
    for (const double x : values) most = std::max(most, dyadic(x).places);
    return most;
}

}  // namespace

CornerGrid corner_grid(const PointSet& points, const RunContext& run, Boxes boxes) {
    CornerGrid grid{.count = points.count(), .values = {}, .ranks = {}};
    grid.values.resize(points.dimension());
    grid.ranks.resize(points.dimension());
    const auto at_one = in_no_box(points, boxes);
    constexpr bool silent = true;
    const double seconds = 1e-7 * static_cast<double>(points.flat().size());
    for_each_block(
        worth_threads(run, seconds), points.dimension(), 1,
        [&](const Block& block) { index_axis(points, block.index, at_one, grid, run); }, silent);
    return grid;
}

WorstBox::WorstBox(const CornerGrid& grid)
    : grid_(&grid),
      rounding_(static_cast<double>(grid.dimension() + 4) * 0x1p-52),
      points_(grid.count) {
    for (const auto& values : grid.values) {
        places_.push_back(places_of(values));
        corner_.push_back(static_cast<std::uint32_t>(values.size() - 1));
    }
    for (const unsigned places : places_) all_places_ += places;
}

double WorstBox::approximate(Side side, std::span<const std::uint32_t> corner,
                             std::uint64_t points) const {
    double volume = 1;
    for (std::size_t k = 0; k < corner.size(); ++k) volume *= grid_->values[k][corner[k]];
    const double share = static_cast<double>(points) / static_cast<double>(grid_->count);
    return side == Side::open ? volume - share : share - volume;
}

Integer WorstBox::scaled_volume(std::span<const std::uint32_t> corner) const {
    Integer volume = 1;
    for (std::size_t k = 0; k < corner.size(); ++k) {
        const auto [mantissa, places] = dyadic(grid_->values[k][corner[k]]);
        volume *= mantissa;
        volume <<= places_[k] - places;
    }
    return volume;
}

void WorstBox::offer(Side side, std::span<const std::uint32_t> corner, std::uint64_t points) {
    if (approximate(side, corner, points) < threshold()) return;
    const Integer share = Integer(points) << all_places_;
    const Integer volume = scaled_volume(corner) * grid_->count;
    Integer scaled = volume - share;
    if (side == Side::closed) scaled = -scaled;
    if (scaled <= scaled_value_) return;
    value_ = quotient(scaled, grid_->count, all_places_);
    scaled_value_ = std::move(scaled);
    side_ = side;
    corner_.assign(corner.begin(), corner.end());
    points_ = points;
}

void WorstBox::offer(const WorstBox& other) {
    if (other.scaled_value_ > scaled_value_) *this = other;
}

std::vector<double> WorstBox::corner() const {
    std::vector<double> corner;
    for (std::size_t k = 0; k < corner_.size(); ++k) corner.push_back(grid_->values[k][corner_[k]]);
    return corner;
}

double WorstBox::volume() const { return quotient(scaled_volume(corner_), 1, all_places_); }

}  // namespace stipple::analyzers::star
