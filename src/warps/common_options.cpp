// SPDX-License-Identifier: MIT
#include "warps/common_options.hpp"

#include <cmath>

#include "core/error.hpp"
#include "math/arithmetic/double_double.hpp"

namespace stipple::warps {

void refuse_far(double x, double reach) {
    if (x + reach == x || x - reach == x)
        fail(ErrorKind::usage,
             "--center: {} is so far from 0 that a radius of {} is lost in rounding", x, reach);
}

std::vector<double> one_for_each(const Param<Numbers>& option, std::vector<double> numbers,
                                 std::size_t d) {
    if (numbers.size() == 1) return std::vector<double>(d, numbers[0]);
    if (numbers.size() != d)
        fail(ErrorKind::usage,
             "--{}: {} numbers for {} coordinates; expected one for all, or one for each",
             option.name, numbers.size(), d);
    return numbers;
}

std::vector<double> checked_weights(const Param<Numbers>& option, std::vector<double> weights,
                                    bool normalize) {
    for (const double w : weights)
        if (!(w >= 0 && w <= 1e300))
            fail(ErrorKind::usage, "--{}: {} is outside [0, {}]", option.name, w,
                 normalize ? "1e300" : "1");
    const double sum = running_sums(weights).back();
    if (!normalize && !(std::abs(sum - 1) <= 1e-12))
        fail_with_hint(ErrorKind::usage, "--normalize divides them by their sum",
                       "--{}: the sum is {:.15g}; expected 1", option.name, sum);
    if (!(sum > 0 && std::isfinite(sum)))
        fail(ErrorKind::usage, "--{}: the sum is {}; expected a finite number above 0", option.name,
             sum);
    for (double& w : weights) w /= sum;
    return weights;
}

std::vector<double> sums_to_1(const std::vector<double>& weights) {
    std::vector<double> sums = running_sums(weights);
    const double total = sums.back();
    for (double& sum : sums) sum = sum == total ? 1 : sum;
    return sums;
}

}  // namespace stipple::warps
