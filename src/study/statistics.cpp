// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/incomplete_functions.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

/// Quantile of sorted numbers, interpolated linearly.
double quantile(std::span<const double> sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    if (below + 1 >= sorted.size()) return sorted.back();
    const double part = at - static_cast<double>(below);
    const double low = sorted[below];
    const double high = sorted[below + 1];
    if (part == 0 || low == high) return low;
    const double step = high - low;  // may overflow
    return std::isfinite(step) ? low + part * step : (1 - part) * low + part * high;
}

/// Largest relative difference that counts as rounding: a shift of the points, for example, changes
/// the last digits of a distance.
constexpr double rounding = 0x1p-44;

bool equal_but_for_rounding(double a, double b) {
    const double larger = std::max(std::abs(a), std::abs(b));
    return std::isfinite(larger) && std::abs(a - b) <= rounding * larger;
}

/// a - b, or 0 if they are equal except for rounding.
double difference_of(double a, double b) { return equal_but_for_rounding(a, b) ? 0 : a - b; }

double mean_of(std::span<const double> numbers) {
    const double scale = unit_for(numbers);  // so that their sum does not overflow
    double sum = 0;
    for (const double x : numbers) sum += x / scale;
    return scale * (sum / static_cast<double>(numbers.size()));
}

/// sqrt((a^2 + b^2 + ...) / divisor)
double root_of_squares(std::span<const double> numbers, double divisor) {
    const double scale = unit_for(numbers);
    double squares = 0;
    for (const double x : numbers) squares += x / scale * (x / scale);
    return scale * std::sqrt(squares / divisor);
}

/// Completes a test from the difference, its error and the degrees of freedom.
MeanTest tested(double difference, double error, double degrees) {
    MeanTest test{.difference = difference, .standard_error = error, .degrees = degrees};
    if (!std::isfinite(error) || !std::isfinite(difference)) return test;
    if (error == 0) {
        test.p_value = difference == 0 ? 1 : 0;
        test.degrees = not_known;
        return test;
    }
    test.t = difference / error;
    test.p_value = 2 * student_above(std::min(std::abs(test.t), 1e150), degrees);
    return test;
}

}  // namespace

SampleSummary summarize(std::span<const double> sample) {
    SampleSummary s{.count = sample.size()};
    const bool known = std::ranges::none_of(sample, [](double x) { return std::isnan(x); });
    if (sample.empty() || !known) return s;
    const double n = static_cast<double>(sample.size());
    std::vector<double> sorted(sample.begin(), sample.end());
    std::ranges::sort(sorted);
    s.median = quantile(sorted, 0.5);
    // The mean of equal numbers is one of them, not their rounded sum divided by n.
    const bool same = equal_but_for_rounding(sorted.front(), sorted.back());
    s.mean = same ? sorted[sorted.size() / 2] : mean_of(sample);
    if (sample.size() < 2) return s;
    if (same) {
        s.deviation = s.standard_error = 0;
        return s;
    }
    std::ranges::transform(sample, sorted.begin(), [&](double x) { return x - s.mean; });
    s.deviation = root_of_squares(sorted, n - 1);
    s.standard_error = s.deviation / std::sqrt(n);
    return s;
}

Interval t_interval(const SampleSummary& sample, double confidence) {
    if (sample.count < 2 || !std::isfinite(sample.standard_error)) return {not_known, not_known};
    const double reach =
        student_quantile((1 - confidence) / 2, static_cast<double>(sample.count - 1)) *
        sample.standard_error;
    return {sample.mean - reach, sample.mean + reach};
}

double root_mean_square(std::span<const double> sample) {
    return root_of_squares(sample, static_cast<double>(sample.size()));
}

Interval rms_interval(std::span<const double> sample, double confidence) {
    if (sample.size() < 2 || !(summarize(sample).deviation > 0)) return {not_known, not_known};
    const auto r = static_cast<double>(sample.size());
    const double tail = (1 - confidence) / 2;
    const double rms = root_mean_square(sample);
    return {rms * std::sqrt(r / (2 * gamma_upper_quantile(r / 2, tail))),
            rms * std::sqrt(r / (2 * gamma_quantile(r / 2, tail)))};
}

Interval bootstrap_interval(std::span<const double> sample, double confidence,
                            std::uint64_t resamples, std::uint64_t seed, std::uint64_t stream,
                            const RunContext& run) {
    const std::uint64_t n = sample.size();
    const bool finite = std::ranges::all_of(sample, [](double x) { return std::isfinite(x); });
    const bool enough = static_cast<double>(resamples + 1) * (1 - confidence) >= 2 * (1 - 1e-9);
    if (n < 2 || !enough || !finite) return {not_known, not_known};
    if (const SampleSummary s = summarize(sample); s.deviation == 0) return {s.mean, s.mean};
    const Rng rng(seed, stream);
    const double scale = unit_for(sample);  // so that sums do not overflow
    std::vector<double> means(resamples);
    for (std::uint64_t b = 0; b < resamples; ++b) {
        run.check_stop();
        double sum = 0;
        for (std::uint64_t i = 0; i < n; ++i) sum += sample[rng.below(b * n + i, n)] / scale;
        means[b] = scale * (sum / static_cast<double>(n));
    }
    std::ranges::sort(means);
    return {quantile(means, (1 - confidence) / 2), quantile(means, (1 + confidence) / 2)};
}

MeanTest welch_test(std::span<const double> a, std::span<const double> b) {
    const SampleSummary x = summarize(a);
    const SampleSummary y = summarize(b);
    if (!(a.size() > 1 && b.size() > 1))
        return tested(difference_of(x.mean, y.mean), not_known, not_known);
    const std::array errors = {x.standard_error, y.standard_error};
    const double scale = unit_for(errors);
    const double u = errors[0] / scale * (errors[0] / scale);
    const double v = errors[1] / scale * (errors[1] / scale);
    const double share = u / (u + v);
    const double degrees = 1 / (share * share / static_cast<double>(a.size() - 1) +
                                (1 - share) * (1 - share) / static_cast<double>(b.size() - 1));
    return tested(difference_of(x.mean, y.mean), root_of_squares(errors, 1), degrees);
}

MeanTest paired_test(std::span<const double> a, std::span<const double> b) {
    std::vector<double> differences(a.size());
    std::ranges::transform(a, b, differences.begin(), difference_of);
    const SampleSummary s = summarize(differences);
    if (s.count < 2) return tested(s.mean, not_known, not_known);
    return tested(s.mean, s.standard_error, static_cast<double>(s.count - 1));
}

std::vector<double> holm(std::span<const double> p_values) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p_values.size(); ++i)
        if (!std::isnan(p_values[i])) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
    std::vector<double> corrected(p_values.begin(), p_values.end());
    double least = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double p = p_values[order[rank]] * static_cast<double>(order.size() - rank);
        corrected[order[rank]] = least = std::min(1.0, std::max(least, p));
    }
    return corrected;
}

}  // namespace stipple
