// SPDX-License-Identifier: MIT
//
// Kolmogorov-Smirnov test along each axis of the domain's cube, on which points that follow the
// domain's density are uniform. With u_1 <= ... <= u_n the sorted coordinates of all points on an
// axis,
//
//     D = max_i max(i/n - u_i, u_i - (i - 1)/n)
//     p_upper = P(D_n >= D),  p_lower = P(D_n <= D),  p = min(1, 2 min(p_upper, p_lower))
//
// for D_n of independent uniform numbers (kolmogorov.hpp). A small p_upper indicates a wrong
// density, a small p_lower a coordinate that is more even than random. Over T axes each tail is
// combined by 1 - (1 - p)^T of its smallest p (Sidak): exact, as the axes of random points are
// independent. Several sets are combined in the same way.
//
// Sets of more than 2^26 coordinates (or --exact-points) are not kept. Their points are counted in
// equal cells of each axis (a power of two, at least 4096 and at most 2^26 / d), whose ends are
// exact doubles. D is then the maximum over the ends of cells. The true value exceeds it by at most
// `statistic_error`, which is not above the width of a cell; p_lower is that of the largest possible
// D, so that the error makes no tail significant.
//
// Outcomes of a discrete distribution are moved to random positions in their cells of the cube,
// which makes them uniform. The positions are the same in every run.
//
// Shape   points n x d on any domain whose coordinates preserve probability (all except a few) or
//         are outcomes, also in batches.
// Cost    O(n) time, about 45 ns per point for each axis; at most 1.5 GiB for any number of points;
//         half a second for each axis at most for the distribution.
// Promise if statistic_error is 0, D is exact up to the rounding of i/n; on the unit interval it
//         is the star discrepancy. p is exact up to 10^4 points (relative error below 1e-9), and
//         within 1e-9 above. The same for any number of threads, and for any batches.
// Beware  single axes do not show how coordinates depend on each other.
// Source  A. N. Kolmogorov, Giornale dell'Istituto Italiano degli Attuari 4 (1933) 83-91.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "analyzers/analyzer.hpp"
#include "analyzers/uniformity/cube_rows.hpp"
#include "analyzers/uniformity/kolmogorov.hpp"
#include "core/error.hpp"
#include "core/machine/memory.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/radix_sort.hpp"

namespace stipple::analyzers::kolmogorov_smirnov {
namespace {

constexpr Param<std::int64_t> exact_points{
    .name = "exact-points",
    .low = 1,
    .high = std::numeric_limits<std::uint32_t>::max(),
    .optional = true,
    .unit = "points",
    .help =
        "Largest number of points per set that are kept and sorted; larger sets are counted in "
        "cells [default: 2^26 / d]"};

/// Largest number of coordinates that are kept, and of cells on all axes together.
constexpr std::uint64_t most_numbers = std::uint64_t{1} << 26;

/// Lower bound of D, and the largest amount by which D may exceed it.
struct Distance {
    double statistic = 0;
    double error = 0;
};

double statistic_of(std::span<const Placed> sorted) {
    const auto n = static_cast<double>(sorted.size());
    double most = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const auto below = static_cast<double>(i);
        most = std::max({most, (below + 1) / n - sorted[i].value, sorted[i].value - below / n});
    }
    return most;
}

/// Bounds of D from the counts in equal cells.
Distance distance_of(std::span<const std::uint64_t> cells, double n) {
    const double width = 1 / static_cast<double>(cells.size());
    Distance found;
    double most = 0;
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const double left = static_cast<double>(i) * width;
        const double before = static_cast<double>(below) / n;
        below += cells[i];
        const double behind = static_cast<double>(below) / n;
        found.statistic = std::max(found.statistic, std::abs(before - left));
        most = std::max({most, behind - left, left + width - before});
    }
    found.error = std::max(0.0, most - found.statistic);
    return found;
}

/// Adds the combined p-value and the verdict.
void conclude(Report& report, const Tails& all, const Values& options) {
    report.add("combined_p_value", all.two_sided())
        .add("combined_p_upper", all.upper)
        .add("combined_p_lower", all.lower);
    const std::string verdict = verdict_of(all, nullptr, options[level_option]);
    add_verdict(report, verdict, all.two_sided(), options[expect_uniformity_option]);
}

/// Keeps the cube coordinates of small sets; counts those of large sets in cells.
class Collector final : public SharedAccumulator {
  public:
    Collector(const Arrival& arrival, const Values& options, const RunContext& run)
        : domain_(arrival.domain), options_(options), axes_(domain_->cube_dimension()) {
        if (!domain_->has_outcomes()) require_even(*domain_, "kolmogorov-smirnov");
        most_ = options.given(exact_points) ? static_cast<std::uint64_t>(options[exact_points])
                                            : most_numbers / axes_;
        constexpr std::uint64_t fewest = 4096;
        cells_ = std::bit_floor(std::clamp(most_, fewest, std::max(fewest, most_numbers / axes_)));
        if (!arrival.count) return;
        need_memory_for(std::min(*arrival.count, most_), run);
        if (*arrival.count > most_) count_from_now(run);
    }

    void begin_at(std::uint64_t first, std::span<const double>) override { first_ = first; }

    void add(std::span<const double> rows, const RunContext& run) override {
        auto cubes = cube_rows(*domain_, rows, first_ + n_, outside_, run);
        spread_outcomes(*domain_, cubes, first_ + n_, run);
        n_ += rows.size() / domain_->dimension();
        if (outside_.count > 0) return;
        if (counts_.empty() && n_ > most_) count_from_now(run);
        if (!counts_.empty()) return count(cubes, run);
        need_memory_for(n_, run);
        buffer_.insert(buffer_.end(), cubes.begin(), cubes.end());
    }

    Report report(const RunContext& run) override {
        if (outside_.count > 0) refuse(outside_, n_, *domain_, outside_hint(*domain_));
        Report::Curve statistic, error, p, upper, lower;
        std::vector<Tails> tails;
        std::vector<Placed> sorted(counts_.empty() ? n_ : 0);
        for (std::size_t k = 0; k < axes_; ++k) {
            const Distance found = distance(k, sorted, run);
            statistic.push_back(found.statistic);
            error.push_back(found.error);
            tails.push_back(kolmogorov_tails(n_, found.statistic, run));
            if (found.error > 0)
                tails.back().lower = kolmogorov_tails(n_, found.statistic + found.error, run).lower;
            p.push_back(tails.back().two_sided());
            upper.push_back(tails.back().upper);
            lower.push_back(tails.back().lower);
        }
        Report report;
        tell_axes(*domain_, report);
        report.add("statistic", std::move(statistic)).add("statistic_error", std::move(error));
        report.add("p_value", std::move(p));
        report.add("p_upper", std::move(upper)).add("p_lower", std::move(lower));
        conclude(report, sidak(tails), options_);
        return report;
    }

    std::string state(const RunContext&) override {
        Packer packer;
        packer.put(n_);
        outside_.pack(packer);
        packer.put_all(buffer_).put_all(counts_);
        return packer.take();
    }

    void merge(std::string_view state, const RunContext&) override {
        Unpacker from(state);
        n_ += from.take<std::uint64_t>();
        outside_.add(Outside::unpacked(from));
        const auto kept = from.take_all<double>();
        buffer_.insert(buffer_.end(), kept.begin(), kept.end());
        const auto counts = from.take_all<std::uint64_t>();
        for (std::size_t i = 0; i < counts.size(); ++i) counts_[i] += counts[i];
    }

  private:
    void need_memory_for(std::uint64_t kept, const RunContext& run) const {
        run.need_memory((32.0 + 8.0 * static_cast<double>(axes_)) * static_cast<double>(kept),
                        "sorting the coordinates");
    }

    /// Switches from keeping points to counting them in cells.
    void count_from_now(const RunContext& run) {
        run.need_memory(8.0 * static_cast<double>(axes_ * cells_), "the cells of all axes");
        counts_.resize(axes_ * cells_);
        count(buffer_, run);
        release(buffer_);
    }

    /// Counts each axis on a single thread, since the axes have separate counts.
    void count(std::span<const double> cubes, const RunContext& run) {
        const auto cells = static_cast<double>(cells_);
        for_each_block(silent(run), axes_, 1, [&](const Block& axis) {
            std::uint64_t* counts = counts_.data() + axis.first * cells_;
            for (std::size_t i = axis.first; i < cubes.size(); i += axes_)
                ++counts[std::min(static_cast<std::uint64_t>(cubes[i] * cells), cells_ - 1)];
        });
    }

    [[nodiscard]] Distance distance(std::size_t axis, std::vector<Placed>& sorted,
                                    const RunContext& run) const {
        run.check_stop();
        if (!counts_.empty())
            return distance_of(std::span(counts_).subspan(axis * cells_, cells_),
                               static_cast<double>(n_));
        for (std::uint64_t i = 0; i < n_; ++i)
            sorted[i] = {buffer_[i * axes_ + axis] + 0.0, 0};  // maps -0 to 0
        radix_sort(sorted, run);
        return {.statistic = statistic_of(sorted)};
    }

    DomainPtr domain_;
    Values options_;
    std::size_t axes_;
    std::uint64_t most_;   ///< largest number of points to keep
    std::uint64_t cells_;  ///< number of cells per axis
    std::uint64_t first_ = 0;
    std::uint64_t n_ = 0;
    Outside outside_;
    std::vector<double> buffer_;  ///< coordinates of the cube, point by point
    /// Numbers of points in cells, axis after axis; empty while points are kept.
    std::vector<std::uint64_t> counts_;
};

void combine(Report& mean, std::span<const Report> sets, const Values& options) {
    std::vector<Tails> tails;
    for (const Report& set : sets)
        tails.push_back({set.number("combined_p_upper"), set.number("combined_p_lower")});
    mean.forget_unmet();
    conclude(mean, sidak(tails), options);
}

}  // namespace

Analyzer unit() {
    return {.name = "kolmogorov-smirnov",
            .summary = "Two-sided test of each coordinate of the domain's cube for uniformity",
            .source = "Kolmogorov 1933; Marsaglia, Tsang, Wang 2003, doi:10.18637/jss.v008.i18",
            .related = {"ks", "kstest"},
            .traits = {.max_dimension = 10'000, .unit_cube = false},
            .options = Schema(level_option, expect_uniformity_option, exact_points),
            .results =
                {{"axes", "description of the axes, if they are not x1, x2, ...", false},
                 {"statistic", "largest distance from the uniform distribution, for each axis"},
                 {"statistic_error",
                  "bound on the error of the statistic, for each axis; 0 if the points were kept"},
                 {"p_value", "for each axis: twice the smaller of p_upper and p_lower, at most 1"},
                 {"p_upper", "for each axis: probability of a statistic as large or larger"},
                 {"p_lower", "for each axis: probability of a statistic as small or smaller"},
                 {"combined_p_value",
                  "for all axes: twice the smaller of combined_p_upper and combined_p_lower, at "
                  "most 1"},
                 {"combined_p_upper", "1 - (1 - p)^axes of the smallest p_upper (Sidak)"},
                 {"combined_p_lower", "1 - (1 - p)^axes of the smallest p_lower (Sidak)"},
                 {.key = "verdict",
                  .help = "uniform; non-uniform: an axis has a wrong density; stratified: an axis "
                          "is more even than random",
                  .words = uniformity_verdicts,
                  .sentences = {{"uniform",
                                 "Each axis by itself looks like independent uniform numbers "
                                 "({})."},
                                {"stratified",
                                 "At least one axis is covered more evenly than by chance ({})."},
                                {"non-uniform", "At least one axis has a wrong density ({})."}}}},
            .part = PagePart::tests,
            .page = {{"Kolmogorov–Smirnov test",
                      {{"combined_p_value", "Kolmogorov–Smirnov p‑value"},
                       {"verdict", "Kolmogorov–Smirnov verdict"}}}},
            .accumulate =
                [](const Arrival& arrival, const Values& options, const RunContext& run) {
                    return std::make_unique<Collector>(arrival, options, run);
                },
            .sharing = {.grain = batch_grain},
            .combine = combine};
}

}  // namespace stipple::analyzers::kolmogorov_smirnov
