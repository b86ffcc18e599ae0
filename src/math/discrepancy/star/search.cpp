// SPDX-License-Identifier: MIT
//
// Branch and bound for anchored boxes. With many points, cells take long to become small, so a
// first upper bound comes from a grid cover, or from a net if the points form one. From time to
// time a threshold search looks for worse boxes, which exploring the cells would find only late. A
// cell consists of all boxes with an upper corner y, lo <= y <= hi.
//
// Points below lo on all axes are in every box of a cell. Points that are not below hi on some axis
// are in none. The others are undecided, on the axes on which they are not below lo. Let O(y) be
// the number of points in the open box of y, C(y) that in the closed one and V(y) their volume.
// Some undecided points are assigned to an axis; c_j(y_j) is the number of those of axis j that are
// below y_j. Then
//
//     open     V(y) - O(y)/n <= V(hi) - O(lo)/n - sum_j min over y_j of [step_j(y_j) + c_j(y_j)/n]
//     closed   C(y)/n - V(y) <= C(lo)/n - base  - sum_j min over y_j of [step_j(y_j) - c_j(y_j)/n]
//
// For open boxes, points undecided on a single axis are assigned to it. For closed boxes all are
// assigned, each to the axis on which the step up to it is about the largest. The steps are
//
//     open         step_j = (log hi_j - log y_j) (V(hi) - m) / (log V(hi) - log m)
//     closed       step_j = (log y_j - log lo_j) v,            base = v (1 + log V(lo) - log v)
//
// For open boxes, V(hi) - sum_j step_j is the chord of exp between log m and log V(hi), an upper
// bound of V(y) if V(y) >= m. Any box worse than the worst known value D has V(y) > m = D +
// O(lo)/n. For closed boxes, base + sum_j step_j is the tangent of exp at log v, a lower bound of
// V(y). v is chosen between V(lo) and the largest V(y) of a box worse than D; if V(lo) is 0, all
// steps are 0. As the bounds are sums over the axes, y_j is excluded if its term exceeds the
// smallest one by more than the bound exceeds D.
//
// On each axis only the coordinates of the cell's points matter, the candidates: a worst open box
// cannot grow without including a point (or reaches 1), and a worst closed one cannot shrink
// without losing one.
//
// Source  the bounds are original; earlier exact methods are surveyed in C. Doerr, M. Gnewuch, M.
//         Wahlstroem, arXiv:1405.1653.
#include "math/discrepancy/star/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "math/discrepancy/branch_and_bound.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::discrepancy::star {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tiny = 1e-300;

/// Bit of a bin, see fill_bins(), that marks its rank as a candidate. The other bits count points.
constexpr std::uint32_t candidate = std::uint32_t{1} << 31;

/// Number of bins before those of the ranks on an axis, for points that do not count on this axis.
/// Several bins, because incrementing the same one repeatedly is slow.
constexpr std::int32_t dummy_bins = 16;

/// The upper bits of a point's state count the axes on which it is undecided. The lower bits are
/// twice the number of axes on which it is above hi, plus the number on which it is at hi.
constexpr int undecided_bits = 16;
constexpr std::int32_t undecided_unit = 1 << undecided_bits;

/// The points that can affect a cell, with ranks stored axis by axis; `decided` is the number of
/// points that are inside all boxes of the cell and were dropped.
struct Active {
    std::size_t size = 0;
    /// Number of points below hi on all axes. These come first; the others are on a face at hi.
    std::size_t inside = 0;
    std::uint64_t decided = 0;
    std::vector<std::int32_t> ranks;

    [[nodiscard]] const std::int32_t* axis(std::size_t k) const { return ranks.data() + k * size; }
};

std::int32_t signed_rank(std::uint32_t place) { return static_cast<std::int32_t>(place); }

STIPPLE_WIDE void compare(const std::int32_t* ranks, std::size_t size, std::int32_t lo,
                          std::int32_t hi, std::int32_t* state) {
    for (std::size_t i = 0; i < size; ++i)
        state[i] += (ranks[i] >= hi ? 1 : 0) + (ranks[i] > hi ? 1 : 0) +
                    (ranks[i] >= lo ? undecided_unit : 0);
}

/// Assigns points to `axis` if `price` times their number of ranks above `lo` exceeds their `cost`.
STIPPLE_WIDE void assign_to(const std::int32_t* ranks, std::size_t size, std::int32_t lo,
                            float price, std::int32_t axis, float* cost, std::int32_t* axes) {
    for (std::size_t i = 0; i < size; ++i) {
        const float here = static_cast<float>(ranks[i] + 1 - lo) * price;
        const bool more = here > cost[i];
        cost[i] = more ? here : cost[i];
        axes[i] = more ? axis : axes[i];
    }
}

STIPPLE_WIDE void gather(const std::int32_t* from, const std::uint32_t* kept, std::size_t size,
                         std::int32_t* to) {
    for (std::size_t i = 0; i < size; ++i) to[i] = from[kept[i]];
}

/// Sets terms[i] = (values[ranks[i]] - origin) * weight + counts[i] * inverse; returns the minimum.
STIPPLE_WIDE double fill_terms(const double* values, const std::int32_t* ranks,
                               const std::int32_t* counts, std::size_t size, double origin,
                               double weight, double inverse, double* terms) {
    for (std::size_t i = 0; i < size; ++i)
        terms[i] = (values[ranks[i]] - origin) * weight + counts[i] * inverse;
    double least = infinity;
    for (std::size_t i = 0; i < size; ++i) least = std::min(least, terms[i]);
    return least;
}

/// The box of a corner y ends at the rank y - shift.
template <Side side>
constexpr std::uint32_t shift = side == Side::open ? 0 : 1;

template <Side side>
class CellBounder {
  public:
    using Points = Active;
    using Axes = std::vector<std::vector<double>>;

    /// Keeps references to all arguments.
    CellBounder(const BoxGrid& grid, const Axes& logs, WorstBox& worst, const RunContext& run)
        : grid_(grid),
          logs_(logs),
          worst_(worst),
          run_(run),
          d_(grid.dimension()),
          inverse_(1 / static_cast<double>(grid.count)),
          rounding_(static_cast<double>((d_ + 8) * (d_ + 8)) * 0x1p-52),
          bins_(d_),
          candidates_(d_),
          terms_(d_),
          least_(d_) {}

    /// Shrinks the cell to corners of boxes that may be worse than the worst known one. Offers its
    /// largest open or smallest closed box on the way. Copies the relevant points of `from` to
    /// `mine`. Returns false if nothing is left to split.
    bool tighten(Cell& cell, const Active& from, Active& mine) {
        filter(cell, from, mine);
        while (true) {
            run_.check_stop();
            count(cell, mine);
            seen_ = cell;
            if (!reduce(seen_, cell)) return false;
            if (cell.lo == seen_.lo && cell.hi == seen_.hi) return cell.lo != cell.hi;
            filter(cell, mine, mine);
        }
    }

    /// Halves the cell last tightened along split_axis(); removes and returns the lower half.
    Cell split(Cell& cell) const {
        const std::size_t axis = split_axis(cell);
        const auto bins = std::span(bins_[axis]).subspan(dummy_bins);
        const auto is_candidate = [](std::uint32_t bin) { return (bin & candidate) != 0; };
        auto half = std::ranges::count_if(bins, is_candidate) / 2;
        Cell lower = cell;
        std::uint32_t y = 0;
        for (; half > 0 || !is_candidate(bins[y]); ++y) {
            if (!is_candidate(bins[y])) continue;
            --half;
            lower.hi[axis] = cell.lo[axis] + y;
        }
        cell.lo[axis] += y;
        return lower;
    }

    /// Comparisons of coordinates and ranks so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

  private:
    /// Candidates for y on an axis: ranks relative to lo, and counts c_k(y), negative for closed
    /// boxes. Vectors may be longer than `size`.
    struct Candidates {
        std::size_t size = 0;
        std::vector<std::int32_t> ranks;
        std::vector<std::int32_t> counts;
    };

    struct Anchor {
        double bound;
        double weight;  ///< factor of the difference of logarithms in the terms
        double margin;  ///< exceeds the rounding errors of the bound and of the terms
    };

    double value(std::size_t k, std::uint32_t y) const { return grid_.values[k][y - shift<side>]; }

    /// Copies the points of `from` that can matter in the cell; `from` and `mine` may be the same.
    void filter(const Cell& cell, const Active& from, Active& mine) {
        const std::size_t size = from.size;
        state_.assign(size, 0);
        for (std::size_t k = 0; k < d_; ++k) {
            run_.check_stop();
            compare(from.axis(k), size, signed_rank(cell.lo[k]), signed_rank(cell.hi[k]),
                    state_.data());
        }
        work_ += size * d_;
        select(cell, from, mine);
        packed_.resize(kept_.size() * d_);
        for (std::size_t k = 0; k < d_; ++k)
            gather(from.axis(k), kept_.data(), kept_.size(), packed_.data() + k * kept_.size());
        mine.ranks.swap(packed_);
        mine.size = kept_.size();
    }

    /// Sets kept_ to the points to keep, first those below hi on all axes, and state_ to the number
    /// of axes on which these are undecided. Points inside all boxes are dropped and counted in
    /// mine.decided, unless they make a coordinate a candidate (ends_at_lo()).
    void select(const Cell& cell, const Active& from, Active& mine) {
        kept_.resize(from.size);
        on_face_.resize(side == Side::open ? from.size : 0);
        std::size_t inside = 0;
        std::size_t on_face = 0;
        std::uint64_t decided = 0;
        for (std::uint32_t i = 0; i < from.size; ++i) {  // no branches: they would be unpredictable
            const std::int32_t over = state_[i] & (undecided_unit - 1);
            const std::int32_t undecided = state_[i] >> undecided_bits;
            if constexpr (side == Side::open) {
                on_face_[on_face] = i;
                on_face += over == 1 ? 1 : 0;
            }
            const bool sure = over == 0 && undecided == 0;
            const bool decides = sure && !ends_at_lo(cell, from, i);
            decided += decides ? 1 : 0;
            state_[inside] = undecided;
            kept_[inside] = i;
            inside += over == 0 && !decides ? 1 : 0;
        }
        mine.decided = from.decided + decided;
        kept_.resize(inside);
        kept_.insert(kept_.end(), on_face_.begin(),
                     on_face_.begin() + static_cast<std::ptrdiff_t>(on_face));
        mine.inside = inside;
    }

    /// For a point inside all closed boxes: returns whether the box of `lo` ends at it on some
    /// axis. Then its coordinate there is a candidate, so the point must be kept.
    bool ends_at_lo(const Cell& cell, const Active& from, std::size_t i) const {
        if (side == Side::open) return false;
        for (std::size_t k = 0; k < d_; ++k)
            if (from.axis(k)[i] + 1 == signed_rank(cell.lo[k])) return true;
        return false;
    }

    /// Counts the points inside the boxes of lo and hi, and sorts the active points into bins.
    /// Offers the open box of hi or the closed box of lo.
    void count(const Cell& cell, const Active& active) {
        inside_lo_ = active.decided;
        for (std::size_t i = 0; i < active.inside; ++i) inside_lo_ += state_[i] == 0 ? 1U : 0U;
        inside_hi_ = active.decided + active.inside;
        if (side == Side::closed) assign(cell, active);
        for (std::size_t k = 0; k < d_; ++k) {
            fill_bins(cell, active, k);
            list_candidates(k);
            work_ += active.size + bins_[k].size();
        }
        if (side == Side::open)
            offer(cell.hi, inside_hi_);
        else
            offer(cell.lo, inside_lo_);
    }

    /// Assigns each point to an axis, or to -1 for none. Only for closed boxes: in open ones, a
    /// point undecided on a single axis belongs to that axis.
    void assign(const Cell& cell, const Active& active) {
        const std::size_t inside = active.inside;
        axes_.assign(inside, -1);
        cost_.assign(inside, 0);
        for (std::size_t k = 0; k < d_; ++k) {
            const double low = std::max(value(k, cell.lo[k]), tiny);
            const double steps = cell.hi[k] - cell.lo[k] + 1;
            const double price =
                logarithm(value(k, cell.hi[k]) / low + 1e-9) / steps;  // approximate
            assign_to(active.axis(k), inside, signed_rank(cell.lo[k]),
                      std::max(1e-30F, static_cast<float>(price)), static_cast<std::int32_t>(k),
                      cost_.data(), axes_.data());
        }
    }

    /// Fills bins_[k][dummy_bins + y - lo] with the number of points assigned to axis k that end a
    /// box at y, and with a mark if any point, assigned or not, makes y a candidate.
    void fill_bins(const Cell& cell, const Active& active, std::size_t k) {
        auto& bins = bins_[k];
        bins.assign(dummy_bins + (cell.hi[k] - cell.lo[k] + 1), 0);
        const std::int32_t* ranks = active.axis(k);
        const auto axis = static_cast<std::int32_t>(k);
        const std::int32_t start = signed_rank(cell.lo[k]) - signed_rank(shift<side>) - dummy_bins;
        for (std::size_t i = 0; i < active.inside; ++i) {
            const std::int32_t at =
                std::max(ranks[i] - start, static_cast<std::int32_t>(i % dummy_bins));
            auto& bin = bins[static_cast<std::size_t>(at)];
            // Open boxes: if the point is undecided only on another axis, `at` is a dummy bin.
            const bool assigned = side == Side::open ? state_[i] == 1 : axes_[i] == axis;
            bin = (bin + (assigned ? 1U : 0U)) | candidate;
        }
        for (std::size_t i = active.inside; i < active.size; ++i)
            if (ranks[i] == signed_rank(cell.hi[k])) bins.back() |= candidate;
        if (side == Side::open && cell.hi[k] + 1 == grid_.values[k].size())
            bins.back() |= candidate;
    }

    /// Lists the candidates of an axis, with c_k(y) for open boxes and -c_k(y) for closed ones. An
    /// open box excludes the points at its end, a closed one includes them.
    void list_candidates(std::size_t k) {
        const auto bins = std::span(bins_[k]).subspan(dummy_bins);
        auto& [found, ranks, counts] = candidates_[k];
        if (ranks.size() <= bins.size()) {
            ranks.resize(bins.size() + 1);
            counts.resize(ranks.size());
            terms_[k].resize(ranks.size());
        }
        std::size_t size = 0;
        std::int32_t points = 0;
        for (std::size_t y = 0; y < bins.size(); ++y) {
            const std::int32_t before = points;
            points += static_cast<std::int32_t>(bins[y] & ~candidate);
            ranks[size] = static_cast<std::int32_t>(y);
            counts[size] = side == Side::open ? before : -points;
            size += bins[y] / candidate;
        }
        found = size;
    }

    void offer(const std::vector<std::uint32_t>& y, std::uint64_t points) {
        corner_ = y;
        for (auto& rank : corner_) rank -= shift<side>;
        worst_.offer(side, corner_, points);
    }

    /// Bound of a cell before subtracting the terms of its axes.
    Anchor anchor(const Cell& cell) const {
        double low = 0;  // logarithms of the smallest and largest volumes
        double high = 0;
        for (std::size_t k = 0; k < d_; ++k) {
            low += logs_[k][cell.lo[k] - shift<side>];
            high += logs_[k][cell.hi[k] - shift<side>];
        }
        const double share = static_cast<double>(inside_lo_) * inverse_;
        if (side == Side::open) {
            const double most = exponential(high);
            const double margin = rounding_ + most * -high * rounding_;
            return {most - share + margin, -chord(exponential(low), most), margin};
        }
        if (low == -infinity) return {share + rounding_, 0, rounding_};  // the tangent is undefined
        const double most = static_cast<double>(inside_hi_) * inverse_ - worst_.value();
        const double top = std::min(high, logarithm(std::max(most, tiny)));
        const double at = low + 0.6 * std::max(0.0, top - low);  // 0.6 was found by trial
        const double weight = exponential(at);
        const double margin = rounding_ + weight * -low * rounding_;
        return {share - weight * (1 + low - at) + margin, weight, margin};
    }

    /// Bounds the cell `seen`, and removes from `cell` the corners that the bound excludes; returns
    /// false if it excludes all.
    bool reduce(const Cell& seen, Cell& cell) {
        const auto [before, weight, margin] = anchor(seen);
        double bound = before;
        for (std::size_t k = 0; k < d_; ++k) {
            const auto& [size, ranks, counts] = candidates_[k];
            const auto& axis = weight == 0 ? grid_.values[k] : logs_[k];  // avoids 0 times infinity
            const double* first = axis.data() + seen.lo[k] - shift<side>;
            const double origin = side == Side::open ? first[seen.hi[k] - seen.lo[k]] : first[0];
            least_[k] = fill_terms(first, ranks.data(), counts.data(), size, origin, weight,
                                   inverse_, terms_[k].data());
            bound -= least_[k];
        }
        cell.bound = std::min(cell.bound, bound);
        if (!(bound >= worst_.value())) return false;
        for (std::size_t k = 0; k < d_; ++k)
            if (!cut_ends(k, least_[k] + (bound - worst_.value()) + margin, seen, cell))
                return false;
        return true;
    }

    /// Slope of the chord of exp from log m to log high, rounded down.
    double chord(double low, double high) const {
        const double floor = worst_.value() + static_cast<double>(inside_lo_) * inverse_;
        const double m = std::max({low, floor * (1 - 1e-12), tiny});
        // The slope is the logarithmic mean. The geometric mean is slightly smaller, and
        // numerically safe near m = high.
        if (m > 0.999 * high) return std::sqrt(std::min(m, high) * high) * (1 - 1e-12);
        return (high - m) / logarithm(high / m) * (1 - 1e-12);
    }

    /// Narrows the cell on axis k to its outermost candidates with terms of at most `most`. Returns
    /// false if there are no such candidates.
    bool cut_ends(std::size_t k, double most, const Cell& seen, Cell& cell) {
        const Candidates& candidates = candidates_[k];
        const auto rank = [&](std::size_t i) {
            return seen.lo[k] + static_cast<std::uint32_t>(candidates.ranks[i]);
        };
        const auto out = [&](std::size_t i) { return !(terms_[k][i] <= most); };
        std::size_t first = 0;
        while (first < candidates.size && (rank(first) < cell.lo[k] || out(first))) ++first;
        std::size_t last = candidates.size;
        while (last > first && (rank(last - 1) > cell.hi[k] || out(last - 1))) --last;
        if (first == last) return false;
        cell.lo[k] = rank(first);
        cell.hi[k] = rank(last - 1);
        return true;
    }

    std::size_t split_axis(const Cell& cell) const {
        double volume = 1;
        for (std::size_t k = 0; k < d_; ++k) volume *= value(k, cell.hi[k]);
        std::size_t axis = 0;
        double most = -1;
        for (std::size_t k = 0; k < d_; ++k) {
            if (cell.lo[k] == cell.hi[k]) continue;
            std::uint32_t points = 0;
            for (const auto bin : std::span(bins_[k]).subspan(dummy_bins))
                points += bin & ~candidate;
            const double width = 1 - value(k, cell.lo[k]) / value(k, cell.hi[k]);
            const double weight = width * volume + points * inverse_ / 2;
            if (weight <= most) continue;
            most = weight;
            axis = k;
        }
        return axis;
    }

    const BoxGrid& grid_;
    const Axes& logs_;
    WorstBox& worst_;
    const RunContext& run_;
    std::size_t d_;
    double inverse_;   ///< 1 / n
    double rounding_;  ///< exceeds the rounding errors of a bound
    std::uint64_t work_ = 0;

    // State of the current cell.
    std::uint64_t inside_lo_ = 0;                   ///< points inside the box of lo
    std::uint64_t inside_hi_ = 0;                   ///< points inside the box of hi
    std::vector<std::vector<std::uint32_t>> bins_;  ///< see fill_bins
    std::vector<Candidates> candidates_;            ///< by axis
    Axes terms_;                                    ///< terms of the bound, for each candidate
    std::vector<double> least_;                     ///< smallest term of each axis

    // Scratch space.
    std::vector<std::int32_t> state_;
    std::vector<std::uint32_t> kept_;
    std::vector<std::uint32_t> on_face_;
    std::vector<std::int32_t> packed_;
    std::vector<std::int32_t> axes_;
    std::vector<float> cost_;
    std::vector<std::uint32_t> corner_;
    Cell seen_{};
};

/// Cell of all corners of one side. A cell contains the corners lo <= y <= hi. On axis k, y means
/// values[k][y] for open boxes and values[k][y - 1] for closed ones, so that on both sides a point
/// is inside if its rank is below y.
Cell whole_cell(const BoxGrid& grid, Side side) {
    Cell cell{.side = side, .bound = 1, .lo = {}, .hi = {}};
    const std::uint32_t shift = side == Side::open ? 0 : 1;
    for (const auto& values : grid.values) {
        cell.lo.push_back(shift);
        cell.hi.push_back(static_cast<std::uint32_t>(values.size()) - 1 + shift);
    }
    return cell;
}

/// All points, undecided.
Active all_points(const BoxGrid& grid) {
    Active all{.size = grid.count, .inside = 0, .decided = 0, .ranks = {}};
    for (const auto& ranks : grid.ranks)
        all.ranks.insert(all.ranks.end(), ranks.begin(), ranks.end());
    return all;
}

/// Logarithms of the grid's values, by axis.
std::vector<std::vector<double>> logarithms(const BoxGrid& grid) {
    auto logs = grid.values;
    for (auto& axis : logs)
        for (double& x : axis) x = x > 0 ? logarithm(x) : -infinity;
    return logs;
}

class AnchoredBoxes final : public Problem {
  public:
    AnchoredBoxes(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run)
        : grid_(grid),
          logs_(logarithms(grid)),
          points_(all_points(grid)),
          limits_(limits),
          run_(run) {}

    [[nodiscard]] std::vector<Cell> all_cells() const override {
        return {whole_cell(grid_, Side::open), whole_cell(grid_, Side::closed)};
    }

    void explore(Task& task) const override {
        const auto on_side = [&]<Side side>() {
            CellBounder<side> bounder(grid_, logs_, task.worst, run_);
            Explorer(bounder, points_, task, limits_, run_).explore();
        };
        task.cell.side == Side::open ? on_side.template operator()<Side::open>()
                                     : on_side.template operator()<Side::closed>();
    }

    [[nodiscard]] bool by_stages(const Known& known) const override {
        constexpr std::uint64_t part = 64;  // tries for the exact value with limits.work / part
        return limits_.wants_bounds() ||
               known.work > std::max(SearchLimits::short_work, limits_.work / part);
    }

    void look_around(Known& known, std::uint64_t work) override {
        constexpr std::uint64_t short_work = SearchLimits::short_work;
        if (known.work > short_work / 4) look_quickly(known.worst, known.upper);
        // The total work is at least this multiple of the work of threshold searches.
        constexpr std::uint64_t searches_apart = 16;
        if (known.work > short_work && searches_apart * threshold_work_ < known.work) {
            const std::uint64_t cost =
                accept_thresholds(grid_, rounds_, known.worst, limits_, run_);
            ++rounds_;
            threshold_work_ += cost;
            known.work += cost;
        }
        if (!covered_ && (limits_.wants_bounds() || known.work > short_work)) cover(known, work);
    }

    /// Computes the cheapest bounds, once.
    void look_quickly(WorstBox& worst, double& upper) {
        if (std::exchange(looked_, true)) return;
        offer_axis_boxes(grid_, worst);
        upper = std::max(worst.value(), std::min(upper, quick_bound(grid_, run_)));
    }

  private:
    /// Computes an upper bound with about an eighth of the remaining work or time.
    void cover(Known& known, std::uint64_t work) {
        covered_ = true;
        constexpr double corners_a_second = 1e8;
        const std::uint64_t d = grid_.dimension();
        std::uint64_t corners = std::uint64_t{1} << 25;
        corners = std::min(corners, (work - std::min(known.work, work)) / (16 * d));
        corners = std::min(corners, run_.max_memory / 16);
        if (!limits_.wants_bounds()) corners = std::min(corners, known.work / (16 * d));
        if (limits_.wants_bounds() && run_.seconds)
            corners = static_cast<std::uint64_t>(
                std::clamp((limits_.deadline - run_.seconds()) / 16 * corners_a_second, 0.0,
                           static_cast<double>(corners)));
        known.upper = std::min(known.upper, cover_bound(grid_, corners, run_));
        known.upper = std::min(known.upper, net_bound(grid_, known.upper, corners * d, run_));
        known.work += 2 * corners * d;
    }

    const BoxGrid& grid_;
    const std::vector<std::vector<double>> logs_;
    const Active points_;
    const SearchLimits& limits_;
    const RunContext& run_;
    std::uint64_t rounds_ = 0;  ///< rounds of threshold accepting so far
    std::uint64_t threshold_work_ = 0;
    bool looked_ = false;
    bool covered_ = false;
};

}  // namespace

double quick_bound(const BoxGrid& grid, const RunContext& run, double of_axis, double of_all) {
    constexpr std::uint64_t few_corners = 1U << 17;
    return std::min(axis_bound(grid, of_axis),
                    of_all * cover_bound(grid, few_corners, unstopped(run)));
}

SearchResult search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                    const RunContext& run, Peers* peers) {
    AnchoredBoxes problem(grid, limits, run);
    SearchResult found =
        branch_and_bound(problem, grid, {.worst = std::move(worst)}, limits, run, peers);
    if (found.ending != Ending::complete) problem.look_quickly(found.worst, found.upper);
    return found;
}

SearchResult sweep_or_search(const BoxGrid& grid, WorstBox worst, const SearchLimits& limits,
                             const RunContext& run) {
    if (grid.dimension() == 1) return sweep_1d(grid, run);
    if (grid.dimension() == 2) return sweep_2d(grid, limits, run);
    return search(grid, std::move(worst), limits, run);
}

SearchResult find_worst(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run,
                        Peers* peers) {
    const Ascent first = ascend(grid, limits, run);
    return search(grid, first.worst, limits.after(first.work), run, peers);
}

double search_bytes(std::size_t count, std::size_t dimension, unsigned threads) {
    // Each thread keeps the points of its first cell and of all smaller cells down to the current
    // one. The smaller cells have together about as many points as the first. A third copy covers
    // the scratch space of the bounds.
    constexpr double copies = 3;
    return (1 + copies * threads) * static_cast<double>(count) * static_cast<double>(dimension) *
           sizeof(std::int32_t);
}

}  // namespace stipple::discrepancy::star
