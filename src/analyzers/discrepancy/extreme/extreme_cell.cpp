// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/extreme/extreme_cell.hpp"

#include <algorithm>

#include "analyzers/discrepancy/extreme/extreme_line.hpp"

namespace stipple::analyzers::extreme {
namespace {

/// The largest or the smallest intervals of a cell.
enum class Extent { outer, inner };

Interval interval_of(const Ends& ends, Extent extent) {
    return extent == Extent::outer ? Interval{ends.lower.first, ends.upper.last}
                                   : Interval{ends.lower.last, ends.upper.first};
}

/// Whether the place is between the ends, of which the shape is known.
bool between(std::uint32_t place, Interval ends, Shape shape, Side side) {
    const bool above = side == Side::open ? place > ends.lower : place >= ends.lower;
    const bool below = side == Side::open ? place < ends.upper : place <= ends.upper;
    return shape == Shape::plain ? above && below : above || below;
}

bool is_inside(std::uint32_t place, const Ends& ends, Extent extent, Side side) {
    if (ends.shape == Shape::either) return extent == Extent::outer;
    return between(place, interval_of(ends, extent), ends.shape, side);
}

/// Length of the cell's largest or smallest interval on an axis, as a Number in units of `one`.
template <class Number, class ValueAt>
Number length_of(const Ends& ends, Extent extent, const Number& one, const ValueAt& value_at) {
    if (ends.shape == Shape::either) return extent == Extent::outer ? one : Number(0);
    const Interval interval = interval_of(ends, extent);
    Number along = value_at(interval.upper) - value_at(interval.lower);
    if (ends.shape == Shape::wrapped) along += one;
    if (along < 0) return 0;
    return along > one ? one : along;
}

double length_of(const BoxGrid& grid, std::size_t axis, const Ends& ends, Extent extent) {
    const auto& values = grid.values[axis];
    return length_of<double>(ends, extent, 1, [&](std::uint32_t i) { return values[i]; });
}

/// Product of the lengths on all axes but the first.
double section(const BoxGrid& grid, const Cell& cell, Extent extent) {
    double product = 1;
    for (std::size_t k = 0; k < cell.axes.size(); ++k)
        product *= length_of(grid, k + 1, cell.axes[k], extent);
    return product;
}

/// The same times 2^places of all these axes.
Integer exact_section(const BoxGrid& grid, const Cell& cell, Extent extent) {
    Integer product = 1;
    for (std::size_t k = 0; k < cell.axes.size(); ++k) {
        const unsigned places = grid.places[k + 1];
        product *= length_of<Integer>(
            cell.axes[k], extent, power_of_two(places),
            [&](std::uint32_t i) { return scaled(grid.values[k + 1][i], places); });
    }
    return product;
}

Extent bounding(Side side) { return side == Side::open ? Extent::outer : Extent::inner; }

/// The points of a line that a bound counts, with how many are before each.
struct Counted {
    std::vector<std::uint32_t> places;
    std::vector<std::uint32_t> before;
    std::uint32_t all = 0;
};

Counted counted_of(const Line& line, Side side) {
    Counted counted;
    for (std::uint32_t i = 0; i < line.entries.size(); ++i) {
        const Entry& entry = line.entries[i];
        counted.all += entry.dropped;
        if (entry.undecided && side == Side::open) continue;
        counted.places.push_back(i);
        counted.before.push_back(counted.all++);
    }
    counted.all += line.dropped;
    return counted;
}

/// The worst interval of a cell's line in units of 1/unit; height(x) is h x.
template <class Number, class Height>
WorstInterval<Number> worst_on(const BoxGrid& grid, Side side, const Line& line,
                               const Counted& counted, const Number& unit, const Height& height) {
    const Number weight = unit * static_cast<Number>(grid.weight);
    const LineLaw<Number> law{.all = height(1.0),
                              .weight = weight,
                              .points = weight * counted.all,
                              .side = side,
                              .space = grid.space};
    return worst_interval<Number>(
        counted.places.size(), law,
        [&](std::size_t i) { return height(line.entries[counted.places[i]].x); },
        [&](std::size_t i) { return Number(weight * counted.before[i]); });
}

/// A single cell's box with that interval on the first axis.
template <class Number>
GridBox box_of(const BoxGrid& grid, const Cell& cell, const Line& line, const Counted& counted,
               const WorstInterval<Number>& found) {
    const auto place = [&](std::size_t i) {
        return grid.ranks[0][line.entries[counted.places[i]].point];
    };
    const auto last = static_cast<std::uint32_t>(grid.values[0].size() - 1);
    GridBox box{.side = cell.side, .axes = {}};
    box.axes.push_back(
        {found.lower == line_end ? 0 : place(found.lower),
         found.upper != line_end ? place(found.upper) : (grid.space == Space::torus ? 0 : last)});
    for (const Ends& ends : cell.axes) box.axes.push_back(interval_of(ends, Extent::outer));
    return box;
}

/// How much an axis may gain when its ends are halved: the share of the length that they leave
/// open, and that of the places.
double openness(const BoxGrid& grid, std::size_t axis, const Ends& ends, Range range) {
    if (range.single()) return -1;
    const auto& values = grid.values[axis];
    const double open = values[range.last] - values[range.first];
    const double outer = length_of(grid, axis, ends, Extent::outer);
    return open / outer +
           static_cast<double>(range.last - range.first) / static_cast<double>(values.size());
}

/// Where the stretch of decided points that begins here ends; an undecided one is alone.
std::size_t end_of_stretch(const Line& line, std::size_t first) {
    const auto& entries = line.entries;
    const std::size_t most = std::min(first + longest_stretch, entries.size());
    std::size_t last = first + 1;
    if (entries[first].undecided) return last;
    while (last < most && !entries[last].undecided) ++last;
    return last;
}

}  // namespace

Cell whole_cell(const BoxGrid& grid, Side side) {
    Cell cell{.side = side, .axes = {}, .bound = static_cast<double>(grid.scale)};
    const bool torus = grid.space == Space::torus;
    for (std::size_t k = 1; k < grid.dimension(); ++k) {
        const Range all{0, static_cast<std::uint32_t>(grid.values[k].size() - 1)};
        cell.axes.push_back({all, all, torus ? Shape::either : Shape::plain});
    }
    return cell;
}

std::pair<Cell, Cell> split(const BoxGrid& grid, const Cell& cell) {
    std::pair<Cell, Cell> halves{cell, cell};
    std::size_t axis = 0;
    bool lower = true;
    double most = -1;
    for (std::size_t k = 0; k < cell.axes.size(); ++k) {
        const Ends& ends = cell.axes[k];
        if (ends.shape == Shape::either) {
            halves.first.axes[k].shape = Shape::wrapped;
            halves.second.axes[k].shape = Shape::plain;
            return halves;
        }
        for (const bool low : {true, false}) {
            const double open = openness(grid, k + 1, ends, low ? ends.lower : ends.upper);
            if (open <= most) continue;
            most = open;
            axis = k;
            lower = low;
        }
    }
    const Ends& ends = cell.axes[axis];
    const Range range = lower ? ends.lower : ends.upper;
    const std::uint32_t middle = range.first + (range.last - range.first) / 2;
    if (lower) {
        halves.first.axes[axis].lower.last = middle;
        halves.second.axes[axis].lower.first = middle + 1;
    } else {
        halves.first.axes[axis].upper.first = middle + 1;
        halves.second.axes[axis].upper.last = middle;
    }
    return halves;
}

bool trim(Cell& cell) {
    const bool open = cell.side == Side::open;
    for (auto& [lower, upper, shape] : cell.axes) {
        if (shape == Shape::either) continue;
        // A plain interval has lower < upper if open, else lower <= upper; others are wrapped.
        const bool plain = shape == Shape::plain;
        Range& below = plain ? lower : upper;
        Range& above = plain ? upper : lower;
        const std::uint32_t gap = plain == open ? 1 : 0;
        if (below.first + gap > above.last) return false;
        below.last = std::min(below.last, above.last - gap);
        above.first = std::max(above.first, below.first + gap);
    }
    return true;
}

bool is_single(const Cell& cell) {
    return std::ranges::all_of(cell.axes, [](const Ends& ends) {
        return ends.shape != Shape::either && ends.lower.single() && ends.upper.single();
    });
}

Line whole_line(const BoxGrid& grid) {
    Line line;
    line.entries.reserve(grid.count);
    for (const std::uint32_t i : grid.order[0])
        line.entries.push_back({grid.values[0][grid.ranks[0][i]], i, 0, 1});
    return line;
}

void refine(const BoxGrid& grid, const Cell& cell, const Line& from, Line& to) {
    const auto holds = [&](std::uint32_t point, Extent extent) {
        for (std::size_t k = 0; k < cell.axes.size(); ++k)
            if (!is_inside(grid.ranks[k + 1][point], cell.axes[k], extent, cell.side)) return false;
        return true;
    };
    to.entries.clear();
    std::uint32_t dropped = 0;
    for (Entry entry : from.entries) {
        dropped += entry.dropped;
        if (entry.undecided) {
            if (!holds(entry.point, Extent::outer)) continue;
            entry.undecided = holds(entry.point, Extent::inner) ? 0 : 1;
        }
        entry.dropped = dropped & 0x7fffffffU;
        dropped = 0;
        to.entries.push_back(entry);
    }
    to.dropped = from.dropped + dropped;
}

double CellBounder::bound(const Cell& cell, const Line& line) const {
    const bool open = cell.side == Side::open;
    const bool torus = grid_.space == Space::torus;
    const double all = scale_ * section(grid_, cell, bounding(cell.side));
    constexpr double none = 1e300;
    double highest = -none;
    double lowest = open && !torus ? 0 : none;
    double ordered = -none;   // P_j - Q_i, i < j
    double reversed = -none;  // P_i - Q_j, i <= j
    double before = 0;
    for (const Entry& entry : line.entries) {
        before += weight_ * entry.dropped;
        if (open && entry.undecided) continue;
        const double p = all * entry.x - before;
        before += weight_;
        const double q = all * entry.x - before;
        ordered = std::max(ordered, p - lowest);
        highest = std::max(highest, p);
        reversed = std::max(reversed, highest - q);
        lowest = std::min(lowest, q);
    }
    before += weight_ * line.dropped;
    const double rest = all - before;
    if (open && torus) return std::max({ordered, rest + reversed, rest});
    if (open) return std::max(ordered, rest - lowest);
    return torus ? std::max(reversed, ordered - rest) : reversed;
}

bool CellBounder::settle(const Cell& cell, const Line& line, WorstBox& worst) {
    const bool single = is_single(cell);
    const bool certain = rounding_ == 0 || cell.bound > worst.worth() + rounding_;
    if (certain && !single) return true;
    const Counted counted = counted_of(line, cell.side);
    const Extent extent = bounding(cell.side);
    if (rounding_ == 0) {
        const double all = scale_ * section(grid_, cell, extent);
        worst.offer(box_of(grid_, cell, line, counted,
                           worst_on<double>(grid_, cell.side, line, counted, 1.0,
                                            [&](double x) { return all * x; })));
        return false;
    }
    const Integer all = grid_.scale * exact_section(grid_, cell, extent);
    const auto found =
        worst_on<Integer>(grid_, cell.side, line, counted, power_of_two(grid_.all_places),
                          [&](double x) { return Integer(all * scaled(x, grid_.places[0])); });
    if (found.worth <= worst.exact_worth()) return false;
    if (single) worst.offer(box_of(grid_, cell, line, counted, found));
    return !single;
}

double CellBounder::worst_inside(const Stretch& stretch, Side side, const Line& line) const {
    const bool open = side == Side::open;
    double highest = -1e300;
    double lowest = 1e300;
    double ordered = -1e300;
    double reversed = -1e300;
    double before = 0;
    for (std::size_t i = stretch.first; i < stretch.last; ++i) {
        const double x = stretch.height * line.entries[i].x;
        if (i > stretch.first) before += weight_ * line.entries[i].dropped;
        const double p = x - before;
        before += weight_;
        ordered = std::max(ordered, p - lowest);
        highest = std::max(highest, p);
        reversed = std::max(reversed, highest - (x - before));
        lowest = std::min(lowest, x - before);
    }
    if (grid_.space == Space::cube) return open ? ordered : reversed;
    return open ? std::max(ordered, stretch.around + reversed)
                : std::max(reversed, stretch.around + ordered);
}

void CellBounder::mark(const Stretch& stretch, const Line& line, double low, double high) {
    const std::size_t first = stretch.first;
    const std::size_t n = stretch.last - first;
    std::array<double, longest_stretch> at_low;
    std::array<double, longest_stretch> at_high;
    double before = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Entry& entry = line.entries[first + i];
        if (i > 0) before += weight_ * (1 + entry.dropped);
        at_low[i] = low * entry.x - before;
        at_high[i] = high * entry.x - before;
    }
    // One is no end of a worst interval if its line is nowhere from `low` to `high` beyond that of
    // another: one with a larger slope may only be beaten at `low`, with a smaller one at `high`.
    // P and Q differ by a constant here, and are wanted highest and lowest.
    std::array<bool, longest_stretch> above;
    std::array<bool, longest_stretch> below;
    double highest = -1e300;
    double lowest = 1e300;
    for (std::size_t i = 0; i < n; ++i) {
        above[i] = at_high[i] + rounding_ >= highest;
        below[i] = at_low[i] - rounding_ < lowest;
        highest = std::max(highest, at_high[i]);
        lowest = std::min(lowest, at_low[i]);
    }
    highest = -1e300;
    lowest = 1e300;
    for (std::size_t i = n; i-- > 0;) {
        above[i] = above[i] && at_low[i] + rounding_ > highest;
        below[i] = below[i] && at_high[i] - rounding_ <= lowest;
        highest = std::max(highest, at_low[i]);
        lowest = std::min(lowest, at_high[i]);
        useful_[i] = above[i] || below[i];
    }
}

bool CellBounder::sift(const Stretch& stretch, Side side, const Line& line,
                       const WorstBox& worst) const {
    return stretch.last - stretch.first > 2 &&
           worst_inside(stretch, side, line) <= worst.worth() - rounding_;
}

void CellBounder::shorten(const Cell& cell, const WorstBox& worst, Line& line) {
    const double low = scale_ * section(grid_, cell, Extent::inner);
    const double high = scale_ * section(grid_, cell, Extent::outer);
    const bool open = cell.side == Side::open;
    Stretch stretch{.first = 0, .last = 0, .height = open ? high : low, .around = 0};
    if (grid_.space == Space::torus) {
        const double points = weight_ * counted_of(line, cell.side).all;
        stretch.around = open ? high - points : points - low;
    }
    auto& entries = line.entries;
    std::size_t kept = 0;
    std::uint32_t dropped = 0;
    for (; stretch.first < entries.size(); stretch.first = stretch.last) {
        stretch.last = end_of_stretch(line, stretch.first);
        const bool sifted = sift(stretch, cell.side, line, worst);
        if (sifted) mark(stretch, line, low, high);
        for (std::size_t i = stretch.first; i < stretch.last; ++i) {
            Entry entry = entries[i];
            dropped += entry.dropped;
            if (sifted && !useful_[i - stretch.first]) {
                ++dropped;
                continue;
            }
            entry.dropped = dropped & 0x7fffffffU;
            dropped = 0;
            entries[kept++] = entry;
        }
    }
    entries.resize(kept);
    line.dropped += dropped;
}

}  // namespace stipple::analyzers::extreme
