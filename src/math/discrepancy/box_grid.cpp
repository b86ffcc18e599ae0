// SPDX-License-Identifier: MIT
#include "math/discrepancy/box_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/machine/large_pages.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/radix_sort.hpp"

namespace stipple::discrepancy {
namespace {

/// A double in [0, 1] as mantissa * 2^-places, with an odd mantissa or 0.
struct Dyadic {
    std::uint64_t mantissa;
    unsigned places;
};

Dyadic dyadic(double x) {
    if (x == 0) return {0, 0};
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::frexp(x, &exponent) * 0x1p53);
    const int zeros = std::countr_zero(mantissa);
    return {mantissa >> zeros, static_cast<unsigned>(53 - exponent - zeros)};
}

/// above / (below * 2^places), rounded to the nearest double, ties to even. Needs above >= 0.
double quotient(const Integer& above, std::uint64_t below, unsigned places) {
    if (above == 0) return 0;
    const unsigned shift = 128;  // gives the quotient at least 64 bits
    Integer rest = 0;
    Integer whole = 0;
    divide_qr(Integer(above << shift), Integer(below), whole, rest);
    const auto spare = static_cast<unsigned>(msb(whole)) - 54;
    const bool inexact = rest != 0 || lsb(whole) < spare;
    // Keeps 55 bits: the 53 of a double, a round bit and a sticky bit.
    const auto top = static_cast<std::uint64_t>(Integer(whole >> spare)) | (inexact ? 1U : 0U);
    return std::ldexp(static_cast<double>(top),
                      static_cast<int>(spare) - static_cast<int>(shift + places));
}

/// Points with a coordinate 1, which no half-open box contains; empty for other families.
std::vector<std::uint32_t> in_no_box(const PointSet& points, Family family) {
    std::vector<std::uint32_t> found;
    if (family != Family::half_open) return found;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (std::ranges::find(points[i], 1.0) != points[i].end())
            found.push_back(static_cast<std::uint32_t>(i));
    return found;
}

/// Appends the distinct values of sorted items to `values`; returns each item's index in it.
std::vector<std::uint32_t> ranks_among(const std::vector<Placed>& items,
                                       std::vector<double>& values, const RunContext& run) {
    std::vector<std::uint32_t> ranks;
    fill_with_zeros(ranks, items.size());
    std::size_t seen = 0;
    for (const auto& [value, item] : items) {
        if (++seen % 65536 == 0) run.check_stop();
        if (values.empty() || values.back() != value) values.push_back(value);
        ranks[item] = static_cast<std::uint32_t>(values.size() - 1);
    }
    return ranks;
}

/// Fills the grid's vectors for one axis; coordinates of the points `at_one` are replaced by 1.
void index_axis(const PointSet& points, std::size_t axis, const std::vector<std::uint32_t>& at_one,
                BoxGrid& grid, const RunContext& run) {
    std::vector<Placed> items;
    fill_with_zeros(items, points.count());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const double x = points[i][axis] + 0.0;  // -0 becomes 0
        items[i] = {grid.torus() && x == 1 ? 0.0 : x, static_cast<std::uint32_t>(i)};
    }
    for (const std::uint32_t i : at_one) items[i].value = 1;
    radix_sort(items, run);
    auto& values = grid.values[axis];
    if (grid.family == Family::cube) values.push_back(0);
    grid.ranks[axis] = ranks_among(items, values, run);
    if (!grid.torus() && values.back() != 1) values.push_back(1);
    for (const double x : values) grid.digits[axis] = std::max(grid.digits[axis], dyadic(x).places);
    if (grid.anchored()) return;
    grid.order[axis].reserve(items.size());
    for (const Placed& item : items) grid.order[axis].push_back(item.place);
}

}  // namespace

Integer scaled(double x, unsigned places) {
    const Dyadic fraction = dyadic(x);
    return Integer(fraction.mantissa) << (places - fraction.places);
}

RankSet ranks_between(Interval ends, Side side, bool wraps) {
    const auto [lower, upper] = ends;
    const bool with_ends = (side == Side::closed) != wraps;
    // First and last rank inside or, if the interval wraps, outside.
    const std::uint32_t low = wraps ? upper : lower;
    const std::uint32_t high = wraps ? lower : upper;
    const std::uint32_t first = with_ends ? low : low + 1;
    const std::uint32_t behind = with_ends ? high + 1 : high;
    return {first, behind > first ? behind - first : 0, wraps};
}

double BoxGrid::rounding() const {
    const std::uint64_t largest = std::max(scale, 2 * weight * count);
    if (all_digits + static_cast<unsigned>(std::bit_width(largest)) <= 52) return 0;
    const auto terms = static_cast<double>(scale) * static_cast<double>(dimension() + 6);
    return (terms + static_cast<double>(weight * count)) * 0x1p-50;
}

double BoxGrid::length(std::size_t axis, Interval interval, Side side) const {
    const double upper = values[axis][interval.upper];
    if (anchored()) return upper;
    const double along = upper - values[axis][interval.lower];
    return interval.wraps(side) ? 1 + along : along;
}

Integer BoxGrid::exact_length(std::size_t axis, Interval interval, Side side) const {
    Integer upper = scaled(values[axis][interval.upper], digits[axis]);
    if (anchored()) return upper;
    upper -= scaled(values[axis][interval.lower], digits[axis]);
    return interval.wraps(side) ? Integer(upper + (Integer(1) << digits[axis])) : upper;
}

RankSet BoxGrid::inside(Interval interval, Side side) const {
    if (anchored()) return {0, interval.upper + (side == Side::closed ? 1U : 0U), false};
    return ranks_between(interval, side, interval.wraps(side));
}

BoxGrid box_grid(const PointSet& points, Family family, const RunContext& run, Measure measure) {
    const bool empty = measure == Measure::emptiness;
    const std::size_t d = points.dimension();
    BoxGrid grid{.count = points.count(),
                 .family = family,
                 .measure = measure,
                 .scale = empty ? 1 : points.count(),
                 .weight = empty ? 2U : 1U,  // one point outweighs any volume
                 .values = std::vector<std::vector<double>>(d),
                 .ranks = std::vector<std::vector<std::uint32_t>>(d),
                 .order = std::vector<std::vector<std::uint32_t>>(d),
                 .digits = std::vector<unsigned>(d)};
    const auto at_one = in_no_box(points, family);
    const double seconds = 1e-7 * static_cast<double>(points.flat().size());
    for_each_block(silent(worth_threads(run, seconds)), d, 1,
                   [&](const Block& block) { index_axis(points, block.index, at_one, grid, run); });
    for (const unsigned digits : grid.digits) grid.all_digits += digits;
    return grid;
}

std::vector<std::uint32_t> points_at(const BoxGrid& grid, std::size_t axis) {
    std::vector<std::uint32_t> points;
    fill_with_zeros(points, grid.values[axis].size());
    for (const std::uint32_t rank : grid.ranks[axis]) ++points[rank];
    return points;
}

WorstBox::WorstBox(const BoxGrid& grid)
    : grid_(&grid),
      rounding_(static_cast<double>(2 * grid.dimension() + 4) * 0x1p-52),
      points_(grid.count) {
    if (!grid.anchored()) return;
    for (const auto& values : grid.values)
        box_.axes.push_back({0, static_cast<std::uint32_t>(values.size() - 1)});
}

double WorstBox::approximate(Side side, double volume, std::uint64_t points) const {
    const double share =
        static_cast<double>(points * grid_->weight) / static_cast<double>(grid_->scale);
    return side == Side::open ? volume - share : share - volume;
}

Integer WorstBox::exact_volume(const GridBox& box) const {
    Integer volume = 1;
    for (std::size_t k = 0; k < box.axes.size(); ++k)
        volume *= grid_->exact_length(k, box.axes[k], box.side);
    return volume;
}

void WorstBox::offer(const GridBox& box, std::uint64_t points) {
    if (box.axes.empty()) return;
    double volume = 1;
    for (std::size_t k = 0; k < box.axes.size(); ++k)
        volume *= grid_->length(k, box.axes[k], box.side);
    if (approximate(box.side, volume, points) < threshold()) return;
    Integer share = points * grid_->weight;
    share <<= grid_->all_digits;
    Integer exact = exact_volume(box) * grid_->scale - share;
    if (box.side == Side::closed) exact = -exact;
    if (exact <= exact_) return;
    exact_ = std::move(exact);
    value_ = quotient(exact_, grid_->scale, grid_->all_digits);
    excess_ = quotient(exact_, 1, grid_->all_digits);
    box_ = box;
    points_ = points;
}

void WorstBox::offer(const GridBox& box) {
    std::vector<RankSet> inside;
    for (const Interval& interval : box.axes) inside.push_back(grid_->inside(interval, box.side));
    std::uint64_t points = 0;
    for (std::size_t i = 0; i < grid_->count; ++i) {
        bool in = true;
        for (std::size_t k = 0; in && k < inside.size(); ++k)
            in = inside[k].contains(grid_->ranks[k][i]);
        points += in ? 1U : 0U;
    }
    offer(box, points);
}

void WorstBox::offer(Side side, std::span<const std::uint32_t> corner, std::uint64_t points) {
    double volume = 1;
    for (std::size_t k = 0; k < corner.size(); ++k) volume *= grid_->values[k][corner[k]];
    if (approximate(side, volume, points) < threshold()) return;
    GridBox box{.side = side, .axes = {}};
    for (const std::uint32_t rank : corner) box.axes.push_back({0, rank});
    offer(box, points);
}

void WorstBox::offer(const WorstBox& other) {
    if (other.exact_ > exact_) *this = other;
}

std::vector<double> WorstBox::corner(std::uint32_t Interval::*end) const {
    std::vector<double> corner;
    for (std::size_t k = 0; k < box_.axes.size(); ++k)
        corner.push_back(grid_->values[k][box_.axes[k].*end]);
    return corner;
}

double WorstBox::volume() const { return quotient(exact_volume(box_), 1, grid_->all_digits); }

}  // namespace stipple::discrepancy
