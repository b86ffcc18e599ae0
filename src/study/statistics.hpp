// SPDX-License-Identifier: MIT
//
// Statistics of independent replications: means, their intervals, and differences of two means.
//
//     r numbers x: mean, s^2 = sum (x - mean)^2 / (r - 1), standard error s / sqrt(r)
//     t interval: mean -+ t(r - 1) s / sqrt(r)
//     root mean square: q = sqrt(sum x^2 / r); its interval from q sqrt(r / chi^2(r)) at both tails
//     bootstrap interval: quantiles of the means of B samples of r numbers drawn with replacement
//     Welch: t = (mean_a - mean_b) / sqrt(s_a^2 / r_a + s_b^2 / r_b), with Satterthwaite's degrees
//     paired: the t test of the differences x_a - x_b
//     Holm: the i-th smallest of m p-values, i from 0, times m - i; made non-decreasing, at most 1
//
// Promise  the bootstrap is a function of the numbers, their order and the seed alone.
//          Numbers that differ by at most 2^-44 of the larger one count as equal: that is rounding.
// Beware   if neither sample varies, no error can be estimated: p is 1 for equal means, otherwise
//          0. Undefined values, such as the error of one number, are NaN.
// Source   B. L. Welch, Biometrika 34 (1947) 28-35, doi:10.1093/biomet/34.1-2.28; S. Holm,
//          Scandinavian Journal of Statistics 6 (1979) 65-70; B. Efron, Annals of Statistics 7
//          (1979) 1-26, doi:10.1214/aos/1176344552.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

struct Interval {
    double low = 0;
    double high = 0;
};

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

struct SampleSummary {
    std::size_t count = 0;
    double mean = not_known;
    double median = not_known;
    double deviation = not_known;  ///< standard deviation of the sample
    double standard_error = not_known;
};

SampleSummary summarize(std::span<const double> sample);

/// Student's interval for the mean.
Interval t_interval(const SampleSummary& sample, double confidence);

double root_mean_square(std::span<const double> sample);

/// Interval for the root mean square of independent normal numbers of mean 0; NaN if all numbers
/// are the same.
Interval rms_interval(std::span<const double> sample, double confidence);

/// Bootstrap interval for the mean; samples with the same seed should have different `stream`s.
/// @throws Error(cancelled)
Interval bootstrap_interval(std::span<const double> sample, double confidence,
                            std::uint64_t resamples, std::uint64_t seed, std::uint64_t stream = 0,
                            const RunContext& run = {});

/// Two-sided test of whether two means are the same.
struct MeanTest {
    double difference = 0;
    double standard_error = 0;
    double t = not_known;
    double degrees = not_known;
    double p_value = not_known;
};

MeanTest welch_test(std::span<const double> a, std::span<const double> b);

/// Compares a[i] with b[i]; both have the same length.
MeanTest paired_test(std::span<const double> a, std::span<const double> b);

/// Holm's corrected p-values, in the given order. A NaN stays NaN and does not count as a test.
std::vector<double> holm(std::span<const double> p_values);

}  // namespace stipple
