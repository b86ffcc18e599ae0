// SPDX-License-Identifier: MIT
//
// A cell is a set of boxes with any interval on the first axis, and with intervals on the others
// that begin and end in given ranges. Let V be a box's volume without the first axis. The points
// that are inside some box on all other axes form the cell's line, ordered along the first axis. A
// point is decided if it is inside all boxes on all other axes. Then
//
//     open:    excess <= that of the worst interval for the largest V and the decided points,
//     closed:  excess <= that of the worst interval for the smallest V and all points of the line.
//
// Between two undecided points, most decided ones are dominated by a neighbour, so they cannot be
// ends of a worst interval for any V of the cell. On the cube these are pruned, and only their
// number is kept. So the length of a cell's line is about the number of undecided points.
//
// Source  J. Barbay, T. M. Chan, G. Navarro, P. Perez-Lantero, "Maximum-weight planar boxes in
//         O(n^2) time (and better)", Inform. Process. Lett. 114 (2014) 437-445,
//         doi:10.1016/j.ipl.2014.03.007 (lines that shrink with their cells, for fixed weights;
//         comparing points for all V of a cell is not from this paper).
#include "math/discrepancy/extreme/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "math/discrepancy/branch_and_bound.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/star/search.hpp"
#include "math/discrepancy/worst_interval.hpp"

namespace stipple::discrepancy::extreme {
namespace {

/// Larger than any excess.
constexpr double huge = 1e300;

/// A point on a cell's line.
struct Entry {
    double x;
    std::uint32_t point;
    std::uint32_t pruned : 31;    ///< decided points removed just before this entry
    std::uint32_t undecided : 1;  ///< not inside all boxes of the cell
};

/// Points along the first axis that are inside some box of a cell on all other axes.
struct Line {
    std::vector<Entry> entries;
    std::uint32_t pruned = 0;  ///< decided points removed after the last entry
};

/// Maxima of differences of P and Q, updated point by point; see worst_interval.hpp.
struct Maxima {
    double all;         ///< scale times section() of the boxes
    double weight;      ///< weight of a point
    double before = 0;  ///< weight of the points so far
    double highest = -huge;
    double lowest = huge;
    double ordered = -huge;   ///< maximum of P_j - Q_i over i < j
    double reversed = -huge;  ///< maximum of P_i - Q_j over i <= j

    void add(const Entry& entry) {
        before += weight * entry.pruned;
        const double p = all * entry.x - before;
        before += weight;
        const double q = all * entry.x - before;
        ordered = std::max(ordered, p - lowest);
        highest = std::max(highest, p);
        reversed = std::max(reversed, highest - q);
        lowest = std::min(lowest, q);
    }
};

/// Number of ranges of a cell per axis: lower end, upper end, and whether the interval wraps.
constexpr std::size_t parts = 3;

struct Range {
    std::uint32_t first;
    std::uint32_t last;

    [[nodiscard]] bool single() const { return first == last; }
};

/// Ranges of a cell's intervals on one axis: lower ends, upper ends, and wraps (0 or 1).
struct Ends {
    Range lower;
    Range upper;
    Range wraps;
};

std::size_t axes_of(const Cell& cell) { return cell.lo.size() / parts; }

Ends ends_on(const Cell& cell, std::size_t k) {
    const auto range = [&](std::size_t part) {
        return Range{cell.lo[parts * k + part], cell.hi[parts * k + part]};
    };
    return {range(0), range(1), range(2)};
}

/// Selects the largest or the smallest boxes of a cell.
enum class Extent { outer, inner };

Interval interval_of(const Ends& ends, Extent extent) {
    return extent == Extent::outer ? Interval{ends.lower.first, ends.upper.last}
                                   : Interval{ends.lower.last, ends.upper.first};
}

/// Ranks inside at least one (outer) or all (inner) of a cell's intervals on an axis.
RankSet ranks_of(const Ends& ends, Extent extent, Side side) {
    if (!ends.wraps.single()) return {0, 0, extent == Extent::outer};
    return ranks_between(interval_of(ends, extent), side, ends.wraps.first == 1);
}

/// Length of the cell's largest or smallest interval on an axis; `one` is length 1 in this type.
template <class Number, class ValueAt>
Number length_of(const Ends& ends, Extent extent, const Number& one, const ValueAt& value_at) {
    if (!ends.wraps.single()) return extent == Extent::outer ? one : Number(0);
    const Interval interval = interval_of(ends, extent);
    Number along = value_at(interval.upper) - value_at(interval.lower);
    if (ends.wraps.first == 1) along += one;
    if (along < 0) return 0;
    return along > one ? one : along;
}

double length_of(const BoxGrid& grid, std::size_t axis, const Ends& ends, Extent extent) {
    const auto& values = grid.values[axis];
    return length_of<double>(ends, extent, 1, [&](std::uint32_t i) { return values[i]; });
}

/// Section of a cell's largest or smallest boxes: product of lengths on all axes except the first.
double section(const BoxGrid& grid, const Cell& cell, Extent extent) {
    double product = 1;
    for (std::size_t k = 0; k < axes_of(cell); ++k)
        product *= length_of(grid, k + 1, ends_on(cell, k), extent);
    return product;
}

/// section() as an exact integer, scaled by 2^digits of every axis except the first.
Integer exact_section(const BoxGrid& grid, const Cell& cell, Extent extent) {
    Integer product = 1;
    for (std::size_t k = 0; k < axes_of(cell); ++k) {
        const unsigned digits = grid.digits[k + 1];
        product *= length_of<Integer>(
            ends_on(cell, k), extent, scaled(1.0, digits),
            [&](std::uint32_t i) { return scaled(grid.values[k + 1][i], digits); });
    }
    return product;
}

/// Entries of a line that a bound counts, and the number of points before each of them.
struct Counted {
    std::vector<std::uint32_t> entries;
    std::vector<std::uint32_t> before;
    std::uint32_t all = 0;
};

Counted counted_of(const Line& line, Side side) {
    Counted counted;
    for (std::uint32_t i = 0; i < line.entries.size(); ++i) {
        const Entry& entry = line.entries[i];
        counted.all += entry.pruned;
        if (entry.undecided && side == Side::open) continue;
        counted.entries.push_back(i);
        counted.before.push_back(counted.all++);
    }
    counted.all += line.pruned;
    return counted;
}

/// Worst interval on a cell's line, with its excess times 2^all_digits; `all` is scale * section.
WorstInterval<Integer> worst_on(const BoxGrid& grid, Side side, const Line& line,
                                const Counted& counted, const Integer& all) {
    const auto height = [&](double x) { return Integer(all * scaled(x, grid.digits[0])); };
    const Integer weight = (Integer(1) << grid.all_digits) * grid.weight;
    const LineTerms<Integer> terms{.all = height(1.0),
                                   .weight = weight,
                                   .points = weight * counted.all,
                                   .side = side,
                                   .torus = grid.torus()};
    return worst_interval<Integer>(
        counted.entries.size(), terms,
        [&](std::size_t i) { return height(line.entries[counted.entries[i]].x); },
        [&](std::size_t i) { return Integer(weight * counted.before[i]); });
}

/// Box with the interval `found` on the first axis; the cell has only one interval on the others.
GridBox box_of(const BoxGrid& grid, const Cell& cell, const Line& line, const Counted& counted,
               const WorstInterval<Integer>& found) {
    const auto rank = [&](std::size_t i) {
        return grid.ranks[0][line.entries[counted.entries[i]].point];
    };
    const auto last = static_cast<std::uint32_t>(grid.torus() ? 0 : grid.values[0].size() - 1);
    GridBox box{.side = cell.side, .axes = {}};
    box.axes.push_back({found.lower == line_end ? 0 : rank(found.lower),
                        found.upper == line_end ? last : rank(found.upper)});
    for (std::size_t k = 0; k < axes_of(cell); ++k)
        box.axes.push_back(interval_of(ends_on(cell, k), Extent::outer));
    return box;
}

/// Expected gain from halving a range of ends on an axis: the length of the range as a fraction of
/// the cell's largest interval, plus its ranks as a fraction of those of the axis.
double openness(const BoxGrid& grid, std::size_t axis, const Ends& ends, Range range) {
    if (range.single()) return -1;
    const auto& values = grid.values[axis];
    const double open = values[range.last] - values[range.first];
    const double outer = length_of(grid, axis, ends, Extent::outer);
    return open / outer +
           static_cast<double>(range.last - range.first) / static_cast<double>(values.size());
}

/// Removes ends that no interval of the cell can have; returns false if none remain.
bool trim(Cell& cell) {
    const bool open = cell.side == Side::open;
    for (std::size_t at = 0; at < cell.lo.size(); at += parts) {
        if (cell.lo[at + 2] != cell.hi[at + 2]) continue;
        // An interval that does not wrap has lower < upper if open, lower <= upper if closed. An
        // interval that wraps has lower >= upper if open, lower > upper if closed.
        const bool plain = cell.lo[at + 2] == 0;
        const std::size_t below = plain ? at : at + 1;
        const std::size_t above = plain ? at + 1 : at;
        const std::uint32_t gap = plain == open ? 1 : 0;
        if (cell.lo[below] + gap > cell.hi[above]) return false;
        cell.hi[below] = std::min(cell.hi[below], cell.hi[above] - gap);
        cell.lo[above] = std::max(cell.lo[above], cell.lo[below] + gap);
    }
    return true;
}

/// Maximum number of points that are pruned together.
inline constexpr std::size_t longest_stretch = 32;

/// End of the run of decided points from `first` on; each undecided point is a run of its own.
std::size_t end_of_stretch(const Line& line, std::size_t first) {
    const auto& entries = line.entries;
    const std::size_t most = std::min(first + longest_stretch, entries.size());
    std::size_t last = first + 1;
    if (entries[first].undecided) return last;
    while (last < most && !entries[last].undecided) ++last;
    return last;
}

/// Bounds cells; reuses its buffers.
class CellBounder {
  public:
    using Points = Line;

    /// Keeps references to both arguments.
    CellBounder(const BoxGrid& grid, WorstBox& worst)
        : grid_(grid),
          worst_(worst),
          scale_(static_cast<double>(grid.scale)),
          weight_(static_cast<double>(grid.weight)),
          rounding_(grid.rounding()) {}

    /// Shrinks and bounds the cell, given the line of a larger cell; sets `mine` to the line of the
    /// shrunk cell. Offers the worst box of a cell that cannot be split. Returns false if no box
    /// can be worse than the worst so far, or if there is nothing left to split.
    bool tighten(Cell& cell, const Line& from, Line& mine) {
        work_ += 2 * grid_.dimension() * (from.entries.size() + 1);
        if (!trim(cell)) return false;
        side_ = cell.side;
        refine(cell, from, mine);
        largest_ = scale_ * section(grid_, cell, Extent::outer);
        smallest_ = scale_ * section(grid_, cell, Extent::inner);
        const double most = bound(mine);
        cell.bound = std::min(cell.bound, (most + rounding_) * (1 + 0x1p-50) / scale_);
        if (most <= worst_.excess() - rounding_ || !check_exactly(cell, mine, most)) return false;
        if (!grid_.torus()) prune(mine);  // on the torus this takes longer than it saves
        return true;
    }

    /// Halves a cell on the axis that promises the largest gain. Removes the half with the larger
    /// boxes and returns it; either half may contain no boxes.
    Cell split(Cell& cell) const {
        Cell larger = cell;
        std::size_t at = 0;
        double most = -1;
        for (std::size_t k = 0; k < axes_of(cell); ++k) {
            const Ends ends = ends_on(cell, k);
            if (!ends.wraps.single()) {
                larger.lo[parts * k + 2] = 1;
                cell.hi[parts * k + 2] = 0;
                return larger;
            }
            for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {
                const double open =
                    openness(grid_, k + 1, ends, part == 0 ? ends.lower : ends.upper);
                if (open <= most) continue;
                most = open;
                at = parts * k + part;
            }
        }
        const std::uint32_t middle = cell.lo[at] + (cell.hi[at] - cell.lo[at]) / 2;
        const bool lower = at % parts == 0;
        (lower ? larger : cell).hi[at] = middle;
        (lower ? cell : larger).lo[at] = middle + 1;
        return larger;
    }

    /// Comparisons of coordinates so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    /// A run of decided points.
    struct Stretch {
        std::size_t first;
        std::size_t last;
    };

    /// Filters the line of a larger cell to that of this cell; `from` and `to` may be the same.
    void refine(const Cell& cell, const Line& from, Line& to) {
        outer_.clear();
        inner_.clear();
        for (std::size_t k = 0; k < axes_of(cell); ++k) {
            const Ends ends = ends_on(cell, k);
            outer_.push_back(ranks_of(ends, Extent::outer, cell.side));
            inner_.push_back(ranks_of(ends, Extent::inner, cell.side));
        }
        const auto holds = [&](std::uint32_t point, const std::vector<RankSet>& inside) {
            for (std::size_t k = 0; k < inside.size(); ++k)
                if (!inside[k].contains(grid_.ranks[k + 1][point])) return false;
            return true;
        };
        if (&from != &to) to.entries.resize(from.entries.size());
        std::size_t kept = 0;
        std::uint32_t pruned = 0;
        for (std::size_t i = 0; i < from.entries.size(); ++i) {
            Entry entry = from.entries[i];
            pruned += entry.pruned;
            if (entry.undecided) {
                if (!holds(entry.point, outer_)) continue;
                entry.undecided = holds(entry.point, inner_) ? 0 : 1;
            }
            entry.pruned = pruned & 0x7fffffffU;
            pruned = 0;
            to.entries[kept++] = entry;
        }
        to.pruned = from.pruned + pruned;
        to.entries.resize(kept);
    }

    /// Upper bound on the excess of the cell's boxes, without allowance for rounding.
    double bound(const Line& line) const {
        const bool open = side_ == Side::open;
        const bool torus = grid_.torus();
        const double all = open ? largest_ : smallest_;
        Maxima found{.all = all, .weight = weight_};
        if (open && !torus) found.lowest = 0;
        for (const Entry& entry : line.entries) {
            if (open && entry.undecided)
                found.before += weight_ * entry.pruned;
            else
                found.add(entry);
        }
        const double rest = all - (found.before + weight_ * line.pruned);
        if (open && torus) return std::max({found.ordered, rest + found.reversed, rest});
        if (open) return std::max(found.ordered, rest - found.lowest);
        return torus ? std::max(found.reversed, found.ordered - rest) : found.reversed;
    }

    /// True if the bound, computed exactly if rounding matters, exceeds the worst box's excess and
    /// the cell can be split. Offers the box of a cell that cannot be split.
    bool check_exactly(const Cell& cell, const Line& line, double bound) {
        const bool single = cell.lo == cell.hi;
        if (!single && (rounding_ == 0 || bound > worst_.excess() + rounding_)) return true;
        const Counted counted = counted_of(line, side_);
        const Extent extent = side_ == Side::open ? Extent::outer : Extent::inner;
        const Integer all = grid_.scale * exact_section(grid_, cell, extent);
        const auto found = worst_on(grid_, side_, line, counted, all);
        if (found.excess <= worst_.exact_excess()) return false;
        if (single) worst_.offer(box_of(grid_, cell, line, counted, found));
        return !single;
    }

    /// Excess of the worst interval between two points of a run.
    double worst_inside(const Stretch& stretch, const Line& line) const {
        const bool open = side_ == Side::open;
        Maxima found{.all = open ? largest_ : smallest_, .weight = weight_};
        for (std::size_t i = stretch.first; i < stretch.last; ++i) found.add(line.entries[i]);
        return open ? found.ordered : found.reversed;
    }

    /// True if no interval inside the run is worse than the worst box.
    bool may_prune(const Stretch& stretch, const Line& line) const {
        return stretch.last - stretch.first > 2 &&
               worst_inside(stretch, line) <= worst_.excess() - rounding_;
    }

    /// Marks the points of a run that may be ends of a worst interval for some section of the cell.
    /// P and Q of worst_interval.hpp differ by a constant, and are linear in the section with slope
    /// x. An interval ends at a high P. A point with larger x is better for all sections if it is
    /// better at the smallest, one with smaller x if at the largest. An interval begins at a low Q;
    /// there it is the other way round.
    void find_useful(const Stretch& stretch, const Line& line) {
        const std::size_t first = stretch.first;
        const std::size_t n = stretch.last - first;
        std::array<double, longest_stretch> at_low;
        std::array<double, longest_stretch> at_high;
        double before = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Entry& entry = line.entries[first + i];
            if (i > 0) before += weight_ * (1 + entry.pruned);
            at_low[i] = smallest_ * entry.x - before;
            at_high[i] = largest_ * entry.x - before;
        }
        std::array<bool, longest_stretch> above;
        std::array<bool, longest_stretch> below;
        double highest = -huge;
        double lowest = huge;
        for (std::size_t i = 0; i < n; ++i) {
            above[i] = at_high[i] + rounding_ >= highest;
            below[i] = at_low[i] - rounding_ < lowest;
            highest = std::max(highest, at_high[i]);
            lowest = std::min(lowest, at_low[i]);
        }
        highest = -huge;
        lowest = huge;
        for (std::size_t i = n; i-- > 0;) {
            above[i] = above[i] && at_low[i] + rounding_ > highest;
            below[i] = below[i] && at_high[i] - rounding_ <= lowest;
            highest = std::max(highest, at_low[i]);
            lowest = std::min(lowest, at_high[i]);
            useful_[i] = above[i] || below[i];
        }
    }

    /// Drops dominated decided points, which cannot be ends of boxes worse than the worst so far.
    void prune(Line& line) {
        Stretch stretch{.first = 0, .last = 0};
        auto& entries = line.entries;
        std::size_t kept = 0;
        std::uint32_t pruned = 0;
        for (; stretch.first < entries.size(); stretch.first = stretch.last) {
            stretch.last = end_of_stretch(line, stretch.first);
            const bool some = may_prune(stretch, line);
            if (some) find_useful(stretch, line);
            for (std::size_t i = stretch.first; i < stretch.last; ++i) {
                Entry entry = entries[i];
                pruned += entry.pruned;
                if (some && !useful_[i - stretch.first]) {
                    ++pruned;
                    continue;
                }
                entry.pruned = pruned & 0x7fffffffU;
                pruned = 0;
                entries[kept++] = entry;
            }
        }
        entries.resize(kept);
        line.pruned += pruned;
    }

    const BoxGrid& grid_;
    WorstBox& worst_;
    double scale_;
    double weight_;
    double rounding_;
    std::uint64_t work_ = 0;

    // State of the current cell.
    Side side_ = Side::open;
    std::vector<RankSet> outer_;  ///< by axis except the first: ranks inside at least one box
    std::vector<RankSet> inner_;  ///< by axis except the first: ranks inside all boxes
    double largest_ = 0;          ///< scale times the section of the largest boxes
    double smallest_ = 0;         ///< scale times the section of the smallest boxes
    std::array<bool, longest_stretch> useful_{};  ///< results of find_useful(), by index in the run
};

/// Cell of all boxes of one side. A cell has three ranges for every axis except the first: ranks
/// where a box begins, ranks where it ends, and whether it wraps, 0 or 1.
Cell whole_cell(const BoxGrid& grid, Side side) {
    Cell cell{.side = side, .bound = 1, .lo = {}, .hi = {}};
    cell.lo.assign(parts * (grid.dimension() - 1), 0);
    for (std::size_t k = 1; k < grid.dimension(); ++k) {
        const auto last = static_cast<std::uint32_t>(grid.values[k].size() - 1);
        cell.hi.insert(cell.hi.end(), {last, last, grid.torus() ? 1U : 0U});
    }
    return cell;
}

/// Line of all points, undecided.
Line whole_line(const BoxGrid& grid) {
    Line line;
    line.entries.reserve(grid.count);
    for (const std::uint32_t i : grid.order[0])
        line.entries.push_back({grid.values[0][grid.ranks[0][i]], i, 0, 1});
    return line;
}

class FreeBoxes final : public Problem {
  public:
    FreeBoxes(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run)
        : grid_(grid), line_(whole_line(grid)), limits_(limits), run_(run) {}

    [[nodiscard]] std::vector<Cell> all_cells() const override {
        std::vector<Cell> cells{whole_cell(grid_, Side::open)};
        if (grid_.measure == Measure::discrepancy) cells.push_back(whole_cell(grid_, Side::closed));
        return cells;
    }

    void explore(Task& task) const override {
        CellBounder bounder(grid_, task.worst);
        Explorer(bounder, line_, task, limits_, run_).explore();
    }

  private:
    const BoxGrid& grid_;
    const Line line_;
    const SearchLimits& limits_;
    const RunContext& run_;
};

// An interval is the difference of two intervals that begin at 0, plus the whole axis if it wraps.
// So the indicator function of a box is a signed sum of those of up to 2^d anchored boxes; on the
// torus 3^d - 1, as the whole space has no discrepancy. This many times the star discrepancy bounds
// the other discrepancies.

/// Grid for anchored boxes; on the torus, coordinates 1 become 0.
BoxGrid anchored_grid(const PointSet& points, Family family, const RunContext& run) {
    PointSet moved = points;
    if (family == Family::torus)
        for (double& x : moved.flat())
            if (x == 1) x = 0;
    return box_grid(moved, Family::anchored, run);
}

/// Upper bound on the ratio of a family's discrepancy to the star discrepancy, rounded up.
double factor(Family family, double dimension) {
    return (family == Family::cube ? std::pow(2, dimension) : std::pow(3, dimension) - 1) *
           (1 + 0x1p-50);
}

/// Upper bound of a family's discrepancy from a star discrepancy search within the limits `share`.
double star_bound(const PointSet& points, Family family, const SearchLimits& share,
                  const RunContext& run) {
    const auto d = static_cast<double>(points.dimension());
    const auto n = static_cast<double>(points.count());
    if (d < 2) return 1;
    const BoxGrid grid = anchored_grid(points, family, run);
    const double known = star::quick_bound(grid, run, factor(family, 1), factor(family, d));
    const double promised = 0.6 * std::sqrt(d / n);  // approximate discrepancy of random points
    if ((d > 2 && factor(family, d) * promised >= 1) || run.stop.stop_requested()) return known;
    const SearchResult found =
        d > 2 ? star::find_worst(grid, share, run) : star::sweep_2d(grid, share, run);
    return std::min(known, factor(family, d) * found.upper);
}

/// Limits for star_bound(): a tenth of the search's work and time; without a deadline, little work.
SearchLimits share_for_bound(const SearchLimits& limits, const RunContext& run) {
    constexpr double part = 0.1;
    constexpr std::uint64_t short_work = 1U << 27;
    SearchLimits share{.work = limits.work / 10, .deadline = limits.deadline, .tolerance = 0.05};
    if (limits.timed())
        share.deadline = run.seconds() + part * (limits.deadline - run.seconds());
    else
        share.work = std::min(share.work, short_work);
    return share;
}

}  // namespace

double search_memory(const PointSet& points, unsigned threads) {
    // A thread keeps a Line for each nested split; about 2 d splits deeper, Lines are half as long.
    const auto d = static_cast<double>(points.dimension());
    const double lines = std::min(3 * d + 2, 24.0);
    const double per_point = d * static_cast<double>(axis_bytes(false)) + 40 +
                             lines * static_cast<double>(sizeof(Entry) * threads);
    return static_cast<double>(points.count()) * per_point;
}

SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, double upper) {
    FreeBoxes problem(grid, limits, run);
    return branch_and_bound(problem, grid, {.worst = std::move(worst), .upper = upper}, limits, run,
                            nullptr);
}

SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        double upper) {
    const Ascent first = ascend(grid, limits, run);
    return search(grid, first.worst, limits.after(first.work), run, upper);
}

SearchResult find_worst(const PointSet& points, const BoxGrid& grid, const SearchLimits& limits,
                        const RunContext& run) {
    const SearchLimits share = share_for_bound(limits, run);
    const double upper = star_bound(points, grid.family, share, silent(run));
    return find_worst(grid, limits.after(share.work), run, upper);
}

double quick_bound(const PointSet& points, Family family, const RunContext& run) {
    const BoxGrid grid = anchored_grid(points, family, unstopped(run));
    const auto d = static_cast<double>(points.dimension());
    return star::quick_bound(grid, run, factor(family, 1), factor(family, d));
}

}  // namespace stipple::discrepancy::extreme
