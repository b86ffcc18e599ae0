// SPDX-License-Identifier: MIT
//
// Tests whether points depend on preceding ones. Along each axis of the domain's cube, where the
// coordinate u of a point that follows the domain's density is uniform,
//
//     r_L = 12/(n - L) sum (u_i - 1/2)(u_(i+L) - 1/2),    mean 0, variance 1/(n - L)
//     runs up and down: 1 + number of i where the sequence turns, mean (2 n - 1)/3,
//                       variance (16 n - 29)/90
//     runs about 1/2:   1 + number of i with u_i, u_(i+1) on different sides, mean (n + 1)/2,
//                       variance (n - 1)/4
//
// for independent points. These means and variances are exact (mean and variance of u are not
// estimated). The p-values assume normal distributions, which hold for many points. All tests are
// combined by 1 - (1 - p)^T of the smallest of their T two-sided p (Sidak). For dependent tests
// this is nearly right or too large.
//
// Shape   points n x d, n > lags + 1 and n >= 3, in their order, on any domain whose coordinates
//         preserve probability; also in batches.
// Cost    O(n d lags) time, 20 ns per point in 2-D with 5 lags on one core; O(d lags) memory
//         besides the points.
// Promise runs are counted in integers; the same for any number of threads, and whether points
//         arrive at once or in batches. Equal neighbours count as rising, and 1/2 as above.
// Beware  consecutive low-discrepancy points depend on each other; that is not a defect.
// Source  H. Levene, J. Wolfowitz, Annals of Mathematical Statistics 15 (1944) 58-69,
//         doi:10.1214/aoms/1177731307 (runs up and down). A. Wald, J. Wolfowitz, Annals of
//         Mathematical Statistics 11 (1940) 147-162, doi:10.1214/aoms/1177731909 (runs about a
//         value; its probability is known here). D. E. Knuth, "The Art of Computer Programming",
//         volume 2, section 3.3.2 (serial correlation).

#include <algorithm>
#include <cmath>

#include "analyzers/analyzer.hpp"
#include "analyzers/uniformity/cube_rows.hpp"
#include "analyzers/uniformity/pearson.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple::analyzers::serial {
namespace {

constexpr Param<std::int64_t> lags{
    .name = "lags",
    .fallback = 5,
    .low = 1,
    .high = 1000,
    .unit = "points",
    .help = "Largest lag: each point is correlated with the points 1, 2, ... before it"};

constexpr Param<Choice> expect{.name = "expect",
                               .choices = "independent|dependent",
                               .help = "Fail (exit code 1) if the verdict differs"};

/// Sums of serial products, and numbers of turns and crossings of 1/2, along one axis.
struct AxisSums {
    std::vector<double> products;  ///< sums of (u_i - 1/2)(u_(i-L) - 1/2), for each lag
    std::uint64_t turns = 0;
    std::uint64_t crossings = 0;

    void add(const AxisSums& other) {
        for (std::size_t lag = 0; lag < products.size(); ++lag)
            products[lag] += other.products[lag];
        turns += other.turns;
        crossings += other.crossings;
    }
};

/// Adds the terms of rows [first, last) of `cubes` to the sums, including products with preceding
/// rows of `cubes` back to the largest lag.
void sum_axis(std::span<const double> cubes, std::size_t axes, std::size_t axis, std::size_t first,
              std::size_t last, AxisSums& sums) {
    const auto u = [&](std::size_t i) { return cubes[i * axes + axis]; };
    for (std::size_t i = first; i < last; ++i) {
        const double off = u(i) - 0.5;
        const std::size_t most = std::min(i, sums.products.size());
        for (std::size_t lag = 1; lag <= most; ++lag)
            sums.products[lag - 1] += off * (u(i - lag) - 0.5);
        if (i >= 1) sums.crossings += (u(i) >= 0.5) != (u(i - 1) >= 0.5);
        if (i >= 2) sums.turns += (u(i) >= u(i - 1)) != (u(i - 1) >= u(i - 2));
    }
}

double two_sided_normal(double z) { return 2 * normal_distribution(-std::abs(z)); }

void conclude(Report& report, double p, const Values& options) {
    const std::string verdict = p < options[level_option] ? "dependent" : "independent";
    report.add("combined_p_value", p);
    add_verdict(report, verdict, p, options[expect]);
}

class Order final : public Accumulator {
  public:
    Order(const Arrival& arrival, const Values& options)
        : domain_(arrival.domain),
          options_(options),
          lags_(static_cast<std::size_t>(options[lags])),
          sums_(domain_->cube_dimension(), AxisSums{.products = std::vector<double>(lags_)}) {
        require_even(*domain_, "serial");
    }

    void add(std::span<const double> rows, const RunContext& run) override {
        const std::size_t axes = sums_.size();
        const std::size_t before = tail_.size() / axes;
        const auto cubes = cube_rows(*domain_, rows, n_, outside_, run);
        tail_.insert(tail_.end(), cubes.begin(), cubes.end());
        const std::size_t count = tail_.size() / axes;
        n_ += count - before;
        add_rows(before, count, run);
        const std::size_t keep = std::min(count, std::max<std::size_t>(lags_, 2));
        tail_.erase(tail_.begin(), tail_.end() - static_cast<std::ptrdiff_t>(keep * axes));
    }

    Report report(const RunContext&) override {
        if (outside_.count > 0) refuse(outside_, n_, *domain_, outside_hint(*domain_));
        if (n_ < std::max<std::uint64_t>(3, lags_ + 2))
            fail(ErrorKind::input, "serial needs at least {} points for {} lags; these are {}",
                 std::max<std::uint64_t>(3, lags_ + 2), lags_, n_);
        for (const AxisSums& sums : sums_) add_axis(sums);
        double least = 1;
        for (const auto& z : {correlation_z_, turns_z_, crossings_z_})
            for (const double x : z) least = std::min(least, two_sided_normal(x));
        const std::size_t tests = correlation_z_.size() + turns_z_.size() + crossings_z_.size();
        Report report;
        tell_axes(*domain_, report);
        report.add("lags", static_cast<std::uint64_t>(lags_))
            .add("correlation", correlation_)
            .add("correlation_z", correlation_z_)
            .add("runs_up_down", turns_)
            .add("runs_up_down_z", turns_z_)
            .add("runs_about_half", crossings_)
            .add("runs_about_half_z", crossings_z_);
        conclude(report, sidak(least, static_cast<double>(tests)), options_);
        return report;
    }

  private:
    /// Adds rows [first, last) of tail_, in blocks whose sums are added in order.
    void add_rows(std::size_t first, std::size_t last, const RunContext& run) {
        const std::size_t axes = sums_.size();
        const std::size_t block = std::max<std::size_t>(1, 16384 / axes);
        std::vector<std::vector<AxisSums>> parts(block_count(last - first, block));
        for_each_block(silent(run), last - first, block, [&](const Block& b) {
            auto& part = parts[b.index];
            part.assign(axes, AxisSums{.products = std::vector<double>(lags_)});
            for (std::size_t axis = 0; axis < axes; ++axis)
                sum_axis(tail_, axes, axis, first + b.first, first + b.last, part[axis]);
        });
        for (const auto& part : parts)
            for (std::size_t axis = 0; axis < axes; ++axis) sums_[axis].add(part[axis]);
    }

    void add_axis(const AxisSums& sums) {
        const auto n = static_cast<double>(n_);
        for (std::size_t lag = 1; lag <= lags_; ++lag) {
            const double pairs = n - static_cast<double>(lag);
            const double r = 12 * sums.products[lag - 1] / pairs;
            correlation_.push_back(r);
            correlation_z_.push_back(r * std::sqrt(pairs));
        }
        const auto turns = static_cast<double>(1 + sums.turns);
        turns_.push_back(static_cast<std::int64_t>(1 + sums.turns));
        turns_z_.push_back((turns - (2 * n - 1) / 3) / std::sqrt((16 * n - 29) / 90));
        const auto crossings = static_cast<double>(1 + sums.crossings);
        crossings_.push_back(static_cast<std::int64_t>(1 + sums.crossings));
        crossings_z_.push_back((crossings - (n + 1) / 2) / std::sqrt((n - 1) / 4));
    }

    DomainPtr domain_;
    Values options_;
    std::size_t lags_;
    std::uint64_t n_ = 0;
    std::vector<AxisSums> sums_;
    std::vector<double> tail_;  ///< cube coordinates of the last points
    Outside outside_;
    Report::Curve correlation_, correlation_z_, turns_z_, crossings_z_;
    Report::Integers turns_, crossings_;
};

void combine(Report& mean, std::span<const Report> sets, const Values& options) {
    double least = 1;
    for (const Report& set : sets) least = std::min(least, set.number("combined_p_value"));
    mean.forget_unmet();
    conclude(mean, sidak(least, static_cast<double>(sets.size())), options);
}

}  // namespace

Analyzer unit() {
    return {
        .name = "serial",
        .summary = "Dependence of points on preceding ones: lag correlations and runs",
        .source = "Levene, Wolfowitz 1944, doi:10.1214/aoms/1177731307; Knuth, TAOCP 2, 3.3.2",
        .related = {"autocorrelation", "runs-test"},
        .traits = {.max_dimension = 10'000, .unit_cube = false},
        .options = Schema(lags, level_option, expect),
        .results = {{"axes", "description of the axes, if they are not x1, x2, ...", false},
                    {"lags", "number of lags for each axis"},
                    {"correlation",
                     "correlation with the point L before, L = 1, 2, ...; axis after axis"},
                    {"correlation_z", "correlation in standard deviations from its mean, 0"},
                    {"runs_up_down", "for each axis: number of runs that rise or fall"},
                    {"runs_up_down_z", "that number in standard deviations from its mean"},
                    {"runs_about_half", "for each axis: number of runs below 1/2, or not below"},
                    {"runs_about_half_z", "that number in standard deviations from its mean"},
                    {"combined_p_value",
                     "1 - (1 - p)^T of the smallest two-sided p of all T tests"},
                    {"verdict", "independent, dependent", true, "independent|dependent"}},
        .accumulate = [](const Arrival& arrival, const Values& options,
                         const RunContext&) { return std::make_unique<Order>(arrival, options); },
        .combine = combine};
}

}  // namespace stipple::analyzers::serial
