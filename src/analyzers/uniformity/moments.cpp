// SPDX-License-Identifier: MIT
//
// Mean, variance, skewness and covariances of the coordinates, with standard errors, beside the
// exact values of the domain's distribution if these are known (exact.known):
//
//     mean = (1/n) sum x,                           error sqrt(variance / n)
//     variance = 1/(n - 1) sum (x - mean)^2,        error sqrt((m4 - m2^2 (n - 3)/(n - 1)) / n)
//     skewness = m3 / m2^(3/2),                     error sqrt((g6 - 6 g4 + 9 + g1^2 (9 g4 + 35)/4
//                                                              - 3 g1 g5) / n)
//     covariance = 1/(n - 1) sum (x - mx)(y - my),  error sqrt((m22 - m11^2 (n - 2)/(n - 1)
//                                                              + m20 m02 / (n - 1)) / n)
//
// with m_p and m_pq the central moments of the sample (means over n points), g_p = m_p / m2^(p/2).
// The errors hold for independent points (that of the skewness only for many of them), but are too
// small for few points, as the sample's moments are. More even points have smaller errors.
//
// The same numbers are reported for the points on the domain's cube, where points that follow the
// domain's density are uniform: mean 1/2, variance 1/12, skewness 0, covariances 0, for any domain.
// largest_z is the largest |value - exact| among them, in the standard errors that n independent
// uniform points would have. These are exact except for the skewness:
//
//     mean sqrt(1 / (12 n)),    variance sqrt((1/80 - (n - 3)/(n - 1)/144) / n),
//     skewness sqrt(72 / (35 n)),    covariance 1 / (12 sqrt(n - 1))
//
// Shape   points n x d, n >= 2, on any domain, also in batches. Matrices row by row.
// Cost    O(n d^2) time, O(d^2) memory besides the points; about 25 ns per point in 2-D on one
//         core.
// Promise the same for any number of threads, and whether points arrive at once or in batches.
// Source  M. G. Kendall, A. Stuart, "The Advanced Theory of Statistics", volume 1, chapter 10
//         (standard errors by the delta method).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analyzers/analyzer.hpp"
#include "analyzers/uniformity/cube_rows.hpp"
#include "analyzers/uniformity/moment_sums.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::analyzers::moments {
namespace {

/// Means of the columns, about which later sums are taken.
std::vector<double> means_of(std::span<const double> rows, std::size_t d) {
    std::vector<double> means(d);
    const double n = static_cast<double>(rows.size()) / static_cast<double>(d);
    for (std::size_t i = 0; i < rows.size(); ++i) means[i % d] += rows[i] / n;
    return means;
}

Report report_of(const SampleMoments& moments) {
    Report report;
    return report.add("mean", moments.mean)
        .add("variance", moments.variance)
        .add("skewness", moments.skewness)
        .add("covariance", moments.covariance);
}

SampleMoments exact_of(const Moments& moments) {
    SampleMoments exact{moments.mean, {}, moments.skewness, moments.covariance};
    const std::size_t d = moments.dimension();
    for (std::size_t k = 0; k < d; ++k) exact.variance.push_back(moments.covariance[k * d + k]);
    return exact;
}

/// The moments that are finite, and the names of those that are not.
Report finite_of(const SampleMoments& exact) {
    Report report;
    std::vector<std::string> missing;
    const auto add = [&](const char* name, const std::vector<double>& values) {
        if (std::ranges::all_of(values, [](double x) { return std::isfinite(x); }))
            report.add(name, values);
        else
            missing.emplace_back(name);
    };
    add("mean", exact.mean);
    add("variance", exact.variance);
    add("skewness", exact.skewness);
    add("covariance", exact.covariance);
    report.add("known", missing.empty());
    if (!missing.empty())
        report.add("missing", fmt::format("{}: infinite, undefined, or not known within 1e-9",
                                          join(missing, ", ")));
    return report;
}

/// Largest |value - exact| of n points on the cube, in standard errors of independent points.
double largest_z(const SampleMoments& found, double n) {
    const std::size_t d = found.mean.size();
    const double mean = std::sqrt(1 / (12 * n));
    const double variance = std::sqrt((1 / 80.0 - (n - 3) / (n - 1) / 144) / n);
    const double skewness = std::sqrt(72 / (35 * n));
    const double covariance = 1 / (12 * std::sqrt(n - 1));
    double most = 0;
    for (std::size_t i = 0; i < d; ++i) {
        most = std::max({most, std::abs(found.mean[i] - 0.5) / mean,
                         std::abs(found.skewness[i]) / skewness,
                         std::abs(found.variance[i] - 1 / 12.0) / variance});
        for (std::size_t j = 0; j < i; ++j)
            most = std::max(most, std::abs(found.covariance[i * d + j]) / covariance);
    }
    return most;
}

class Summation final : public SharedAccumulator {
  public:
    explicit Summation(const Arrival& arrival) : domain_(arrival.domain) {}

    void add(std::span<const double> rows, const RunContext& run) override {
        const auto cubes = cube_rows(*domain_, rows, first_ + n_, outside_, run);
        if (!raw_) begin(rows, cubes);
        n_ += rows.size() / domain_->dimension();
        if (outside_.count > 0) return;
        raw_->add(rows, run);
        if (cube_) cube_->add(cubes, run);
    }

    Report report(const RunContext&) override {
        if (outside_.count > 0) refuse(outside_, n_, *domain_, outside_hint(*domain_));
        if (n_ < 2) fail(ErrorKind::input, "moments needs at least 2 points; there is {}", n_);
        const SampleAndErrors found = raw_->moments();
        Report report = report_of(found.value);
        report.add("standard_error", report_of(found.error));
        const auto exact = domain_->moments();
        Report law = exact ? finite_of(exact_of(*exact)) : Report().add("known", false);
        law.add("law", fmt::format(fmt::runtime(level_ ? "uniform on {}" : "the density of {}"),
                                   domain_->title()));
        report.add("exact", std::move(law));
        if (cube_) report.add("cube", cube_report());
        return report;
    }

    void begin_at(std::uint64_t first, std::span<const double> head) override {
        first_ = first;
        Outside counted_elsewhere;
        begin(head, cube_rows(*domain_, head, 0, counted_elsewhere, {}));
    }

    std::string state(const RunContext&) override {
        Packer packer;
        packer.put(n_);
        outside_.pack(packer);
        raw_->pack(packer);
        if (cube_) cube_->pack(packer);
        return packer.take();
    }

    void merge(std::string_view state, const RunContext&) override {
        Unpacker from(state);
        n_ += from.take<std::uint64_t>();
        outside_.add(Outside::unpacked(from));
        raw_->merge(from);
        if (cube_) cube_->merge(from);
    }

  private:
    /// Starts the sums of powers about the means of the first batch, and of its image on the cube.
    void begin(std::span<const double> rows, std::span<const double> cubes) {
        const std::uint64_t batch = first_ / arrival_batch(domain_->dimension());
        raw_.emplace(means_of(rows, domain_->dimension()), batch, rows);
        if (domain_->even())
            cube_.emplace(means_of(cubes, domain_->cube_dimension()), batch, cubes);
        level_ = is_level(rows);
    }

    /// Whether the domain's density is constant, judged by the first points.
    [[nodiscard]] bool is_level(std::span<const double> rows) const {
        constexpr std::size_t some = 64;
        const std::size_t d = domain_->dimension();
        for (std::size_t i = 0; i < std::min(some, rows.size() / d); ++i) {
            const auto point = rows.subspan(i * d, d);
            if (!domain_->contains(point)) continue;
            if (!(std::abs(domain_->density(point) * domain_->measure() - 1) <= 1e-12))
                return false;
        }
        return true;
    }

    [[nodiscard]] Report cube_report() const {
        const SampleAndErrors found = cube_->moments();
        Report report = report_of(found.value);
        report.add("largest_z", largest_z(found.value, static_cast<double>(n_)));
        tell_axes(*domain_, report);
        return report;
    }

    DomainPtr domain_;
    std::uint64_t first_ = 0;  ///< index of the first point to arrive
    std::uint64_t n_ = 0;
    std::optional<MomentSums> raw_;
    std::optional<MomentSums> cube_;
    bool level_ = true;
    Outside outside_;
};

std::vector<ResultKey> results() {
    std::vector<ResultKey> keys;
    const auto group = [&](const std::string& prefix, const std::string& of) {
        keys.push_back({prefix + "mean", of + "mean of each coordinate"});
        keys.push_back({prefix + "variance", of + "variance of each coordinate"});
        keys.push_back({prefix + "skewness", of + "skewness of each coordinate"});
        keys.push_back({prefix + "covariance", of + "covariance of each pair, row after row"});
    };
    group("", "");
    group("standard_error.", "standard error, assuming independent points: ");
    group("exact.", "exact value for the domain's distribution, if a closed form is known: ");
    keys.push_back({"exact.known",
                    "whether the exact values for the domain's distribution are known: in closed "
                    "form or, for formulas, by quadrature within 1e-6 of the range",
                    true, true_or_false});
    keys.push_back(
        {"exact.missing",
         "exact values that are missing, because they are infinite, undefined or not known",
         false});
    keys.push_back(
        {"exact.law",
         "distribution of the exact values: uniform on the domain, or its density; always the "
         "intended one, even if a biased method such as disk:method=naive made the points"});
    group("cube.", "on the domain's cube: ");
    keys.push_back({"cube.largest_z",
                    "largest difference of one of these from its exact value, in standard errors "
                    "of independent points"});
    keys.push_back(
        {"cube.axes", "description of the axes of the cube, if they are not x1, x2, ...", false});
    return keys;
}

}  // namespace

Analyzer unit() {
    return {.name = "moments",
            .summary =
                "Mean, variance, skewness and covariances, compared with the domain's exact values",
            .source = "Kendall, Stuart, The Advanced Theory of Statistics 1",
            .related = {"statistics", "covariance", "correlation"},
            .traits = {.max_dimension = 1000, .unit_cube = false},
            .options = Schema(),
            .results = results(),
            .accumulate = [](const Arrival& arrival, const Values&,
                             const RunContext&) { return std::make_unique<Summation>(arrival); },
            .sharing = {.grain = batch_grain}};
}

}  // namespace stipple::analyzers::moments
