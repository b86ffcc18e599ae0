// SPDX-License-Identifier: MIT
//
// Discrepancies and dispersion in any dimension over a pool of boxes near the worst. Each box is
// given by the points at its sides and moves with them:
//
//     open    V - c / n     c = number of points inside             (dispersion: V if c = 0)
//     closed  c / n - V     c = number of points inside or on a side
//
// Each evaluation runs ascents from boxes of the pool, from variants of them and from random boxes,
// to find new boxes for the pool. An ascent replaces a box's interval on one axis after the other
// by the worst one, until none is worse. The value is that of the worst box found, a lower bound.
#include <algorithm>
#include <numeric>
#include <vector>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "generators/optimized/objective.hpp"
#include "math/combinatorics/order.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "math/discrepancy/empty_rectangle.hpp"
#include "math/discrepancy/extreme/search.hpp"
#include "math/discrepancy/star/search.hpp"
#include "math/discrepancy/worst_interval.hpp"
#include "math/functions/exponential.hpp"

namespace stipple::optimized {
namespace {

using namespace discrepancy;

/// Clears the marks of points whose coordinate x is not in (low, high).
STIPPLE_WIDE void keep_between(const double* x, double low, double high, std::size_t size,
                               std::int64_t* inside) {
    for (std::size_t i = 0; i < size; ++i)
        inside[i] &= std::int64_t{x[i] > low} & std::int64_t{x[i] < high};
}

/// Clears the marks of points whose coordinate x is not in [low, high].
STIPPLE_WIDE void keep_within(const double* x, double low, double high, std::size_t size,
                              std::int64_t* inside) {
    for (std::size_t i = 0; i < size; ++i)
        inside[i] &= std::int64_t{x[i] >= low} & std::int64_t{x[i] <= high};
}

/// Indices of the points at the lower and upper side of a box on one axis; the index `rim` means 0
/// for the lower side and 1 for the upper.
struct Sides {
    std::uint32_t lower;
    std::uint32_t upper;
    auto operator<=>(const Sides&) const = default;
};

struct PoolBox {
    bool open = true;
    std::vector<Sides> axes = {};
    double value = 0;

    [[nodiscard]] bool same(const PoolBox& other) const {
        return open == other.open && axes == other.axes;
    }
};

/// Worst box by the exact search, started from a known box and limited to `work` comparisons.
SearchResult worst_of_all(const BoxGrid& grid, const WorstBox& known, std::uint64_t work,
                          const RunContext& run) {
    const SearchLimits limits{.work = work};
    if (grid.family == Family::anchored) return star::sweep_or_search(grid, known, limits, run);
    if (grid.measure == Measure::emptiness && grid.dimension() == 2)
        return largest_empty_rectangle(grid, {}, run);
    return extreme::search(grid, known, limits, run);
}

class BoxObjective final : public Objective {
  public:
    BoxObjective(Family family, bool empty, const std::vector<double>& weights, std::size_t count,
                 std::size_t dimension)
        : n_(count),
          d_(dimension),
          rim_(static_cast<std::uint32_t>(count)),
          family_(family),
          empty_(empty),
          weights_(weights.empty() ? std::vector<double>(dimension, 1) : weights),
          order_(dimension),
          columns_(dimension),
          inside_(count) {}

    double value(std::span<const double> rows, double sharpness, std::span<double> gradient,
                 const RunContext& run) override {
        put_columns(rows);
        for (PoolBox& box : pool_) {
            run.check_stop();
            box.value = value_of(box);
        }
        ascend(sharpness, run);
        const double most = pool_.front().value;
        put_gradient(most, sharpness / most, gradient);
        return most;
    }

    double certain_value(std::span<const double> rows, double /*known*/,
                         const RunContext& run) override {
        if (std::ranges::any_of(weights_, [](double w) { return w != 1; })) {
            for (int k = 0; k < 20; ++k) ascend(1e6, run);
            return pool_.front().value;
        }
        const PointSet points(std::vector<double>(rows.begin(), rows.end()), d_);
        const BoxGrid grid =
            box_grid(points, family_, run, empty_ ? Measure::emptiness : Measure::discrepancy);
        WorstBox known(grid);
        for (std::size_t k = 0; k < std::min<std::size_t>(pool_.size(), 8); ++k)
            if (!grid.torus() || ends_at_points(pool_[k])) known.offer(grid_box(pool_[k], grid));
        const SearchResult found = worst_of_all(grid, known, SearchLimits::short_work, run);
        run.check_stop();  // a stopped search does not throw by itself
        pool_.push_back(pool_box(found.worst));
        return found.worst.value();
    }

    [[nodiscard]] double steps() const override {
        return 500.0 * static_cast<double>(n_ * d_);  // on average, with occasional exact searches
    }

  private:
    /// Boxes with weights below e^-reach in the soft maximum are ignored.
    static constexpr double reach = 7;
    static constexpr std::size_t ascents = 12;
    static constexpr std::size_t most_boxes = 1000;

    [[nodiscard]] GridBox grid_box(const PoolBox& box, const BoxGrid& grid) const {
        GridBox of{box.open ? Side::open : Side::closed, {}};
        for (std::size_t j = 0; j < d_; ++j) {
            const auto rank = [&](double x) {
                const auto& values = grid.values[j];
                return static_cast<std::uint32_t>(std::ranges::lower_bound(values, x) -
                                                  values.begin());
            };
            of.axes.push_back(
                {family_ == Family::anchored ? 0 : rank(low(box, j)), rank(high(box, j))});
        }
        return of;
    }

    /// Whether all sides of a box are at points, none at 0 or 1. A torus's grid has no sides there,
    /// as such boxes duplicate others.
    [[nodiscard]] bool ends_at_points(const PoolBox& box) const {
        return std::ranges::none_of(box.axes, [&](const Sides& sides) {
            return sides.lower == rim_ || sides.upper == rim_;
        });
    }

    /// Converts a box of the grid to a box that is given by the points at its sides.
    [[nodiscard]] PoolBox pool_box(const WorstBox& worst) const {
        PoolBox box{.open = !worst.closed()};
        const std::vector<double> low = worst.corner(&Interval::lower);
        const std::vector<double> high = worst.corner(&Interval::upper);
        for (std::size_t j = 0; j < d_; ++j) {
            const auto at = [&](double x) {
                const auto found = std::ranges::find(columns_[j].begin(), columns_[j].end(), x);
                return static_cast<std::uint32_t>(found - columns_[j].begin());
            };
            box.axes.push_back({family_ == Family::anchored ? rim_ : at(low[j]), at(high[j])});
        }
        return box;
    }

    /// Coordinate in the grid: on the torus, 1 becomes 0.
    [[nodiscard]] double place(double x) const {
        return family_ == Family::torus && x == 1 ? 0 : x;
    }

    void put_columns(std::span<const double> rows) {
        for (std::size_t j = 0; j < d_; ++j) {
            columns_[j].resize(n_);
            for (std::size_t i = 0; i < n_; ++i) columns_[j][i] = place(rows[i * d_ + j]);
            order_[j] = order_by(n_, [&](std::uint32_t i) { return columns_[j][i]; });
        }
    }

    [[nodiscard]] double low(const PoolBox& box, std::size_t j) const {
        return box.axes[j].lower == rim_ ? 0 : columns_[j][box.axes[j].lower];
    }
    [[nodiscard]] double high(const PoolBox& box, std::size_t j) const {
        return box.axes[j].upper == rim_ ? 1 : columns_[j][box.axes[j].upper];
    }
    [[nodiscard]] bool wraps(const PoolBox& box, std::size_t j) const {
        if (family_ != Family::torus) return false;
        return box.open ? low(box, j) >= high(box, j) : low(box, j) > high(box, j);
    }
    [[nodiscard]] double length(const PoolBox& box, std::size_t j) const {
        return std::max(high(box, j) - low(box, j) + (wraps(box, j) ? 1 : 0), 0.0);
    }
    [[nodiscard]] double volume(const PoolBox& box) const {
        double product = 1;
        for (std::size_t j = 0; j < d_; ++j) product *= length(box, j);
        return product;
    }
    /// Weight of an axis. A box that ends at 1 (`at_rim`) has the weight 1, or that of the boxes
    /// that end just below 1 if it is larger.
    [[nodiscard]] double weight(std::size_t j, bool at_rim) const {
        return at_rim ? std::max(1.0, weights_[j]) : weights_[j];
    }
    [[nodiscard]] double weight(const PoolBox& box) const {
        double product = 1;
        for (std::size_t j = 0; j < d_; ++j) product *= weight(j, box.axes[j].upper == rim_);
        return product;
    }

    /// Marks the points inside a box on all axes except `but`.
    void mark_inside(const PoolBox& box, std::size_t but) {
        std::ranges::fill(inside_, std::int64_t{1});
        for (std::size_t j = 0; j < d_; ++j) {
            if (j == but) continue;
            double from = low(box, j);
            double to = high(box, j);
            if (box.axes[j].lower == rim_ && box.axes[j].upper == rim_ && !wraps(box, j)) continue;
            if (box.axes[j].lower == rim_) from = -1;
            if (!wraps(box, j)) {
                (box.open ? keep_between : keep_within)(columns_[j].data(), from, to, n_,
                                                        inside_.data());
                continue;
            }
            for (std::size_t i = 0; i < n_; ++i) {
                const double x = columns_[j][i];
                inside_[i] &= box.open ? x > from || x < to : x >= from || x <= to;
            }
        }
    }

    double value_of(const PoolBox& box) {
        mark_inside(box, d_);
        const auto points = std::accumulate(inside_.begin(), inside_.end(), std::int64_t{0});
        if (empty_) return points > 0 ? 0 : volume(box);
        const double share = static_cast<double>(points) / static_cast<double>(n_);
        return weight(box) * (box.open ? volume(box) - share : share - volume(box));
    }

    /// Sets a box's interval on one axis to the worst one; returns whether the box's value rises.
    bool improve(PoolBox& box, std::size_t axis) {
        mark_inside(box, axis);
        line_.clear();
        for (const std::uint32_t i : order_[axis])
            if (inside_[i] != 0) line_.push_back(i);
        double across = 1;
        for (std::size_t j = 0; j < d_; ++j)
            if (j != axis) across *= length(box, j);
        const PoolBox before = box;
        family_ == Family::anchored ? end_worst(box, axis, across) : lie_worst(box, axis, across);
        if (box.value > before.value) return true;
        box = before;
        return false;
    }

    /// Finds the worst upper end of an anchored box on one axis.
    void end_worst(PoolBox& box, std::size_t axis, double across) {
        double others = 1;
        for (std::size_t j = 0; j < d_; ++j)
            if (j != axis) others *= weight(j, box.axes[j].upper == rim_);
        const double share = 1 / static_cast<double>(n_);
        const auto& x = columns_[axis];
        for (std::size_t k = 0; k <= line_.size(); ++k) {
            const bool at_rim = k == line_.size();
            const double to = at_rim ? 1 : x[line_[k]];
            const double points = static_cast<double>(k + (box.open || at_rim ? 0 : 1)) * share;
            const double excess = box.open ? across * to - points : points - across * to;
            const double value = others * weight(axis, at_rim) * excess;
            if (value <= box.value) continue;
            box.value = value;
            box.axes[axis].upper = at_rim ? rim_ : line_[k];
        }
    }

    /// Finds the worst interval of a box on one axis, both ends free.
    void lie_worst(PoolBox& box, std::size_t axis, double across) {
        const double n = static_cast<double>(n_);
        const double each = empty_ ? 2 : 1 / n;
        const auto& x = columns_[axis];
        const discrepancy::LineTerms<double> terms{
            across, each, each * static_cast<double>(line_.size()),
            box.open ? Side::open : Side::closed, family_ == Family::torus};
        const auto worst = discrepancy::worst_interval<double>(
            line_.size(), terms, [&](std::size_t i) { return across * x[line_[i]]; },
            [&](std::size_t i) { return each * static_cast<double>(i); });
        const auto side = [&](std::size_t at) {
            return at == discrepancy::line_end ? rim_ : line_[at];
        };
        box.axes[axis] = {side(worst.lower), side(worst.upper)};
        box.value = worst.excess;
    }

    PoolBox climbed(PoolBox box) {
        box.value = -1;
        for (std::size_t unchanged = 0, axis = draws_.below(d_); unchanged < d_; ++unchanged) {
            if (improve(box, axis)) unchanged = 0;
            axis = (axis + 1) % d_;
        }
        return box;
    }

    PoolBox random_box() {
        PoolBox box{.open = empty_ || draws_.below(2) == 0};
        for (std::size_t j = 0; j < d_; ++j) {
            // An anchored box ends at the larger of two random coordinates, because the worst boxes
            // of many dimensions end near 1.
            const std::uint64_t a = draws_.below(n_ + 1);
            const std::uint64_t b = draws_.below(n_ + 1);
            const auto at = [&](std::uint64_t k) { return k == n_ ? rim_ : order_[j][k]; };
            if (family_ == Family::anchored)
                box.axes.push_back({rim_, at(std::max(a, b))});
            else
                box.axes.push_back({at(std::min(a, b)), at(std::max(a, b))});
        }
        return box;
    }

    PoolBox start() {
        PoolBox box = random_box();
        const std::uint64_t way = draws_.below(3);
        if (way == 0 || pool_.empty()) return box;
        PoolBox near = pool_[draws_.below(std::min<std::size_t>(pool_.size(), 50))];
        if (way == 2) {
            const std::size_t axis = draws_.below(d_);
            near.axes[axis] = box.axes[axis];
        }
        return near;
    }

    /// Adds the results of ascents to the pool, and removes boxes far below the largest value.
    void ascend(double sharpness, const RunContext& run) {
        const std::size_t some = pool_.empty() ? 20 * ascents : ascents;
        for (std::size_t k = 0; k < some; ++k) {
            run.check_stop();
            pool_.push_back(climbed(start()));
        }
        std::ranges::sort(pool_, [](const PoolBox& a, const PoolBox& b) {
            if (a.value != b.value) return a.value > b.value;
            return a.open != b.open ? a.open : a.axes < b.axes;
        });
        const auto same = [](const PoolBox& a, const PoolBox& b) { return a.same(b); };
        pool_.erase(std::unique(pool_.begin(), pool_.end(), same), pool_.end());
        const double least = pool_.front().value * std::max(1 - reach / sharpness, 0.2);
        while (pool_.size() > 1 && (pool_.size() > most_boxes || pool_.back().value < least))
            pool_.pop_back();
    }

    void put_gradient(double most, double sharpness, std::span<double> gradient) const {
        std::ranges::fill(gradient, 0);
        double total = 0;
        for (const PoolBox& box : pool_) {
            const double part = exponential(sharpness * (box.value - most));
            total += part;
            const double signed_part = (box.open ? part : -part) * weight(box);
            for (std::size_t j = 0; j < d_; ++j) {
                double across = signed_part;
                for (std::size_t l = 0; l < d_; ++l)
                    if (l != j) across *= length(box, l);
                if (box.axes[j].upper != rim_) gradient[box.axes[j].upper * d_ + j] += across;
                if (box.axes[j].lower != rim_) gradient[box.axes[j].lower * d_ + j] -= across;
            }
        }
        for (double& slope : gradient) slope /= total;
    }

    std::size_t n_;
    std::size_t d_;
    std::uint32_t rim_;
    Family family_;
    bool empty_;
    std::vector<double> weights_;
    std::vector<std::vector<std::uint32_t>> order_;
    std::vector<std::vector<double>> columns_;
    std::vector<std::int64_t> inside_;
    std::vector<std::uint32_t> line_;
    std::vector<PoolBox> pool_;
    SplitMix64 draws_{1};
};

}  // namespace

Bounds bounds_of(const PointSet& points, Family family, bool empty, const RunContext& run,
                 std::uint64_t work) {
    const BoxGrid grid =
        box_grid(points, family, run, empty ? Measure::emptiness : Measure::discrepancy);
    const SearchResult found = family == Family::anchored && grid.dimension() > 2
                                   ? star::find_worst(grid, {.work = work}, silent(run))
                                   : worst_of_all(grid, WorstBox(grid), work, silent(run));
    return {found.worst.value(), std::max(found.upper, found.worst.value())};
}

std::unique_ptr<Objective> box_objective(Family family, bool empty,
                                         const std::vector<double>& weights, std::size_t count,
                                         std::size_t dimension) {
    return std::make_unique<BoxObjective>(family, empty, weights, count, dimension);
}

}  // namespace stipple::optimized
