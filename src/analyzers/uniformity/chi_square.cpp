// SPDX-License-Identifier: MIT
//
// Pearson's chi-square test that points follow the density of their domain. The domain's
// coordinates map it to a unit cube, which is divided into K equal boxes. If these coordinates
// preserve probability, as for all domains that have them in closed form, each cell has probability
// exactly 1 / K. Otherwise the domain computes the probability of each cell and its error
// (mass_error). Cells that expect fewer than 5 points are pooled (pearson.hpp).
//
//     p_upper = P(chi2 >= X^2),  p_lower = P(chi2 <= X^2),  p = min(1, 2 min(p_upper, p_lower))
//
// (p_lower takes into account that counts are integers, see pearson.hpp: five points in each of
// three cells are not rare.)
//
// The verdict is uniform if p >= level. Otherwise, if the upper tail is the smaller one, it is
// non-uniform: the counts differ too much from the expected ones. If the lower tail is the smaller
// one, it is stratified: the counts differ less than those of random points. A point in a cell of
// probability 0 is impossible: non-uniform, p = 0. So is a point in a known gap of the density, if
// its distance from the gap's edges exceeds the rounding of single precision.
//
// The default grid has the largest product of odd primes near 2 n^(2/5) (Mann and Wald's rate), at
// most n / 5, on as many of the first axes as can have 3 cells each. The primes are odd, since
// strata usually divide an axis by 2 or 10, and cells aligned with strata reveal nothing. Other
// axes are cut by --cells only. Above 2^20 points the grid is that of 2^20, 2^24 or 2^28 points,
// whichever is the largest not above n. So the points of a stream of unknown length are counted in
// these grids and need not be kept.
//
// --shifted also counts in a second grid, moved by half a cell along every axis that is cut (on the
// torus). The two tests depend on each other; combined_p_value = 1 - (1 - p)^2 of the smaller p
// (Sidak) is at least the true probability. It decides the verdict, which is non-uniform if either
// grid alone is non-uniform at that level.
//
// The tails of R sets are combined in one of three ways. sum: the sum of their statistics has the
// sum of their degrees of freedom. sidak: 1 - (1 - p)^R of the smallest p. fisher: -2 sum ln p is
// chi-square with 2 R degrees of freedom. The upper and the lower tails are combined separately.
// The sum's lower tail is at least the product of the sets' lower tails.
//
// Probabilities that are known only within errors leave the statistic in a range (pearson.hpp). If
// the ends of the range have different verdicts, the analyzer fails.
//
// Smallest detectable effect: with cell probabilities p_i (1 + e_i), X^2 has the noncentral
// chi-square distribution with noncentrality n sum_i p_i e_i^2 (for large n). The effect is the
// root-mean-square e, sqrt(sum_i p_i e_i^2), for which the verdict is non-uniform with probability
// 0.9.
//
// Shape   points n x d on any domain, also in batches; a report of numbers and the verdict.
// Cost    O(n d) time, O(K) memory besides the points; for a stream of unknown length, the first
//         2^20 points are kept. About 25 ns per point in 2-D on one core.
// Promise counts, and so all results, are the same for any number of threads, and whether points
//         arrive at once or in batches. A coordinate of exactly 1 belongs to the last cell.
// Beware  low-discrepancy points are stratified, not random: their p describes them, but is not a
//         probability. The p of random points is approximate if expectations are small, and for few
//         groups, whose statistic takes few values. If the density jumps to 0 at the edge of a
//         cell, rounding decides in which cell a point on the jump is counted.
// Source  K. Pearson, Philosophical Magazine 50 (1900) 157-175, doi:10.1080/14786440009463897.
//         H. B. Mann, A. Wald, Annals of Mathematical Statistics 13 (1942) 306-317,
//         doi:10.1214/aoms/1177731569 (number of cells). Z. Sidak, Journal of the American
//         Statistical Association 62 (1967) 626-633, doi:10.1080/01621459.1967.10482935.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "analyzers/analyzer.hpp"
#include "analyzers/uniformity/cell_grid.hpp"
#include "analyzers/uniformity/cube_rows.hpp"
#include "analyzers/uniformity/pearson.hpp"
#include "core/error.hpp"
#include "core/machine/memory.hpp"
#include "core/parallel.hpp"
#include "math/functions/distributions.hpp"

namespace stipple::analyzers::chi_square {
namespace {

constexpr Param<Extents> cells{
    {.name = "cells",
     .fallback = {},
     .help = "Cells along each axis of the domain's cube, or one number for all; default: odd "
             "primes with a product near 2 n^(2/5)"}};

constexpr Param<bool> shifted{.name = "shifted",
                              .help =
                                  "Also test on a second grid, shifted by half a cell along each "
                                  "axis; the verdict uses both"};

constexpr Param<Choice> combination{
    .name = "combine",
    .fallback = "sum",
    .choices = "sum|sidak|fisher",
    .help =
        "How several sets (--average) give one p-value: from the sum of their statistics, the "
        "smallest p (Sidak), or the product of the p (Fisher)"};

constexpr std::uint64_t held_points = grid_counts[0];  ///< points kept until the grid is known

/// Gaps of a domain's density. A point in a gap is impossible, even in a cell of probability > 0.
class Gaps {
  public:
    explicit Gaps(DomainPtr domain) : domain_(std::move(domain)) {
        if (!domain_->shows_gaps()) return;
        support_ = domain_->support();
        const Box around = domain_->bounding_box();
        for (std::size_t k = 0; k < around.dimension(); ++k)
            margins_.push_back(rounding *
                               std::max(std::abs(around.low[k]), std::abs(around.high[k])));
    }

    /// Number of rows that are points in gaps.
    [[nodiscard]] std::uint64_t count(std::span<const double> rows, const RunContext& run) const {
        if (support_.whole) return 0;
        const std::size_t d = domain_->dimension();
        std::atomic<std::uint64_t> found = 0;
        for_each_block(silent(run), rows.size() / d, 4096, [&](const Block& block) {
            std::uint64_t mine = 0;
            for (std::uint64_t i = block.first; i < block.last; ++i)
                mine += hold(rows.subspan(i * d, d));
            found += mine;
        });
        return found;
    }

  private:
    static constexpr double rounding = 1e-6;

    [[nodiscard]] bool hold(std::span<const double> point) const {
        if (support_.boxes.empty())
            return support_.by_density && point.size() == 2 && dark_around(point);
        return std::ranges::none_of(support_.boxes,
                                    [&](const Box& box) { return near(box, point); });
    }

    [[nodiscard]] bool near(const Box& box, std::span<const double> point) const {
        for (std::size_t k = 0; k < point.size(); ++k)
            if (!(point[k] >= box.low[k] - margins_[k] && point[k] <= box.high[k] + margins_[k]))
                return false;
        return true;
    }

    [[nodiscard]] bool dark_around(std::span<const double> point) const {
        if (domain_->density(point) > 0) return false;
        for (const double i : {-1, 0, 1})
            for (const double j : {-1, 0, 1}) {
                const std::array at = {point[0] + i * margins_[0], point[1] + j * margins_[1]};
                if (domain_->density(at) > 0) return false;
            }
        return true;
    }

    DomainPtr domain_;
    Support support_ = {.boxes = {}};  ///< the whole domain if it reports no gaps
    std::vector<double> margins_;
};

/// A grid with the number of points in each of its cells.
class Tally {
  public:
    Tally(CellGrid grid, bool with_shifted, std::uint64_t from, const RunContext& run)
        : grid_(std::move(grid)), from_(from) {
        const std::uint64_t total = cell_count(grid_);
        run.need_memory((with_shifted ? 16.0 : 8.0) * static_cast<double>(total),
                        "the count of cells");
        counts_.resize(total);
        if (with_shifted) shifted_.resize(total);
    }

    /// Counts points of the cube, given by `width` coordinates each; the grid uses the first ones.
    void add(std::span<const double> cubes, std::size_t width) {
        for (std::size_t i = 0; i < cubes.size(); i += width)
            ++counts_[cell_of(cubes.subspan(i, width), grid_, false)];
        for (std::size_t i = 0; i < cubes.size() && !shifted_.empty(); i += width)
            ++shifted_[cell_of(cubes.subspan(i, width), grid_, true)];
    }

    void pack(Packer& to) const { to.put_all(counts_).put_all(shifted_); }

    void merge(Unpacker& from) {
        for (auto* mine : {&counts_, &shifted_}) {
            const auto more = from.take_all<std::uint64_t>();
            for (std::size_t i = 0; i < more.size(); ++i) (*mine)[i] += more[i];
        }
    }

    /// Smallest number of points for which this grid is used.
    [[nodiscard]] std::uint64_t from() const { return from_; }
    [[nodiscard]] const CellGrid& grid() const { return grid_; }

    [[nodiscard]] Fit fit(const Domain& domain, bool second, std::uint64_t n,
                          const RunContext& run) const {
        const auto& counts = second ? shifted_ : counts_;
        if (domain.even()) return fit_equal(counts, n, run);
        return fit_masses(counts, cell_masses(domain, grid_, second, run), n, run);
    }

  private:
    CellGrid grid_;
    std::uint64_t from_;
    std::vector<std::uint64_t> counts_;
    std::vector<std::uint64_t> shifted_;
};

/// Tails of a statistic (found), and of the smallest and largest value that the errors of the
/// cells' probabilities allow.
struct Judged {
    Tails found;
    Tails least;
    Tails greatest;
};

template <class F>
Judged judge(double statistic, double error, const F& tails) {
    return {.found = tails(statistic),
            .least = tails(std::max(statistic - error, 0.0)),
            .greatest = tails(statistic + error)};
}

Report& add_tails(Report& report, const Tails& tails) {
    return report.add("p_value", tails.two_sided())
        .add("p_upper", tails.upper)
        .add("p_lower", tails.lower)
        .add("p_method", tails.exact ? "exact" : "corrected");
}

/// Adds the tails for one grid or two grids, and the verdict. @throws Error(limit) if the errors of
/// the cells' probabilities could change the verdict
void conclude(Report& report, const Judged& plain, const std::optional<Judged>& second,
              const Values& options) {
    const auto of_second = [&](Tails Judged::*which) {
        return second ? &(*second.*which) : nullptr;
    };
    add_tails(report, plain.found);
    const double p = p_value_of(plain.found, of_second(&Judged::found));
    if (second) report.add("combined_p_value", p);
    const double level = options[level_option];
    const auto verdict = verdict_of(plain.found, of_second(&Judged::found), level);
    for (const auto which : {&Judged::least, &Judged::greatest})
        if (verdict_of(plain.*which, of_second(which), level) != verdict)
            fail_with_hint(ErrorKind::limit, "coarser --cells, or fewer points",
                           "chi-square cannot decide: the cells' probabilities have a total error "
                           "of {:.2g}, and the statistic an error of {:.3g}; it is {:.6g}",
                           report.number("mass_error"), report.number("statistic_error"),
                           report.number("statistic"));
    add_verdict(report, verdict, p, options[expect_uniformity_option]);
}

/// Tails of a fit; the upper tail is 0 if there are impossible points.
Judged judge(const Fit& fit) {
    const Tails never{.upper = 0, .lower = 1};
    if (fit.impossible > 0) return {never, never, never};
    return judge(fit.statistic, fit.statistic_error, [&](double x) { return count_tails(x, fit); });
}

Report shifted_report(const Fit& fit) {
    Report report;
    report.add("statistic", fit.statistic).add("degrees_of_freedom", fit.groups - 1);
    return add_tails(report, judge(fit).found)
        .add("pooled_cells", fit.pooled)
        .add("impossible_points", fit.impossible)
        .add("statistic_error", fit.statistic_error);
}

/// Counts points in cells as they arrive.
class Counter final : public SharedAccumulator {
  public:
    Counter(const Arrival& arrival, const Values& options, const RunContext& run)
        : domain_(arrival.domain),
          gaps_(domain_),
          options_(options),
          axes_(domain_->cube_dimension()) {
        if (options.given(cells)) {
            tallies_.emplace_back(asked_grid(options[cells], axes_), options[shifted], 0, run);
        } else if (arrival.count) {
            tallies_.emplace_back(default_grid(*arrival.count, axes_), options[shifted], 0, run);
        } else {
            width_ = std::min(axes_, most_cut_axes);
            run.need_memory(8.0 * static_cast<double>(held_points * width_),
                            "the first points of a stream");
            held_.reserve(held_points * width_);
        }
    }

    void add(std::span<const double> rows, const RunContext& run) override {
        const auto cubes = cube_rows(*domain_, rows, first_ + n_, outside_, run);
        if (outside_.count == 0) take(rows, cubes, run);
        n_ += rows.size() / domain_->dimension();
        if (tallies_.empty() && n_ > held_points) lay_grids(run);
        while (tallies_.size() > 1 && tallies_[1].from() <= n_) tallies_.erase(tallies_.begin());
    }

    Report report(const RunContext& run) override {
        if (outside_.count > 0) refuse(outside_, n_, *domain_, outside_hint(*domain_));
        if (tallies_.empty()) {
            tallies_.emplace_back(default_grid(n_, axes_), options_[shifted], 0, run);
            tallies_[0].add(held_, width_);
        }
        return judged(tallies_[0], run);
    }

    void begin_at(std::uint64_t first, std::span<const double>) override { first_ = first; }

    std::string state(const RunContext&) override {
        Packer packer;
        packer.put(n_).put(in_gaps_);
        outside_.pack(packer);
        tallies_.front().pack(packer);
        return packer.take();
    }

    void merge(std::string_view state, const RunContext&) override {
        Unpacker from(state);
        n_ += from.take<std::uint64_t>();
        in_gaps_ += from.take<std::uint64_t>();
        outside_.add(Outside::unpacked(from));
        tallies_.front().merge(from);
    }

  private:
    /// Counts points, given as rows and as `cubes`; keeps the cubes until the grid is known.
    void take(std::span<const double> rows, std::span<const double> cubes, const RunContext& run) {
        in_gaps_ += gaps_.count(rows, run);
        for (Tally& tally : tallies_) tally.add(cubes, axes_);
        if (!tallies_.empty()) return;
        for (std::size_t i = 0; i < cubes.size(); i += axes_) {
            const auto cube = cubes.subspan(i, width_);
            held_.insert(held_.end(), cube.begin(), cube.end());
        }
    }

    /// Makes all grids that may be the final one, and counts the kept points in each.
    void lay_grids(const RunContext& run) {
        for (const std::uint64_t from : grid_counts) {
            tallies_.emplace_back(default_grid(from, axes_), options_[shifted], from, run);
            tallies_.back().add(held_, width_);
        }
        release(held_);
    }

    [[nodiscard]] Fit fit(const Tally& tally, bool second, const RunContext& run) const {
        Fit found = tally.fit(*domain_, second, n_, run);
        found.impossible = std::max(found.impossible, in_gaps_);  // may both count a point
        return found;
    }

    [[nodiscard]] Report judged(const Tally& tally, const RunContext& run) const {
        const Fit plain = fit(tally, false, run);
        Report report;
        report.add("statistic", plain.statistic).add("degrees_of_freedom", plain.groups - 1);
        std::optional<Judged> second;
        std::optional<Fit> other;
        if (options_[shifted]) {
            other = fit(tally, true, run);
            second = judge(*other);
        }
        report.add("mass_error", plain.mass_error).add("statistic_error", plain.statistic_error);
        conclude(report, judge(plain), second, options_);
        report.add("cells", cell_count(tally.grid())).add("pooled_cells", plain.pooled);
        report.add("smallest_detectable_effect",
                   std::sqrt(detectable_noncentrality(plain.freedom(), options_[level_option]) /
                             static_cast<double>(n_)));
        const auto& grid = tally.grid();
        report.add("grid", Report::Integers(grid.begin(), grid.end()));
        report.add("impossible_points", plain.impossible);
        if (other) report.add("shifted", shifted_report(*other));
        return report;
    }

    DomainPtr domain_;
    Gaps gaps_;
    Values options_;
    std::size_t axes_;
    std::uint64_t first_ = 0;  ///< index of the first point to arrive
    std::size_t width_ = 0;    ///< number of cube coordinates that are kept per point
    std::uint64_t n_ = 0;
    std::uint64_t in_gaps_ = 0;
    std::vector<Tally> tallies_;
    std::vector<double> held_;
    Outside outside_;
};

void refine(Report& mean, std::size_t sets, const Values& options) {
    const auto m = static_cast<double>(sets);
    const double freedom = mean.number("degrees_of_freedom");
    const double shrink = detectable_noncentrality(m * freedom, options[level_option]) / m /
                          detectable_noncentrality(freedom, options[level_option]);
    mean.add("smallest_detectable_effect",
             mean.number("smallest_detectable_effect") * std::sqrt(shrink));
}

/// Tails over several sets by the combination `sum` of statistics and of degrees of freedom.
Judged summed(const Report& mean, std::span<const Report> sets, const std::string& prefix) {
    const Tails never{.upper = 0, .lower = 1};
    if (mean.number(prefix + "impossible_points") > 0) return {never, never, never};
    const auto m = static_cast<double>(sets.size());
    double evenest = 1;
    for (const Report& set : sets) evenest *= set.number(prefix + "p_lower");
    const double freedom = m * mean.number(prefix + "degrees_of_freedom");
    return judge(m * mean.number(prefix + "statistic"), m * mean.number(prefix + "statistic_error"),
                 [&](double x) {
                     Tails tails = chi_square_tails(x, freedom);
                     tails.lower = std::max(tails.lower, evenest);
                     return tails;
                 });
}

/// Tails of a single set, computed from its report.
Judged judged_set(const Report& set, const std::string& prefix) {
    const Tails found{set.number(prefix + "p_upper"), set.number(prefix + "p_lower")};
    const double error = set.number(prefix + "statistic_error");
    if (error == 0 || set.number(prefix + "impossible_points") > 0) return {found, found, found};
    const double freedom = set.number(prefix + "degrees_of_freedom");
    const double statistic = set.number(prefix + "statistic");
    const double counts = found.lower - chi_square_tails(statistic, freedom).lower;
    Judged judged = judge(statistic, error, [&](double x) {
        Tails tails = chi_square_tails(x, freedom);
        tails.lower += counts;
        return tails;
    });
    judged.found = found;
    return judged;
}

/// Tails over several sets by the combination `sidak` or `fisher`.
Judged combined(std::span<const Report> sets, const std::string& prefix, const std::string& how) {
    Judged one;
    for (const auto which : {&Judged::found, &Judged::least, &Judged::greatest}) {
        std::vector<Tails> tails;
        for (const Report& set : sets) tails.push_back(judged_set(set, prefix).*which);
        one.*which = how == "sidak" ? sidak(tails) : fisher(tails);
    }
    return one;
}

void combine(Report& mean, std::span<const Report> sets, const Values& options) {
    const std::string how = options[combination];
    const auto over_sets = [&](const std::string& prefix) {
        return how == "sum" ? summed(mean, sets, prefix) : combined(sets, prefix, how);
    };
    std::optional<Judged> second;
    if (auto* item = mean.find("shifted")) {
        second = over_sets("shifted.");
        add_tails(std::get<Report>(*item), second->found);
    }
    mean.forget_unmet();
    conclude(mean, over_sets(""), second, options);
}

std::vector<ResultKey> results() {
    return {
        {"statistic", "sum of (observed - expected)^2 / expected over the groups of cells"},
        {"degrees_of_freedom", "groups of cells minus 1"},
        {"p_value", "two-sided: twice the smaller of p_upper and p_lower, at most 1"},
        {"p_upper", "probability that random points have a statistic as large or larger"},
        {"p_lower",
         "probability that random points have a statistic as small or smaller, given that counts "
         "are integers"},
        {"p_method",
         "method for p_lower: exact: sum over all counts with so small a statistic, if these can "
         "be enumerated; corrected: the chi-square distribution, corrected for integer counts",
         true, "exact|corrected"},
        {.key = "verdict",
         .help = "uniform; non-uniform: counts vary too much; stratified: counts vary too little",
         .words = uniformity_verdicts,
         .sentences = {{"uniform",
                        "The numbers of points in the cells are as expected by chance ({})."},
                       {"stratified",
                        "The cells are filled more evenly than by independent points ({}): good "
                        "for low-discrepancy and stratified sets."},
                       {"non-uniform", "The points do not follow their domain's density ({})."}}},
        {"cells", "number of cells"},
        {"pooled_cells",
         "number of cells merged with others, so that each group expects at least 5 points"},
        {"smallest_detectable_effect",
         "root-mean-square relative error of the cells' probabilities that would be found "
         "non-uniform with probability 0.9"},
        {"grid", "cells along each axis of the domain's cube"},
        {"mass_error", "sum of the error bounds of the cells' probabilities; 0: exact"},
        {"statistic_error",
         "bound on the resulting error of the statistic; there is no verdict if this error could "
         "change it"},
        {"impossible_points",
         "number of points in cells or gaps of probability 0: one is enough for non-uniform"},
        {"combined_p_value", "p-value from both grids: 1 - (1 - p)^2 of the smaller p", false},
        {"shifted.statistic", "statistic on the shifted grid", false},
        {"shifted.degrees_of_freedom", "groups of its cells minus 1", false},
        {"shifted.p_value", "two-sided", false},
        {"shifted.p_upper", "probability of a statistic as large or larger", false},
        {"shifted.p_lower", "probability of a statistic as small or smaller", false},
        {"shifted.p_method", "method for its p_lower: exact or corrected", false,
         "exact|corrected"},
        {"shifted.pooled_cells", "number of its cells merged with others", false},
        {"shifted.impossible_points", "number of points in its cells of probability 0", false},
        {"shifted.statistic_error", "bound on the error of its statistic", false}};
}

}  // namespace

Analyzer unit() {
    return {.name = "chi-square",
            .summary = "Two-sided test that points follow their domain's density",
            .source = "Pearson 1900, doi:10.1080/14786440009463897",
            .related = {"chi2", "chisquare", "pearson", "uniformity"},
            .traits = {.unit_cube = false},
            .options = Schema(cells, shifted, combination, level_option, expect_uniformity_option),
            .results = results(),
            .part = PagePart::tests,
            .page = {{"χ² test", {{"p_value", "χ² p‑value"}, {"verdict", "χ² verdict"}}}},
            .accumulate =
                [](const Arrival& arrival, const Values& options, const RunContext& run) {
                    return std::make_unique<Counter>(arrival, options, run);
                },
            .sharing = {.grain = batch_grain},
            .refine = refine,
            .combine = combine};
}

}  // namespace stipple::analyzers::chi_square
