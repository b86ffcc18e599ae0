// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/star/star_cover.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stipple::analyzers::star {
namespace {

/// The grid's values on each axis, rising from 0 to 1.
std::vector<double> cuts_for(double delta, double dimension) {
    std::vector<double> cuts{1};
    const double first = std::pow(1 - delta, 1 / dimension);
    const double stretch = std::pow(first, 1 - dimension);
    for (double x = first; x > 0; x = (x - delta) * stretch) cuts.push_back(x);
    cuts.push_back(0);
    std::ranges::reverse(cuts);
    return cuts;
}

/// The finest grid that has no more corners; empty if it would have no inner ones.
std::vector<double> finest_cuts(std::size_t dimension, double most_corners) {
    const auto d = static_cast<double>(dimension);
    const double most = std::floor(std::pow(most_corners, 1 / d) + 1e-9);
    if (most < 6) return {};  // delta would be above 1/2
    double coarse = 1 - 1e-9;
    double fine = 1e-7;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(coarse * fine);
        const double corners = static_cast<double>(cuts_for(middle, d).size());
        (corners > most ? fine : coarse) = middle;
    }
    auto cuts = cuts_for(coarse, d);
    if (static_cast<double>(cuts.size()) > most) cuts.clear();
    return cuts;
}

/// Counts of points at most the corner, for all corners; the last axis is the fastest index.
class Counts {
  public:
    Counts(const CornerGrid& grid, const std::vector<double>& cuts, const RunContext& run)
        : side_(cuts.size()), dimension_(grid.dimension()), counts_(corners()) {
        std::vector<std::uint32_t> corner_of(grid.count);
        for (std::size_t k = 0; k < dimension_; ++k) {
            run.check_stop();
            const auto above = places_above(grid.values[k], cuts);
            for (std::size_t i = 0; i < grid.count; ++i)
                corner_of[i] =
                    corner_of[i] * static_cast<std::uint32_t>(side_) + above[grid.ranks[k][i]];
        }
        for (const std::uint32_t corner : corner_of) ++counts_[corner];
        std::size_t stride = 1;
        for (std::size_t k = 0; k < dimension_; ++k, stride *= side_) sum_along(stride, run);
    }

    [[nodiscard]] const std::vector<std::uint32_t>& all() const { return counts_; }
    [[nodiscard]] std::size_t side() const { return side_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

  private:
    [[nodiscard]] std::size_t corners() const {
        std::size_t all = 1;
        for (std::size_t k = 0; k < dimension_; ++k) all *= side_;
        return all;
    }

    /// For each value, the first cut that is not below it.
    static std::vector<std::uint32_t> places_above(const std::vector<double>& values,
                                                   const std::vector<double>& cuts) {
        std::vector<std::uint32_t> above;
        std::uint32_t at = 0;
        for (const double x : values) {
            while (cuts[at] < x) ++at;
            above.push_back(at);
        }
        return above;
    }

    void sum_along(std::size_t stride, const RunContext& run) {
        for (std::size_t first = 0; first < counts_.size(); first += stride * side_) {
            if (first % (std::size_t{1} << 20) < stride * side_) run.check_stop();
            std::uint32_t* at = counts_.data() + first;
            for (std::size_t i = stride; i < stride * side_; ++i) at[i] += at[i - stride];
        }
    }

    std::size_t side_;
    std::size_t dimension_;
    std::vector<std::uint32_t> counts_;
};

/// The worst cell's bound.
class Cover {
  public:
    Cover(const Counts& counts, const std::vector<double>& cuts, double points,
          const RunContext& run)
        : counts_(counts), cuts_(cuts), points_(points), run_(run) {
        across_ = 1;
        for (std::size_t k = 1; k < counts.dimension(); ++k)
            across_ = across_ * counts.side() + 1;  // from a cell's lower corner to the upper one
    }

    double worst() {
        visit(0, 0, 1, 1);
        return worst_;
    }

  private:
    /// Cells whose lower corners have index `base` and these volumes on the axes before.
    void visit(std::size_t axis, std::size_t base, double low, double high) {
        if (axis + 1 == counts_.dimension()) return visit_line(base * counts_.side(), low, high);
        for (std::size_t i = 0; i + 1 < cuts_.size(); ++i)
            visit(axis + 1, base * counts_.side() + i, low * cuts_[i], high * cuts_[i + 1]);
    }

    void visit_line(std::size_t base, double low, double high) {
        if (++lines_ % 65536 == 0) run_.check_stop();
        const std::uint32_t* below = counts_.all().data() + base;
        const std::uint32_t* within = below + across_;
        double worst = worst_;
        for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
            const double open = high * cuts_[i + 1] - below[i] / points_;
            const double closed = within[i] / points_ - low * cuts_[i];
            worst = std::max(worst, std::max(open, closed));
        }
        worst_ = worst;
    }

    const Counts& counts_;
    const std::vector<double>& cuts_;
    double points_;
    const RunContext& run_;
    std::size_t across_ = 1;
    std::size_t lines_ = 0;
    double worst_ = 0;
};

}  // namespace

double cover_bound(const CornerGrid& grid, std::uint64_t most_corners, const RunContext& run) {
    const std::size_t d = grid.dimension();
    const auto cuts = finest_cuts(d, std::min(static_cast<double>(most_corners), 0x1p31));
    if (cuts.empty()) return 1;
    const Counts counts(grid, cuts, run);
    const double worst = Cover(counts, cuts, static_cast<double>(grid.count), run).worst();
    const double rounding = 4e-16 * static_cast<double>(d + 2);
    return std::min(1.0, worst + rounding);
}

}  // namespace stipple::analyzers::star
